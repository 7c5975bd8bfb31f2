// SPDX-License-Identifier: BSD-3-Clause
// Curves over time, each with a cursor at the shown frame; a click goes to a frame.

const kPlot = { left: 44, right: 8, top: 8, bottom: 18 };

// 1, 2 or 5 times a power of ten, for about `wanted` steps over `extent`.
function tickStep(extent, wanted) {
  const power = 10 ** Math.floor(Math.log10(extent / wanted));
  return power * ([1, 2, 5].find((factor) => factor * power >= extent / wanted) ?? 10);
}

class Chart {
  // series: [{label, ink, values, unit}]; values(): over the frames.
  constructor(title, series, options = {}) {
    this.series = series;
    this.whole = options.whole ?? 0;  // the axis reaches at least this far
    this.counts = options.counts ?? false;  // whole numbers
    this.values = series.map((s) => element("span", { className: "value" }));
    const legend = series.map((s, i) => element("span", {}, element("span", { className: "swatch", style: `color: var(--${s.ink})` }), `${s.label} `, this.values[i]));
    this.canvas = element("canvas", { role: "img", "aria-label": `${title} over time` });
    this.cursor = element("div", { className: "cursor" });
    this.plot = element("div", { className: "plot" }, this.canvas, this.cursor);
    byId("charts").append(element("figure", { className: "card chart" }, element("header", {}, element("b", {}, title), ...legend,
      element("button", { type: "button", className: "save", title: "Save this chart as SVG", onclick: () => this.save() }, "SVG")), this.plot));
    this.title = title;
    redraws.push(() => this.draw());
    this.plot.addEventListener("pointerdown", (event) => this.point(event));
    this.plot.addEventListener("pointermove", (event) => { if (event.buttons) this.point(event); });
    shown.listen((row) => this.mark(row));
  }

  point(event) {
    const box = this.plot.getBoundingClientRect();
    const share = (event.clientX - box.left - kPlot.left) / (box.width - kPlot.left - kPlot.right);
    shown.set(share * (run.frames.count - 1));
  }

  x(row) {
    return kPlot.left + (this.width - kPlot.left - kPlot.right) * row / Math.max(run.frames.count - 1, 1);
  }

  mark(row) {
    if (!this.width) return;
    this.cursor.style.left = `${this.x(row)}px`;
    this.series.forEach((s, i) => { this.values[i].textContent = `${figure(s.values()[row])}${s.unit ? ` ${s.unit}` : ""}`; });
  }

  draw() {
    const cleared = clearedContext(this.canvas);
    if (!cleared) return;
    this.width = cleared.width;
    this.drawOn(cleared.context, cleared.height);
    this.mark(shown.row);
  }

  save() {
    const [width, height] = [this.width, this.canvas.clientHeight];
    const svg = new SvgContext(width, height, `${this.title}: ${this.series.map((s) => s.label).join(", ")}`);
    this.drawOn(svg, height);
    offerFile(`${this.title.toLowerCase().replaceAll(" ", "_")}.svg`, new Blob([svg.text()], { type: "image/svg+xml" }));
  }

  drawOn(context, height) {
    const high = this.top();
    const y = (value) => height - kPlot.bottom - (height - kPlot.top - kPlot.bottom) * Math.min(value / high, 1);
    this.drawStates(context, height);
    this.drawTicks(context, high, y, height);
    for (const s of this.series) this.drawCurve(context, s, y);
    this.drawBeyond(context, high);
  }

  // The upper end of the axis. A few frames that are far above all others are cut off, else they would flatten the rest.
  top() {
    let high = this.whole, usual = 0;
    for (const s of this.series) {
      const values = s.values().filter((value) => !Number.isNaN(value));
      if (values.length === 0) continue;
      high = values.reduce((a, b) => Math.max(a, b), high);
      usual = Math.max(usual, quantile(values, 0.98));
    }
    if (usual > 0 && high > 3 * usual) high = Math.max(this.whole, 1.5 * usual);
    return high > 0 ? Math.max(this.whole, 1.04 * high) : 1;
  }

  // A mark above each frame that is cut off.
  drawBeyond(context, high) {
    for (const s of this.series) {
      context.fillStyle = colour(s.ink);
      s.values().forEach((value, row) => {
        if (value > high) context.fillRect(this.x(row) - 1.5, kPlot.top - 5, 3, 4);
      });
    }
  }

