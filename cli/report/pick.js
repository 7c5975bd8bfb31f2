// SPDX-License-Identifier: BSD-3-Clause
// A click in the 3D view: what lies there, who has seen it, and how far it is from the last such place.

const kReach = { keyframe: 10, point: 7, line: 6, frame: 6 };  // pixels
const kBehind = 1.02;  // times as far as a surface is what it hides
const kListed = 24;                                            // keyframes that are named

class Picker {
  constructor(view) {
    this.view = view;
    this.measures = false;
    this.places = [];  // of the measurement
    this.panel = element("div", { id: "picked", className: "picked", hidden: true, role: "status" });
    byId("view").append(this.panel);
    const { canvas } = view;
    canvas.addEventListener("pointerdown", (event) => { this.down = [event.clientX, event.clientY]; });
    canvas.addEventListener("pointerup", (event) => {
      if (!this.down || event.button !== 0) return;
      const still = Math.hypot(event.clientX - this.down[0], event.clientY - this.down[1]) < 4;
      this.down = null;
      const box = canvas.getBoundingClientRect();
      if (still) this.take(this.at(event.clientX - box.left, event.clientY - box.top));
    });
  }

  setMeasures(on) {
    this.measures = on;
    this.clear();
    if (on) this.say("Measure", ["Click two places: points, lines, planes or keyframes."]);
  }

  clear() {
    this.places = [];
    this.panel.hidden = true;
    this.view.mark([]);
  }

  // From the map's coordinates to pixels of the canvas; w: depth in front of the camera.
  projection() {
    const { camera } = this.view.viewpoint;
    camera.updateMatrixWorld();
    const m = camera.projectionMatrix.clone().multiply(camera.matrixWorldInverse).multiply(this.view.world.matrixWorld).elements;
    const { clientWidth: width, clientHeight: height } = this.view.canvas;
    return (x, y, z) => {
      const w = m[3] * x + m[7] * y + m[11] * z + m[15];
      return { x: width / 2 * (1 + (m[0] * x + m[4] * y + m[8] * z + m[12]) / w), y: height / 2 * (1 - (m[1] * x + m[5] * y + m[9] * z + m[13]) / w), w };
    };
  }

  shows(layer) { return Boolean(this.view.layers[layer]?.visible); }

  // What lies at a pixel of the canvas: {kind, index, place}; null for nothing. Small things go before large ones, unless a
  // surface hides them.
  at(x, y) {
    const project = this.projection();
    const found = this.thingAt(project, x, y), surface = this.shows("surfaces") ? this.surfaceAt(x, y) : null;
    const hidden = found && surface && project(...found.place).w > kBehind * project(...surface.place).w;
    return hidden ? surface : found ?? surface;
  }

  thingAt(project, x, y) {
    return (this.shows("keyframes") && this.nearestOf("keyframe", run.keyframes, 7, project, x, y))
      || (this.shows("points") && this.nearestOf("point", run.points, 3, project, x, y))
      || (this.shows("lines") && this.lineAt(project, x, y))
      || (this.shows("path") && this.nearestOf("frame", run.poses, 7, project, x, y))
      || (this.shows("pictures") && this.pictureAt(project, x, y))
      || (this.shows("planes") && this.planeAt(project, x, y)) || null;
  }

  nearestOf(kind, list, size, project, x, y) {
    let best = null, least = Infinity;
    for (let i = 0; i * size < list.length; ++i) {
      const place = [list[size * i], list[size * i + 1], list[size * i + 2]];
      const seen = project(...place);
      const away = Math.hypot(seen.x - x, seen.y - y);
      if (!(seen.w > 0 && away < kReach[kind])) continue;
      const score = seen.w * (1 + away / kReach[kind]);  // the near one of those that are hit
      if (score < least) [best, least] = [{ kind, index: i, place }, score];
    }
    return best;
  }

  lineAt(project, x, y) {
    const { ends, axes } = run.lines;
    let best = null, least = kReach.line;
    for (let i = 0; i < axes.length; ++i) {
      const [from, to] = [ends.subarray(6 * i, 6 * i + 3), ends.subarray(6 * i + 3, 6 * i + 6)];
      const [a, b] = [project(...from), project(...to)];
      if (!(a.w > 0 && b.w > 0)) continue;
      const [dx, dy] = [b.x - a.x, b.y - a.y];
      const t = Math.min(Math.max(((x - a.x) * dx + (y - a.y) * dy) / (dx * dx + dy * dy || 1), 0), 1);
      const away = Math.hypot(a.x + t * dx - x, a.y + t * dy - y);
      if (away >= least) continue;
      const share = t / b.w / ((1 - t) / a.w + t / b.w);  // of the line in space
      least = away;
      best = { kind: "line", index: i, place: [0, 1, 2].map((k) => from[k] + share * (to[k] - from[k])) };
    }
    return best;
  }

