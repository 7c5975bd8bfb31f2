// SPDX-License-Identifier: BSD-3-Clause
// The Gaussian sphere of a frame, as the camera sees it from outside: normals that face it as dots, the planes through
// its segments as great circles, the room's axes with their cones.

class Sphere {
  constructor() {
    this.canvas = element("canvas", { role: "img", "aria-label": "Gaussian sphere: normals, segments and axes" });
    this.figure = element("figure", {}, this.canvas, element("figcaption", {}, "Gaussian sphere: normals and segments"));
    redraws.push(() => this.draw());
  }

  show(view) {
    this.view = view;
    this.figure.hidden = view.normals.length === 0 && !view.axes;
    this.draw();
  }

  draw() {
    const cleared = this.view ? clearedContext(this.canvas) : null;
    if (!cleared) return;
    const { context, width } = cleared;
    const radius = width / 2 - 4;
    this.place = ([x, y]) => [width / 2 + radius * x, width / 2 + radius * y];
    context.beginPath();
    context.arc(width / 2, width / 2, radius, 0, 2 * Math.PI);
    context.fillStyle = colour("page");
    context.fill();
    context.strokeStyle = colour("line");
    context.stroke();
    this.drawSegments(context);
    for (const normal of this.view.normals) {
      context.fillStyle = colour(axisName(this.axisOf(normal)));
      const [x, y] = this.place(normal);
      context.fillRect(x - 1.25, y - 1.25, 2.5, 2.5);
    }
    (this.view.axes ?? []).forEach((axis, i) => this.drawAxis(context, axis, i));
  }

  cone() { return (Number(run.settings.parameters?.["rotation.cone"]) || 15) * Math.PI / 180; }

  // The axis in whose cone the normal lies; -1 for none.
  axisOf(normal) {
    const least = Math.cos(this.cone());
    return (this.view.axes ?? []).findIndex((axis) => Math.abs(dot(axis, normal)) >= least);
  }

  drawSegments(context) {
    const [fx, fy, cx, cy] = run.pinhole, [width, height] = run.imageSize;
    const ray = (u, v) => [(u * width - cx) / fx, (v * height - cy) / fy, 1];
    context.lineWidth = 0.8;
    context.globalAlpha = 0.5;
    for (const { ends, axis } of this.view.lines.filter((line) => line.axis >= 0).slice(0, 30)) {
      const pole = cross(ray(ends[0], ends[1]), ray(ends[2], ends[3]));
      context.strokeStyle = colour(axisName(axis));
      this.drawCircle(context, pole, Math.PI / 2);
    }
    context.globalAlpha = 1;
  }

  // An axis pierces the sphere twice; the near end is marked.
  drawAxis(context, axis, index) {
    const near = axis[2] > 0 ? axis.map((x) => -x) : axis;
    context.strokeStyle = context.fillStyle = colour(kAxes[index]);
    context.lineWidth = 1.6;
    this.drawCircle(context, near, this.cone());
    context.beginPath();
    context.moveTo(...this.place([0, 0]));
    context.lineTo(...this.place(near));
    context.stroke();
    context.beginPath();
    context.arc(...this.place(near), 3.5, 0, 2 * Math.PI);
    context.fill();
  }

  // The near half of a circle of directions around `pole`.
  drawCircle(context, pole, angle) {
    const unit = normalised(pole);
    const side = normalised(cross(unit, Math.abs(unit[0]) < 0.8 ? [1, 0, 0] : [0, 1, 0]));
    const other = cross(unit, side);
    context.beginPath();
    let broken = true;
    for (let i = 0; i <= 72; ++i) {
      const turn = i * Math.PI / 36;
      const p = [0, 1, 2].map((k) => Math.cos(angle) * unit[k] + Math.sin(angle) * (Math.cos(turn) * side[k] + Math.sin(turn) * other[k]));
      if (p[2] > 0.02) broken = true;
      else if (broken) context.moveTo(...this.place(p));
      else context.lineTo(...this.place(p));
      if (p[2] <= 0.02) broken = false;
    }
    context.stroke();
  }
}

function normalised(a) {
  const length = Math.sqrt(dot(a, a)) || 1;
  return a.map((x) => x / length);
}
