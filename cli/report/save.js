// SPDX-License-Identifier: BSD-3-Clause
// What the page hands out: charts as SVG, the view as PNG, the frames as CSV, a link to the shown frame.

function offerFile(name, blob) {
  const link = element("a", { download: name, href: URL.createObjectURL(blob) });
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}

function xmlText(text) { return String(text).replaceAll("&", "&amp;").replaceAll("<", "&lt;").replaceAll('"', "&quot;"); }

// As much of a canvas's 2D context as the charts use, written down as SVG.
class SvgContext {
  constructor(width, title) {
    Object.assign(this, { width, height: 0, title, parts: [], open: 0, path: [], globalAlpha: 1, lineWidth: 1, textAlign: "left", lineJoin: "round" });
  }
  translate(x, y) {
    this.parts.push(`<g transform="translate(${this.n(x)} ${this.n(y)})">`);
    this.height += y;
    ++this.open;
  }
  n(value) { return Number(value.toFixed(2)); }
  beginPath() { this.path = []; }
  moveTo(x, y) { this.path.push(`M${this.n(x)} ${this.n(y)}`); }
  lineTo(x, y) { this.path.push(`L${this.n(x)} ${this.n(y)}`); }
  stroke() {
    if (this.path.length > 0) this.parts.push(`<path d="${this.path.join("")}" fill="none" stroke="${this.strokeStyle}" stroke-width="${this.lineWidth}" stroke-linejoin="round"/>`);
  }
  fillRect(x, y, width, height) {
    this.parts.push(`<rect x="${this.n(x)}" y="${this.n(y)}" width="${this.n(width)}" height="${this.n(height)}" fill="${this.fillStyle}" fill-opacity="${this.globalAlpha}"/>`);
  }
  fillText(text, x, y) {
    const anchor = { left: "start", center: "middle", right: "end" }[this.textAlign];
    this.parts.push(`<text x="${this.n(x)}" y="${this.n(y)}" fill="${this.fillStyle}" text-anchor="${anchor}">${xmlText(text)}</text>`);
  }
  text() {
    return `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 ${this.width} ${this.height}" width="${this.width}" height="${this.height}" font-family="sans-serif" font-size="11">`
      + `<title>${xmlText(this.title)}</title><rect width="100%" height="100%" fill="${colour("card")}"/>${this.parts.join("\n")}${"</g>".repeat(this.open)}</svg>\n`;
  }
}

function csvText(text) { return /[",\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text; }
function csvNumber(value) { return Number.isFinite(value) ? String(value) : ""; }

// The columns of frames.csv, with each frame's pose (world from camera) and errors.
function framesAsCsv() {
  const { frames } = run;
  const columns = Object.keys(frames.columns);
  const lines = [[...columns, "tx", "ty", "tz", "qx", "qy", "qz", "qw", ...(run.errors ? ["position_error_m", "rotation_error_deg"] : [])].join(",")];
  for (let row = 0; row < frames.count; ++row) {
    const cells = columns.map((name) => csvText(frames.text(name, row)));
    for (let i = 0; i < 7; ++i) cells.push(csvNumber(run.poses[7 * row + i]));
    if (run.errors) cells.push(csvNumber(run.errors.position_m[row]), csvNumber(run.errors.rotation_deg[row]));
    lines.push(cells.join(","));
  }
  return `${lines.join("\n")}\n`;
}

function saveCsv() { offerFile(`${run.folder}_frames.csv`, new Blob([framesAsCsv()], { type: "text/csv" })); }

function savePicture(view) {
  view.draw(true);
  view.canvas.toBlob((blob) => { if (blob) offerFile(`${run.folder}_map.png`, blob); }, "image/png");
}

// The row that the address asks for by the frame's index: ...#frame=120; -1 where it asks for none.
function rowOfAddress() {
  const wanted = /^#frame=(\d+)$/.exec(location.hash)?.[1];
  if (wanted === undefined) return -1;
  for (let row = 0; row < run.frames.count; ++row) if (run.frames.text("index", row) === wanted) return row;
  return -1;
}

function linkToFrame() {
  history.replaceState(null, "", `#frame=${run.frames.text("index", shown.row)}`);
  navigator.clipboard?.writeText(location.href).catch(() => {});
}

// Where the page opens: at the frame of the address, else in the middle of those that have a pose.
function firstRow() {
  const asked = rowOfAddress();
  if (asked >= 0) return asked;
  const posed = Array.from({ length: run.frames.count }, (_, row) => row).filter((row) => run.hasPose(row));
  return posed[Math.floor(posed.length / 2)] ?? 0;
}