  // A quadrilateral under the pixel, and where the line of sight meets it, by its two triangles.
  quadAt(corners, project, x, y) {
    const seen = corners.map((corner) => project(...corner));
    if (seen.some(({ w }) => !(w > 0))) return null;
    for (const [i, j, k] of [[0, 1, 2], [0, 2, 3]]) {
      const [a, b, c] = [seen[i], seen[j], seen[k]];
      const area = (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
      const u = ((x - a.x) * (c.y - a.y) - (c.x - a.x) * (y - a.y)) / area;
      const v = ((b.x - a.x) * (y - a.y) - (x - a.x) * (b.y - a.y)) / area;
      if (!(u >= 0 && v >= 0 && u + v <= 1)) continue;
      const shares = [(1 - u - v) / a.w, u / b.w, v / c.w];
      const sum = shares[0] + shares[1] + shares[2];
      return { depth: 1 / sum, place: [0, 1, 2].map((n) => (shares[0] * corners[i][n] + shares[1] * corners[j][n] + shares[2] * corners[k][n]) / sum) };
    }
    return null;
  }

  nearestQuad(kind, quads, project, x, y) {
    let best = null, least = Infinity;
    for (const { index, corners } of quads) {
      const hit = this.quadAt(corners, project, x, y);
      if (hit && hit.depth < least) [best, least] = [{ kind, index, place: hit.place }, hit.depth];
    }
    return best;
  }

  pictureAt(project, x, y) { return this.nearestQuad("keyframe", this.view.pictureQuads, project, x, y); }

  planeAt(project, x, y) {
    const { corners, axes } = run.planes;
    const quads = Array.from(axes, (_, index) => ({ index, corners: [0, 1, 2, 3].map((c) => [...corners.subarray(12 * index + 3 * c, 12 * index + 3 * c + 3)]) }));
    return this.nearestQuad("plane", quads, project, x, y);
  }

  surfaceAt(x, y) {
    const { clientWidth: width, clientHeight: height } = this.view.canvas;
    const inMap = (depth) => this.view.world.worldToLocal(new THREE.Vector3(2 * x / width - 1, 1 - 2 * y / height, depth).unproject(this.view.viewpoint.camera)).toArray();
    const [near, far] = [inMap(-1), inMap(1)];
    const hit = run.surfaces.hit(near, far.map((value, n) => value - near[n]));
    return hit && { kind: "surface", ...hit };
  }

  take(found) {
    if (!this.measures) {
      if (found) this.describe(found);
      else this.clear();
      return;
    }
    if (!found) return;
    if (this.places.length === 2) this.places = [];
    this.places.push(found.place);
    const [a, b] = this.places;
    this.view.mark(b ? [...a, ...b] : [], a);
    if (!b) return this.say("Measure", [`From a ${found.kind}. Click the other place.`]);
    const apart = Math.hypot(...a.map((value, k) => value - b[k])) * run.scale;
    this.say("Measure", [`${figure(apart)} ${run.unit}`, run.metres_per_unit ? "" : "The run has no ground truth that gives the scale."]);
  }

  say(title, lines, ...more) {
    this.panel.hidden = false;
    this.panel.replaceChildren(element("b", {}, title),
      element("button", { type: "button", className: "close", "aria-label": "Close", onclick: () => this.clear() }, "\u00d7"),
      ...lines.filter(Boolean).map((line) => element("p", {}, line)), ...more);
  }

  frameButton(row) {
    return element("button", { type: "button", title: "Show this frame", onclick: () => shown.set(row) }, run.frames.text("index", row) || String(row));
  }

  // The frames of keyframes, as buttons.
  witnesses(keyframes) {
    const rows = keyframes.map((k) => run.keyframe_rows[k]).filter((row) => row >= 0).sort((a, b) => a - b);
    if (rows.length === 0) return [];
    const kept = rows.filter((_, i) => rows.length <= kListed || Math.floor(i * kListed / rows.length) !== Math.floor((i - 1) * kListed / rows.length));
    return [element("div", { className: "witnesses" }, "Frames: ", ...kept.map((row) => this.frameButton(row)), kept.length < rows.length ? "…" : "")];
  }

  swatchOf(colours, i) {
    if (!run.coloured) return [];
    return [element("span", { className: "swatch", style: `color: rgb(${colours[3 * i]} ${colours[3 * i + 1]} ${colours[3 * i + 2]})` })];
  }

  describe(found) {
    const { kind, index, place } = found;
    const at = `at ${place.map((value) => figure(value * run.scale)).join(", ")} ${run.unit} in the map's axes`;
    const fly = element("button", { type: "button", onclick: () => this.view.viewpoint.flyTo(place) }, "Fly there");
    const seenBy = (witnesses) => (witnesses.counts[index] > 0 ? `seen by ${countOf(witnesses.counts[index], "keyframe")}` : "");
    const onPlane = (witnesses) => (!run.surfaces && witnesses.planes[index] >= 0 ? `lies on plane ${witnesses.planes[index]}` : "");
    const axis = (number, word) => (number >= 0 && number < 3 ? `${word} the room's ${kAxes[number]} axis` : `${word} none of the room's axes`);
    const rays = (keyframes) => this.view.mark(keyframes.flatMap((k) => [...place, ...run.keyframes.subarray(7 * k, 7 * k + 3)]), place);
    if (kind === "point") {
      const keyframes = run.pointWitnesses.keyframesOf(index);
      rays(keyframes);
      return this.say(`Point ${index}`, [at, seenBy(run.pointWitnesses), onPlane(run.pointWitnesses)], ...this.swatchOf(run.point_colours, index), fly, ...this.witnesses(keyframes));
    }
    if (kind === "line") {
      const keyframes = run.lineWitnesses.keyframesOf(index), ends = run.lines.ends.subarray(6 * index, 6 * index + 6);
      const length = Math.hypot(ends[3] - ends[0], ends[4] - ends[1], ends[5] - ends[2]) * run.scale;
      rays(keyframes);
      return this.say(`Line ${index}`, [`${figure(length)} ${run.unit} long, ${axis(run.lines.axes[index], "along")}`, seenBy(run.lineWitnesses), onPlane(run.lineWitnesses)],
        ...this.swatchOf(run.lines.colours, index), fly, ...this.witnesses(keyframes));
    }
    if (kind === "plane") {
      const members = (witnesses) => witnesses.planes.filter((plane) => plane === index).length;
      const corner = (c) => run.planes.corners.subarray(12 * index + 3 * c, 12 * index + 3 * c + 3);
      const side = (a, b) => figure(Math.hypot(...[0, 1, 2].map((k) => corner(b)[k] - corner(a)[k])) * run.scale);
      const quad = [0, 1, 2, 3].flatMap((c) => [...corner(c), ...corner((c + 1) % 4)]);
      this.view.mark(quad, place);
      return this.say(`Plane ${index}`, [`${side(0, 1)} by ${side(1, 2)} ${run.unit}, ${axis(run.planes.axes[index], "at right angles to")}`,
        `${countOf(members(run.pointWitnesses), "point")} and ${countOf(members(run.lineWitnesses), "line")} lie on it`], fly);
    }
    if (kind === "surface") {
      const of = densePlaneAt(found), metres = (value) => `${figure(value * run.scale)} ${run.unit}`;
      this.view.mark([], place);
      return this.say(of ? `Surface ${of.index}` : "Surface", of ? [`${figure(of.plane.area * run.scale ** 2)} ${run.unit === "m" ? "m\u00b2" : "square map units"} were seen, ${axis(of.plane.axis, "at right angles to")}`,
        `its distance is known to ${metres(of.plane.distance_sigma)} (standard deviation)`, at] : [at], fly);
    }
    const row = kind === "keyframe" ? run.keyframe_rows[index] : index;
    if (row >= 0) shown.set(row);
    this.view.mark([], place);
    const sees = kind === "keyframe" ? [`sees ${countOf(this.seenFrom(run.pointWitnesses, index), "point")} and ${countOf(this.seenFrom(run.lineWitnesses, index), "line")} of the map`] : [];
    const state = row >= 0 ? kStateWords[run.look(row)] ?? "" : "";
    const look = element("button", { type: "button", onclick: () => this.view.viewpoint.lookFrom((kind === "keyframe" ? run.keyframes : run.poses).subarray(7 * index, 7 * index + 7)) }, "Look from here");
    this.say(`${kind === "keyframe" ? "Keyframe" : "Frame"}${row >= 0 ? ` ${run.frames.text("index", row)}` : ""}`, [at, ...sees, state], look);
  }

  // How many landmarks a keyframe sees.
  seenFrom(witnesses, keyframe) {
    let count = 0;
    for (let i = 0; i < witnesses.counts.length; ++i) if (witnesses.keyframesOf(i).includes(keyframe)) ++count;
    return count;
  }
}
