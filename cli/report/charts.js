// SPDX-License-Identifier: BSD-3-Clause
// The curves of a run over its frames, each with a cursor at the shown frame; a click goes to a frame.

class Chart extends Plot {
  constructor(title, series, options) {
    super(title, series, options);
    shown.listen(() => this.markShown());
  }

  share(_, row) { return row / Math.max(run.frames.count - 1, 1); }

  shareOfTime(seconds) {
    let row = 0;
    while (row < run.frames.count - 1 && run.seconds(row) < seconds) ++row;
    return this.share(null, row);
  }

  duration() { return run.seconds(run.frames.count - 1); }

  pointed(share) { shown.set(share * (run.frames.count - 1)); }

  markShown() { this.mark(this.share(null, shown.row), this.series.map((s) => s.values()[shown.row])); }

  // Where the pose has no Manhattan rotation in it, is uncertain, or there is none.
  drawBehind(context, height) {
    const told = ["lost", "uncertain", ...(run.manhattanSeen ? ["fallback"] : [])];
    const noted = (row) => (told.includes(run.look(row)) ? run.look(row) : null);
    context.globalAlpha = 0.2;
    for (const span of spansOf(run.frames.count, noted)) {
      context.fillStyle = colour(span.key);
      const from = this.xOf(this.share(null, span.from - 0.5));
      context.fillRect(from, kPlot.top, Math.max(this.xOf(this.share(null, span.to + 0.5)) - from, 1.5), height - kPlot.top - kPlot.bottom);
    }
    context.globalAlpha = 1;
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
  if (frames.has("axes_seen") && (run.manhattanSeen || run.kind === "live")) new Chart("Manhattan axes seen", [{ label: "seen", ink: "manhattan", values: column("axes_seen"), unit: "of 3" }], { whole: 3, counts: true });
  if (frames.has("frame_ms"))
    new Chart("Frame time", [{ label: "all", ink: "accent", values: column("frame_ms"), unit: "ms" }, { label: "tracking", ink: "x", values: column("tracking_ms"), unit: "ms" }]);
  if (frames.has("points"))
    new Chart("Features found", [{ label: "points", ink: "accent", values: column("points") }, { label: "lines", ink: "x", values: column("lines") }], { counts: true });
}
