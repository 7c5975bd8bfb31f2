// SPDX-License-Identifier: BSD-3-Clause
// Paths in space on a flat canvas, seen from a direction that the user turns; a dot on each where it is at the shown moment.

const kSeenFrom = { oblique: [-0.6, 0.7], above: [0, Math.PI / 2], side: [0, 0] };  // azimuth and height, radians

class PathView {
  // paths: [{ink, positions (three numbers each, NaN for none), dashed, at(): index of the shown moment}]; up: unit vector.
  constructor(canvas, paths, up, unit) {
    Object.assign(this, { canvas, paths, unit });
    this.hidden = new Set();
    const sideways = cross(up, Math.abs(up[0]) < 0.8 ? [1, 0, 0] : [0, 1, 0]), length = Math.hypot(...sideways);
    this.east = sideways.map((value) => value / length);
    this.north = cross(up, this.east);
    this.up = up;
    this.measure();
    this.seeFrom("oblique");
    redraws.push(() => this.draw());
    this.listen();
  }

  // Middle and reach of all paths, in east, north, up.
  measure() {
    const low = [Infinity, Infinity, Infinity], high = low.map((value) => -value);
    for (const { positions } of this.paths) {
      for (let i = 0; i < positions.length; i += 3) {
        if (Number.isNaN(positions[i])) continue;
        const at = this.levelled(positions.subarray(i, i + 3));
        for (let k = 0; k < 3; ++k) [low[k], high[k]] = [Math.min(low[k], at[k]), Math.max(high[k], at[k])];
      }
    }
    this.there = low[0] <= high[0];
    [this.low, this.high] = [low, high];
    this.middle = low.map((value, k) => (value + high[k]) / 2);
    this.reach = Math.max(Math.hypot(...low.map((value, k) => high[k] - value)) / 2, 1e-9);
  }

  levelled(place) { return [dot(place, this.east), dot(place, this.north), dot(place, this.up)]; }

  seeFrom(name) {
    [this.azimuth, this.height] = kSeenFrom[name];
    this.zoom = 1;
    this.draw();
  }

  show(path, on) {
    if (on) this.hidden.delete(path);
    else this.hidden.add(path);
    this.draw();
  }

  turn(right, up, nearer) {
    this.azimuth += right;
    this.height = Math.min(Math.max(this.height + up, -Math.PI / 2), Math.PI / 2);
    this.zoom = Math.min(Math.max(this.zoom * nearer, 0.2), 50);
    this.draw();
  }

  listen() {
    const { canvas } = this;
    const down = new Map();  // places of the pressed pointers: one turns, two zoom
    const apart = () => {
      const [[x0, y0], [x1, y1]] = [...down.values()];
      return Math.hypot(x1 - x0, y1 - y0);
    };
    canvas.addEventListener("pointerdown", (event) => {
      down.set(event.pointerId, [event.clientX, event.clientY]);
      canvas.setPointerCapture(event.pointerId);
    });
    canvas.addEventListener("pointermove", (event) => {
      const last = down.get(event.pointerId);
      if (!last) return;
      const before = down.size === 2 ? apart() : 0;
      down.set(event.pointerId, [event.clientX, event.clientY]);
      if (down.size === 1) this.turn(-(event.clientX - last[0]) / 200, (event.clientY - last[1]) / 200, 1);
      else if (before > 0) this.turn(0, 0, apart() / before);
    });
    for (const type of ["pointerup", "pointercancel"]) canvas.addEventListener(type, (event) => down.delete(event.pointerId));
    canvas.addEventListener("wheel", (event) => {
      this.turn(0, 0, Math.exp(-event.deltaY / 600));
      event.preventDefault();
    }, { passive: false });
    canvas.addEventListener("keydown", (event) => {
      const turn = { ArrowLeft: [0.1, 0, 1], ArrowRight: [-0.1, 0, 1], ArrowUp: [0, 0.08, 1], ArrowDown: [0, -0.08, 1], "+": [0, 0, 1.1], "=": [0, 0, 1.1], "-": [0, 0, 0.9] }[event.key];
      if (!turn || event.ctrlKey || event.metaKey) return;
      this.turn(...turn);
      event.preventDefault();
    });
  }

  draw() {
    const cleared = this.there && clearedContext(this.canvas);
    if (!cleared) return;
    const { context, width, height } = cleared;
    const scale = this.zoom * 0.46 * Math.min(width, 1.6 * height) / this.reach;
    const [ca, sa, ch, sh] = [Math.cos(this.azimuth), Math.sin(this.azimuth), Math.cos(this.height), Math.sin(this.height)];
    const toPixel = (east, north, up) => {
      const [x, y, z] = [east - this.middle[0], north - this.middle[1], up - this.middle[2]];
      return [width / 2 + scale * (ca * x + sa * y), height / 2 - scale * (sh * (ca * y - sa * x) + ch * z)];
    };
    this.drawFloor(context, toPixel);
    for (const path of this.paths) if (!this.hidden.has(path)) this.drawPath(context, path, toPixel);
    this.drawScale(context, scale, height);
  }

  // Squares at the height of the lowest place.
  drawFloor(context, toPixel) {
    const step = tickStep(2 * this.reach, 8);
    const [left, near] = [0, 1].map((k) => step * (Math.floor(this.low[k] / step) - 1)), [right, far] = [0, 1].map((k) => step * (Math.ceil(this.high[k] / step) + 1));
    context.strokeStyle = colour("grid");
    context.lineWidth = 1;
    context.beginPath();
    const line = (...ends) => {
      context.moveTo(...toPixel(ends[0], ends[1], this.low[2]));
      context.lineTo(...toPixel(ends[2], ends[3], this.low[2]));
    };
    for (let x = left; x <= right + step / 2; x += step) line(x, near, x, far);
    for (let y = near; y <= far + step / 2; y += step) line(left, y, right, y);
    context.stroke();
  }

  drawPath(context, { ink, positions, dashed, at }, toPixel) {
    const pixel = (i) => toPixel(...this.levelled(positions.subarray(3 * i, 3 * i + 3)));
    context.strokeStyle = context.fillStyle = colour(ink);
    context.lineWidth = dashed ? 1.5 : 2;
    context.setLineDash(dashed ? [5, 4] : []);
    context.lineJoin = "round";
    context.beginPath();
    let broken = true;
    for (let i = 0; 3 * i < positions.length; ++i) {
      const none = Number.isNaN(positions[3 * i]);
      if (!none && broken) context.moveTo(...pixel(i));
      else if (!none) context.lineTo(...pixel(i));
      broken = none;
    }
    context.stroke();
    context.setLineDash([]);
    const shownAt = at();
    if (shownAt === null || Number.isNaN(positions[3 * shownAt])) return;
    context.beginPath();
    context.arc(...pixel(shownAt), 5, 0, 2 * Math.PI);
    context.fill();
  }

  drawScale(context, scale, height) {
    const length = tickStep(120 / scale, 1);
    context.fillStyle = context.strokeStyle = colour("quiet");
    context.lineWidth = 2;
    context.beginPath();
    context.moveTo(16, height - 16);
    context.lineTo(16 + length * scale, height - 16);
    context.stroke();
    context.font = "12px system-ui, sans-serif";
    context.textAlign = "left";
    context.fillText(`${figure(length)} ${this.unit}`, 16, height - 22);
  }
}