  // Behind the curves: where the pose has no Manhattan rotation in it, or there is none.
  drawStates(context, height) {
    const noted = (row) => (["lost", "fallback"].includes(run.look(row)) ? run.look(row) : null);
    context.globalAlpha = 0.2;
    for (const span of spansOf(run.frames.count, noted)) {
      context.fillStyle = colour(span.key);
      const from = this.x(span.from - 0.5);
      context.fillRect(from, kPlot.top, Math.max(this.x(span.to + 0.5) - from, 1.5), height - kPlot.top - kPlot.bottom);
    }
    context.globalAlpha = 1;
  }

  drawTicks(context, high, y, height) {
    context.font = "11px system-ui, sans-serif";
    context.lineWidth = 1;
    const step = this.counts ? Math.max(1, tickStep(high, 3.5)) : tickStep(high, 3.5);
    context.textAlign = "right";
    for (let value = 0; value <= high * 1.001; value += step) {
      context.strokeStyle = colour("line");
      context.beginPath();
      context.moveTo(kPlot.left, Math.round(y(value)) + 0.5);
      context.lineTo(this.width - kPlot.right, Math.round(y(value)) + 0.5);
      context.stroke();
      context.fillStyle = colour("quiet");
      context.fillText(figure(value), kPlot.left - 6, y(value) + 4);
    }
    const last = run.frames.count - 1, end = run.seconds(last);
    if (!(end > 0)) return;
    const seconds = tickStep(end, Math.max(2, this.width / 90));
    context.textAlign = "center";
    let row = 0;
    for (let at = 0; at <= end * 1.001; at += seconds) {
      while (row < last && run.seconds(row) < at) ++row;
      context.fillText(`${figure(at)}${at === 0 ? " s" : ""}`, Math.min(this.x(row), this.width - 14), height - 4);
    }
  }

  // At most two strokes a pixel: the least and the greatest of the frames that share it.
  drawCurve(context, series, y) {
    const values = series.values();
    const perStroke = Math.max(1, Math.ceil(values.length / (2 * this.width)));
    context.strokeStyle = colour(series.ink);
    context.lineWidth = 1.6;
    context.lineJoin = "round";
    context.beginPath();
    let broken = true;
    for (let row = 0; row < values.length; row += perStroke) {
      let low = NaN, high = NaN;
      for (let r = row; r < Math.min(row + perStroke, values.length); ++r) {
        if (!(values[r] >= low)) low = values[r];
        if (!(values[r] <= high)) high = values[r];
      }
      if (Number.isNaN(low) || Number.isNaN(high)) {
        broken = true;
        continue;
      }
      if (broken) context.moveTo(this.x(row) - 0.5, y(low));
      context.lineTo(this.x(row), y(low));
      if (high !== low) context.lineTo(this.x(row), y(high));
      broken = false;
    }
    context.stroke();
  }
}

function showCharts() {
  const { frames } = run;
  if (frames.count < 2 || byId("charts").childElementCount > 0) return;
  const column = (name) => () => run.frames.all(name);
  if (run.errors) {
    new Chart("Position error", [{ label: "after alignment", ink: "accent", values: () => run.errors.position_m, unit: "m" }]);
    new Chart("Rotation error", [{ label: "after a constant offset", ink: "accent", values: () => run.errors.rotation_deg, unit: "°" }]);
  }
  if (frames.has("point_inliers"))
    new Chart("Map seen again", [{ label: "points", ink: "accent", values: column("point_inliers") }, { label: "lines", ink: "x", values: column("line_inliers") }], { counts: true });
  if (frames.has("axes_seen")) new Chart("Manhattan axes seen", [{ label: "seen", ink: "manhattan", values: column("axes_seen"), unit: "of 3" }], { whole: 3, counts: true });
  if (frames.has("frame_ms"))
    new Chart("Time for a frame", [{ label: "all", ink: "accent", values: column("frame_ms"), unit: "ms" }, { label: "tracking", ink: "x", values: column("tracking_ms"), unit: "ms" }]);
  if (frames.has("points"))
    new Chart("Features found", [{ label: "points", ink: "accent", values: column("points") }, { label: "lines", ink: "x", values: column("lines") }], { counts: true });
}
