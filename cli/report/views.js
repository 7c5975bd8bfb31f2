// SPDX-License-Identifier: BSD-3-Clause
// The pictures along the slider: image with features and segments, normals beside it. Reads what frame_view.cpp wrote.

function decodeView(base64) {
  const bytes = bytesOf(base64);
  const data = new DataView(bytes.buffer);
  let at = 0;
  const take = (kind, size) => {
    const value = data[`get${kind}`](at, true);
    at += size;
    return value;
  };
  const u8 = () => take("Uint8", 1), i8 = () => take("Int8", 1), u16 = () => take("Uint16", 2);
  const u32 = () => take("Uint32", 4), f32 = () => take("Float32", 4);
  const many = (count, read) => Array.from({ length: count }, read);
  const share = () => u16() / 65535;
  const jpeg = () => {
    const size = u32();
    at += size;
    return size > 0 ? new Blob([bytes.subarray(at - size, at)], { type: "image/jpeg" }) : null;
  };
  const view = { row: u32(), aspect: f32(), image: jpeg(), normalImage: jpeg() };
  const points = u16();
  view.mapped = u16();
  view.points = many(points, () => [share(), share()]);
  view.lines = many(u16(), () => ({ ends: [share(), share(), share(), share()], axis: i8(), mapped: u8() > 0 }));
  view.normals = many(u16(), () => [i8() / 127, i8() / 127, i8() / 127]);
  view.axes = u8() > 0 ? many(3, () => [f32(), f32(), f32()]) : null;
  return view;
}

function rowOfView(base64) { return new DataView(bytesOf(base64.slice(0, 8)).buffer).getUint32(0, true); }

const kMostViews = 1000;  // that the page of a live run keeps

class Views {
  constructor() {
    this.texts = byId("views").textContent.split("\n").filter((line) => line.length > 0);
    this.rows = this.texts.map(rowOfView);
    if (this.texts.length === 0 && run.kind !== "live") {
      byId("pictures").append(element("p", { className: "quiet" }, "This run kept no pictures (--no-report, or views.bin is missing)."));
      return;
    }
    this.image = element("img", { alt: "Camera image" });
    this.overlay = element("canvas", { "aria-hidden": "true" });
    this.caption = element("figcaption");
    this.normalImage = element("img", { alt: "Surface normals" });
    this.normalFigure = element("figure", {}, element("div", { className: "picture" }, this.normalImage), element("figcaption", {}, "Normals: x, y, z as red, green, blue; grey: none"));
    this.sphere = new Sphere();
    this.show = { points: true, lines: true };
    const toggles = ["points", "lines"].map((what) => toggleButton(what === "points" ? "Features" : "Segments", (on) => {
      this.show[what] = on;
      this.draw();
    }));
    byId("pictures").append(
      element("figure", {}, element("div", { className: "picture" }, this.image, this.overlay), this.caption),
      element("div", { className: "toggles" }, ...toggles),
      element("div", { className: "pair" }, this.normalFigure, this.sphere.figure));
    this.image.addEventListener("load", () => {
      this.draw();
      window.view3d?.showPicture?.(this.image);
    });
    redraws.push(() => this.draw());
    shown.listen((row) => this.pick(row));
    this.pick(shown.row);
  }

  // Of a run that goes on. When there are too many, every other one goes.
  add(text) {
    if (this.texts.length >= kMostViews) {
      this.texts = this.texts.filter((_, i) => i % 2 === 0);
      this.shownView = -1;
    }
    this.texts.push(text);
    this.rows = this.texts.length === this.rows.length + 1 ? [...this.rows, rowOfView(text)] : this.texts.map(rowOfView);
  }

  // The kept view nearest to the row.
  pick(row) {
    if (this.texts.length === 0) return;
    let best = 0;
    for (let i = 1; i < this.rows.length; ++i)
      if (Math.abs(this.rows[i] - row) < Math.abs(this.rows[best] - row)) best = i;
    if (best === this.shownView) return;
    this.shownView = best;
    this.view = decodeView(this.texts[best]);
    this.put(this.image, this.view.image);
    this.put(this.normalImage, this.view.normalImage);
    this.normalFigure.hidden = !this.view.normalImage;
    this.image.parentElement.style.aspectRatio = String(this.view.aspect);
    const away = this.view.row !== row ? `Picture of frame ${run.frames.text("index", this.view.row)}, the nearest kept. ` : "";
    const segments = this.view.lines.filter((line) => line.mapped).length;
    this.caption.textContent = away + (this.view.mapped + segments > 0 ? `${countOf(this.view.mapped, "point")} and ${countOf(segments, "segment")} belong to the map.` : "");
    this.sphere.show(this.view);
  }

  put(image, blob) {
    if (image.src) URL.revokeObjectURL(image.src);
    if (blob) image.src = URL.createObjectURL(blob);
    else image.removeAttribute("src");
  }

  draw() {
    const cleared = clearedContext(this.overlay);
    if (!cleared || !this.view) return;
    const { context, width, height } = cleared;
    if (this.show.lines) {
      for (const { ends, axis, mapped } of this.view.lines) {
        context.strokeStyle = run.overlay.axes[axis < 0 ? 3 : axis];
        context.lineWidth = mapped ? 2.4 : 1.3;
        context.beginPath();
        context.moveTo(ends[0] * width, ends[1] * height);
        context.lineTo(ends[2] * width, ends[3] * height);
        context.stroke();
      }
    }
    if (!this.show.points) return;
    this.view.points.forEach(([x, y], i) => {
      const mapped = i < this.view.mapped;
      context.fillStyle = mapped ? run.overlay.mapped : run.overlay.other;
      const size = mapped ? 3 : 2;
      context.fillRect(x * width - size / 2, y * height - size / 2, size, size);
    });
  }
}
