// SPDX-License-Identifier: BSD-3-Clause
// The map from above, in two dimensions: for browsers without WebGL, and for pages built without three.js.

class TopView {
  constructor(canvas) {
    this.canvas = canvas;
    this.layers = new Set(kLayers.map((layer) => layer.name));
    redraws.push(() => this.draw());
    shown.listen(() => this.draw());
  }

  renew() { this.draw(); }

  setLayer(name, on) {
    if (on) this.layers.add(name);
    else this.layers.delete(name);
    this.draw();
  }

  // The levelled map's x to the right and z up, all of the paths and nearly all points in view.
  fit(width, height) {
    const box = boxOfRun();
    const margin = 24;
    this.zoom = Math.min((width - 2 * margin) / Math.max(box.high[0] - box.low[0], 1e-6),
      (height - 2 * margin) / Math.max(box.high[2] - box.low[2], 1e-6));
    this.pixel = ([x, , z]) => [width / 2 + this.zoom * (x - (box.low[0] + box.high[0]) / 2),
      height / 2 - this.zoom * (z - (box.low[2] + box.high[2]) / 2)];
    this.place = (list, at) => this.pixel(run.levelled(list[at], list[at + 1], list[at + 2]));
  }

  draw() {
    const cleared = clearedContext(this.canvas);
    if (!cleared) return;
    const { context, width, height } = cleared;
    this.fit(width, height);
    if (this.layers.has("surfaces") && run.surfaces) this.drawSurfaces(context, width, height);
    if (this.layers.has("points")) this.drawPoints(context);
    if (this.layers.has("lines")) this.drawLines(context);
    if (this.layers.has("truth") && run.truth) this.drawPath(context, run.truth.positions, 3, colour("truth"), [5, 4]);
    if (this.layers.has("path")) this.drawPath(context, run.poses, 7, colour("manhattan"), []);
    if (this.layers.has("keyframes")) this.drawKeyframes(context);
    if (run.frames.count > 0 && run.hasPose(shown.row)) this.drawCamera(context);
  }

  // Made once for each size of the canvas, when the texture is there.
  drawSurfaces(context, width, height) {
    if (this.above?.width === width && this.above?.height === height) return context.drawImage(this.above, 0, 0);
    run.surfaces.image().then((image) => {
      if (!image || this.above?.width === width && this.above?.height === height) return;
      this.above = element("canvas", { width, height });
      this.above.getContext("2d").putImageData(run.surfaces.fromAbove(image, width, height, this.pixel), 0, 0);
      this.draw();
    });
  }

  drawPoints(context) {
    const { point_colours: seen } = run;
    context.fillStyle = colour("points");
    for (let i = 0; i < run.points.length; i += 3) {
      if (run.coloured) context.fillStyle = `rgb(${seen[i]} ${seen[i + 1]} ${seen[i + 2]})`;
      const [x, y] = this.place(run.points, i);
      context.fillRect(x - 0.75, y - 0.75, 1.5, 1.5);
    }
  }

  drawLines(context) {
    context.lineWidth = 1.5;
    const { ends, axes } = run.lines;
    for (let i = 0; i < axes.length; ++i) {
      context.strokeStyle = colour(axisName(axes[i]));
      context.beginPath();
      context.moveTo(...this.place(ends, 6 * i));
      context.lineTo(...this.place(ends, 6 * i + 3));
      context.stroke();
    }
  }

  drawPath(context, positions, step, ink, dash) {
    context.strokeStyle = ink;
    context.lineWidth = 2;
    context.setLineDash(dash);
    context.beginPath();
    let broken = true;
    for (let i = 0; i < positions.length; i += step) {
      if (Number.isNaN(positions[i])) {
        broken = true;
        continue;
      }
      const [x, y] = this.place(positions, i);
      if (broken) context.moveTo(x, y);
      else context.lineTo(x, y);
      broken = false;
    }
    context.stroke();
    context.setLineDash([]);
  }

  drawKeyframes(context) {
    context.strokeStyle = colour("accent");
    for (let i = 0; i < run.keyframes.length; i += 7) {
      const [x, y] = this.place(run.keyframes, i);
      context.strokeRect(x - 2.5, y - 2.5, 5, 5);
    }
  }

  drawCamera(context) {
    const pose = run.poses.subarray(7 * shown.row, 7 * shown.row + 7);
    const [x, y] = this.place(pose, 0);
    const ahead = run.levelled(...forwardOf(pose));
    context.fillStyle = colour("accent");
    context.beginPath();
    context.arc(x, y, 5, 0, 2 * Math.PI);
    context.fill();
    context.strokeStyle = colour("accent");
    context.lineWidth = 2;
    context.beginPath();
    context.moveTo(x, y);
    context.lineTo(x + 18 * ahead[0], y - 18 * ahead[2]);
    context.stroke();
  }
}

// Layers that can be hidden, with the colour they are known by; "" has that of the axes.
const kLayers = [
  { name: "points", label: "Points", ink: "points", there: () => run.points.length > 0 },
  { name: "lines", label: "Lines", ink: "", there: () => run.lines.axes.length > 0 },
  { name: "surfaces", label: "Surfaces", there: () => Boolean(run.surfaces) },
  { name: "planes", label: "Planes", ink: "", there: () => !run.surfaces && run.planes.axes.length > 0 && !byId("view").classList.contains("flat") },
  { name: "path", label: "Estimate", ink: "manhattan", there: () => run.trajectoryThere },
  { name: "truth", label: "Ground truth", ink: "truth", there: () => Boolean(run.truth) },
  { name: "keyframes", label: "Keyframes", ink: "accent", there: () => run.keyframes.length > 0 },
  { name: "pictures", label: "Pictures", ink: "accent", there: () => run.keyframes.length > 0 && !byId("view").classList.contains("flat") && window.views?.texts?.length > 0 },
  { name: "grid", label: "Floor grid", ink: "none", there: () => !byId("view").classList.contains("flat") },
];

// The viewing direction of a pose x y z qx qy qz qw, world from camera.
function forwardOf([, , , x, y, z, w]) {
  return [2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)];
}

// Low and high corner, in the levelled map, of what is worth looking at: of points, of the path, of keyframes and of surfaces, each
// between the 2nd and the 98th percentile, so that what strays does not shrink the room. Lines have no say.
function boxOfRun() {
  const lists = [[run.points, 3], [run.poses, 7], [run.keyframes, 7], [run.surfaces?.places ?? [], 3]].map(([list, size]) => {
    const places = [], step = size * Math.max(1, Math.floor(list.length / size / 20000));
    for (let i = 0; i < list.length; i += step) if (!Number.isNaN(list[i])) places.push(run.levelled(list[i], list[i + 1], list[i + 2]));
    return places;
  });
  const box = { low: [0, 0, 0], high: [0, 0, 0] };
  for (let axis = 0; axis < 3; ++axis) {
    const ends = [];
    for (const places of lists) {
      const values = places.map((place) => place[axis]).sort((a, b) => a - b);
      const margin = values.length > 2 ? Math.ceil(0.02 * (values.length - 1)) : 0;  // at least one, of three or more
      if (values.length > 0) ends.push(values[margin], values[values.length - 1 - margin]);
    }
    if (ends.length === 0) continue;
    box.low[axis] = Math.min(...ends);
    box.high[axis] = Math.max(...ends);
  }
  return box;
}
