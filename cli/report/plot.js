// SPDX-License-Identifier: BSD-3-Clause
// Curves over time in a card of their own, with a cursor, and as SVG. Who derives from it says where values stand in time.

const kPlot = { left: 44, right: 8, top: 8, bottom: 18 };

// 1, 2 or 5 times a power of ten, for about `wanted` steps over `extent`.
function tickStep(extent, wanted) {
  const power = 10 ** Math.floor(Math.log10(extent / wanted));
  return power * ([1, 2, 5].find((factor) => factor * power >= extent / wanted) ?? 10);
}

// Derived: share(series, i), of the width, for the i-th value; shareOfTime(seconds); duration(), seconds;
// drawBehind(context, height); pointed(share), where the plot is clicked.
class Plot {
  // series: [{label, ink, values, unit}]; values(): numbers in the order of time, NaN for none.
  constructor(title, series, options = {}) {
    this.title = title;
    this.series = series;
    this.whole = options.whole ?? 0;  // the axis reaches at least this far
    this.counts = options.counts ?? false;  // whole numbers
    this.values = series.map(() => element("span", { className: "value" }));
    const legend = series.map((s, i) => element("span", { className: "entry" }, swatchOf(s.ink), nameOf(s.label), " ", this.values[i]));
    this.canvas = element("canvas", { role: "img", "aria-label": `${title} over time` });
    this.cursor = element("div", { className: "cursor" });
    this.plot = element("div", { className: "plot" }, this.canvas, this.cursor);
    byId("charts").append(element("figure", { className: "card chart" }, element("header", {}, element("b", {}, title), ...legend,
      element("button", { type: "button", className: "save", title: "Save this chart as SVG", onclick: () => this.save() }, "SVG")), this.plot));
    redraws.push(() => this.draw());
    this.plot.addEventListener("pointerdown", (event) => this.point(event));
    this.plot.addEventListener("pointermove", (event) => { if (event.buttons) this.point(event); });
  }

  point(event) {
    const box = this.plot.getBoundingClientRect();
    this.pointed((event.clientX - box.left - kPlot.left) / (box.width - kPlot.left - kPlot.right));
  }

  xOf(share) { return kPlot.left + (this.width - kPlot.left - kPlot.right) * share; }

  // The cursor, and the values that stand there: numbers in the order of the series.
  mark(share, values) {
    if (!this.width) return;
    this.cursor.style.left = `${this.xOf(share)}px`;
    this.series.forEach((s, i) => { this.values[i].textContent = s.unit ? withUnit(values[i], s.unit) : figure(values[i]); });
  }

  draw() {
    const cleared = clearedContext(this.canvas);
    if (!cleared) return;
    this.width = cleared.width;
    this.drawOn(cleared.context, cleared.height);
    this.markShown();
  }

  save() {
    const [width, height] = [this.width, this.canvas.clientHeight];
    const svg = new SvgContext(width, this.title);
    svg.translate(0, this.drawHead(svg));
    this.drawOn(svg, height);
    svg.height += height;
    offerFile(`${this.title.toLowerCase().replaceAll(" ", "_")}.svg`, new Blob([svg.text()], { type: "image/svg+xml" }));
  }

  // Title and legend, in as many rows as they need; returns their height.
  drawHead(svg) {
    const measure = this.canvas.getContext("2d"), row = 16;
    let x = kPlot.left, y = row;
    const put = (text, ink) => {
      const width = measure.measureText(text).width + (ink ? 14 : 0);
      if (x + width > this.width - kPlot.right && x > kPlot.left) [x, y] = [kPlot.left, y + row];
      svg.fillStyle = colour(ink ?? "ink");
      if (ink) svg.fillRect(x, y - 9, 9, 9);
      svg.fillStyle = colour("ink");
      svg.fillText(text, x + (ink ? 14 : 0), y);
      x += width + 14;
    };
    const unit = this.series[0].unit;
    put(`${this.title}${unit ? `, ${unit}` : ""}`);
    for (const s of this.series) put(s.label, s.ink);
    return y + 6;
  }

  drawOn(context, height) {
    const high = this.top();
    const y = (value) => height - kPlot.bottom - (height - kPlot.top - kPlot.bottom) * Math.min(value / high, 1);
    this.drawBehind(context, height);
    this.drawTicks(context, high, y, height);
    for (const s of this.series) this.drawCurve(context, s, y);
    this.drawBeyond(context, high);
  }

  // The upper end of the axis. A few frames that are far above all others are cut off, else they would flatten the rest.
  top() {
    let high = this.whole, usual = 0;
    for (const s of this.series) {
      const values = s.values().filter(Number.isFinite);
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
      s.values().forEach((value, i) => {
        if (value > high) context.fillRect(this.xOf(this.share(s, i)) - 1.5, kPlot.top - 5, 3, 4);
      });
    }
  }

  drawTicks(context, high, y, height) {
    context.font = "11px system-ui, sans-serif";
    context.lineWidth = 1;
    const step = this.counts ? Math.max(1, tickStep(high, 4)) : tickStep(high, 4);
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
    const end = this.duration();
    if (!(end > 0)) return;
    const seconds = tickStep(end, Math.max(2, this.width / 70));
    context.textAlign = "center";
    for (let at = 0; at <= end * 1.001; at += seconds)
      context.fillText(`${figure(at)}${at === 0 ? " s" : ""}`, Math.min(this.xOf(this.shareOfTime(at)), this.width - 14), height - 4);
  }

  // At most two strokes a pixel: the least and the greatest of the values that share it.
  drawCurve(context, series, y) {
    const values = series.values();
    const perStroke = Math.max(1, Math.ceil(values.length / (2 * this.width)));
    context.strokeStyle = colour(series.ink);
    context.lineWidth = 1.6;
    context.lineJoin = "round";
    context.beginPath();
    let broken = true;
    for (let i = 0; i < values.length; i += perStroke) {
      let low = NaN, high = NaN;
      for (let k = i; k < Math.min(i + perStroke, values.length); ++k) {
        if (!(values[k] >= low)) low = values[k];
        if (!(values[k] <= high)) high = values[k];
      }
      if (Number.isNaN(low) || Number.isNaN(high)) {
        broken = true;
        continue;
      }
      const x = this.xOf(this.share(series, i));
      if (broken) context.moveTo(x - 0.5, y(low));
      context.lineTo(x, y(low));
      if (high !== low) context.lineTo(x, y(high));
      broken = false;
    }
    context.stroke();
  }
}
