// SPDX-License-Identifier: BSD-3-Clause
// The 3D view: map, paths and cameras, drawn only when something has changed.

const kPointsInMotion = 10000;
const kPointSize = 3;     // pixels
const kMostPictures = 150;  // in the frustums of keyframes

class Scene3D {
  constructor(canvas, { context, software }) {
    this.canvas = canvas;
    this.software = software;
    this.renderer = new THREE.WebGLRenderer({ canvas, context });
    this.renderer.setPixelRatio(software ? 1 : Math.min(window.devicePixelRatio || 1, 2));
    this.scene = new THREE.Scene();
    this.level = new THREE.Group();  // metres where the scale is known; levelled, y up, where the map's y points down
    this.level.rotation.x = Math.PI;
    this.level.scale.setScalar(run.scale);
    this.world = new THREE.Group();  // the map
    this.level.add(this.world);
    this.scene.add(this.level);
    this.layers = {};
    this.materials = {};  // by layer: they outlive what they are on
    this.hidden = new Set();
    this.textures = new Map();  // of keyframes, by row
    this.marked = [];
    this.seenColours = true;  // as soon as there are any
    this.pathColours = "state";
    this.legend = new Legend(canvas.parentElement);
    this.measure();
    this.viewpoint = new Viewpoint(canvas, this.world, this.seen, () => this.request());
    this.build();
    shown.listen(() => this.showFrame());
    redraws.push(() => this.restyle());
    new ResizeObserver(() => this.resize()).observe(canvas.parentElement);
    this.resize();
    this.restyle();
  }

  measure() {
    const { low, high } = boxOfRun();
    const at = (corner) => this.level.localToWorld(new THREE.Vector3(...corner));
    this.world.quaternion.setFromUnitVectors(new THREE.Vector3(...run.down), new THREE.Vector3(0, 1, 0));
    this.level.updateMatrixWorld();
    this.radius = Math.max(at(low).distanceTo(at(high)) / 2, 0.1);
    const corners = Array.from({ length: 8 }, (_, i) => at(low.map((value, k) => (i >> k & 1 ? high[k] : value))));
    this.seen = { middle: at(low).add(at(high)).multiplyScalar(0.5), radius: this.radius, corners };
    this.floor = high[1] + 0.02 * this.radius / run.scale;  // a little below what is seen of it
  }

  add(name, object, to = this.world) {
    this.layers[name] = object;
    object.frustumCulled = false;
    object.visible = !this.hidden.has(name);
    to.add(object);
    return object;
  }

  material(name, make) { return (this.materials[name] ??= make()); }

  // Segments `width` pixels wide, which plain lines of WebGL cannot be; coloured: each in a colour of its own.
  addWide(name, ends, width, coloured) {
    if (ends.length === 0) return;
    const geometry = new THREE.LineSegmentsGeometry().setPositions(ends);
    if (coloured) geometry.setColors(new Float32Array(ends.length));
    const material = this.material(name, () => new THREE.LineMaterial({ linewidth: width, vertexColors: coloured }));
    this.add(name, new THREE.LineSegments2(geometry, material));
  }

  // colourOf(i): of the i-th segment.
  paint(name, count, colourOf) {
    if (!this.layers[name]) return;
    const { data } = this.layers[name].geometry.attributes.instanceColorStart;
    for (let i = 0; i < count; ++i) {
      const { r, g, b } = colourOf(i);
      data.array.set([r, g, b, r, g, b], 6 * i);
    }
    data.needsUpdate = true;
  }

  build() {
    const addPlain = (name, ends, to) => this.add(name,
      new THREE.LineSegments(geometryOf(new Float32Array(ends)), this.material(name, () => new THREE.LineBasicMaterial())), to);
    addPlain("grid", this.gridEnds(), this.level);
    const dots = this.material("points", () => new THREE.PointsMaterial({ size: kPointSize, sizeAttenuation: false, vertexColors: true }));
    const points = geometryOf(mixedTriples(run.points)).setAttribute("color", new THREE.BufferAttribute(new Float32Array(run.points.length), 3));
    this.add("points", new THREE.Points(points, dots));
    this.addWide("lines", run.lines.ends, 2, true);
    if (run.surfaces) this.add("surfaces", this.surfaces ??= this.surfaceMesh(run.surfaces));
    else this.addPlanes(run.planes);
    this.pathRows = [];  // the later frame of each step of the path
    const steps = [];
    for (let row = 1; row < run.frames.count; ++row) {
      if (!run.hasPose(row) || !run.hasPose(row - 1)) continue;
      this.pathRows.push(row);
      for (const r of [row - 1, row]) steps.push(...run.poses.subarray(7 * r, 7 * r + 3));
    }
    this.addWide("path", new Float32Array(steps), 3, true);
    if (run.truth) this.addWide("truth", joinedPoints(run.truth.positions), 1.5, false);
    const size = 0.05 * this.radius / run.scale;
    this.frustum = 0.6 * size;
    const small = [];
    for (let i = 0; i < run.keyframes.length; i += 7) small.push(...frustumEnds(run.keyframes.subarray(i, i + 7), 0.6 * size));
    addPlain("keyframes", small);
    this.eye = addPlain("eye", frustumEnds([0, 0, 0, 0, 0, 0, 1], 3 * size));
    this.eyePicture ??= this.pictureMesh();
    this.eyePicture.geometry.dispose();
    this.eyePicture.geometry = this.quadGeometry(frustumCorners([0, 0, 0, 0, 0, 0, 1], 3 * size));
    this.eye.add(this.eyePicture);
    this.add("marks", new THREE.LineSegments(geometryOf(new Float32Array(this.marked)), this.material("marks", () => new THREE.LineBasicMaterial({ depthTest: false }))));
    this.addPictures();
  }

  // Translucent rectangles, two triangles each; they hide neither each other nor what is behind.
  addPlanes({ corners, axes }) {
    const positions = new Float32Array(18 * axes.length);
    for (let i = 0; i < axes.length; ++i)
      [0, 1, 2, 0, 2, 3].forEach((c, k) => positions.set(corners.subarray(12 * i + 3 * c, 12 * i + 3 * c + 3), 18 * i + 3 * k));
    const geometry = geometryOf(positions).setAttribute("color", new THREE.BufferAttribute(new Float32Array(positions.length), 3));
    const material = this.material("planes", () => new THREE.MeshBasicMaterial(
      { vertexColors: true, transparent: true, opacity: 0.18, side: THREE.DoubleSide, depthWrite: false }));
    this.add("planes", new THREE.Mesh(geometry, material));
  }

  // Grey until the texture is there. What lies on the surfaces is drawn before them.
  surfaceMesh(surfaces) {
    const { places, textures, indices } = surfaces;
    const geometry = geometryOf(places).setAttribute("uv", new THREE.BufferAttribute(textures, 2)).setIndex(new THREE.BufferAttribute(indices, 1));
    const material = new THREE.MeshBasicMaterial({ color: 0x808080, polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 4 });
    surfaces.image().then((image) => {
      if (!image) return notice("The texture of the surfaces cannot be decoded: they are grey.");
      material.map = this.textureOf(image);
      material.map.flipY = false;  // its places are told from the upper left corner
      material.color.set(0xffffff);
      material.needsUpdate = true;
      this.request();
    });
    return new THREE.Mesh(geometry, material);
  }

  quadGeometry(corners) {
    const positions = new Float32Array([0, 1, 2, 0, 2, 3].flatMap((c) => corners[c]));
    const places = new Float32Array([0, 1, 1, 1, 1, 0, 0, 1, 1, 0, 0, 0]);
    return geometryOf(positions).setAttribute("uv", new THREE.BufferAttribute(places, 2));
  }

  pictureMesh(texture = null, geometry = new THREE.BufferGeometry()) {
    const mesh = new THREE.Mesh(geometry, new THREE.MeshBasicMaterial({ map: texture, side: THREE.DoubleSide }));
    mesh.frustumCulled = false;
    return mesh;
  }

  textureOf(image) {
    const texture = new THREE.Texture(image);
    texture.colorSpace = THREE.SRGBColorSpace;
    texture.generateMipmaps = true;
    texture.needsUpdate = true;
    return texture;
  }

  // The pictures of keyframes in their frustums, where they are among the views. Each is decoded once.
  addPictures() {
    const group = this.add("pictures", new THREE.Group());
    this.pictureQuads = [];
    this.eyePicture.visible = group.visible && Boolean(this.eyePicture.material.map);
    if (!window.views?.rows) return;
    const places = new Map(views.rows.map((row, at) => [row, at]));
    const there = Array.from(run.keyframe_rows, (row, index) => ({ row, index })).filter(({ row }) => places.has(row));
    const step = Math.ceil(there.length / kMostPictures);
    for (const { row, index } of there.filter((_, i) => i % step === 0)) {
      const corners = frustumCorners(run.keyframes.subarray(7 * index, 7 * index + 7), this.frustum);
      this.pictureQuads.push({ index, corners });
      const mesh = this.pictureMesh(null, this.quadGeometry(corners));
      mesh.visible = false;
      group.add(mesh);
      const show = (texture) => {
        mesh.material.map = texture;
        mesh.material.needsUpdate = mesh.visible = true;
        this.request();
      };
      const known = this.textures.get(row);
      if (known) show(known);
      else this.loadPicture(row, places.get(row), show);
    }
  }

  loadPicture(row, at, show) {
    const blob = decodeView(views.texts[at]).image;
    if (!blob) return;
    const image = new Image();
    image.onload = () => {
      URL.revokeObjectURL(image.src);
      const texture = this.textures.get(row) ?? this.textureOf(image);
      this.textures.set(row, texture);
      show(texture);
    };
    image.src = URL.createObjectURL(blob);
  }

  // The picture of the shown frame, when it is there: a copy, since the element goes on to the next one before it is drawn.
  showPicture(image) {
    const copy = element("canvas", { width: image.naturalWidth, height: image.naturalHeight });
    copy.getContext("2d").drawImage(image, 0, 0);
    this.eyePicture.material.map?.dispose();
    this.eyePicture.material.map = this.textureOf(copy);
    this.eyePicture.material.needsUpdate = true;
    this.eyePicture.visible = this.layers.pictures.visible;
    this.request();
  }

  // Segments over everything else, and a cross at a place.
  mark(ends, place = null) {
    const size = 0.015 * this.radius / run.scale;
    const cross = place === null ? [] : [0, 1, 2].flatMap((axis) => [-size, size].flatMap((by) => place.map((value, k) => value + (k === axis ? by : 0))));
    this.marked = [...ends, ...cross];
    const old = this.layers.marks;
    this.world.remove(old);
    old.geometry.dispose();
    this.add("marks", new THREE.LineSegments(geometryOf(new Float32Array(this.marked)), this.materials.marks));
    this.request();
  }

  setPointSize(size) {
    this.materials.points.size = size;
    this.request();
  }

  // seen: points and lines in the colours in which they were seen, else by the Manhattan axes.
  setSeenColours(seen) {
    this.seenColours = seen;
    this.restyle();
  }

  // by: "state", "error" or "time".
  setPathColours(by) {
    this.pathColours = by;
    this.restyle();
  }

  pathColour(row, states) {
    const shareOf = { error: (r) => run.errors.position_m[r] / this.worst, time: (r) => r / Math.max(run.frames.count - 1, 1) }[this.pathColours];
    if (!shareOf) return states[run.look(row)] ?? states.manhattan;
    return lightOf(rampColour(shareOf(row)), 0);
  }

  // The run has grown.
  renew() {
    const old = Object.values(this.layers);
    this.layers = {};
    this.measure();
    this.build();
    for (const object of old) {
      if (object === this.surfaces) continue;
      object.removeFromParent();
      object.traverse((part) => { if (part !== this.eyePicture) part.geometry?.dispose(); });
    }
    this.viewpoint.grow(this.seen);
  }

  // Squares of 1 m (or of a power of ten that suits the map) at the height of the lowest points.
  gridEnds() {
    const extent = 2 * this.radius / run.scale;
    const step = run.metres_per_unit && this.radius < 40 ? 1 / run.scale : 10 ** Math.floor(Math.log10(extent / 4));
    this.square = step * run.scale;
    const { low, high } = boxOfRun();
    const [left, near] = [0, 2].map((a) => step * (Math.floor(low[a] / step) - 1));
    const [right, far] = [0, 2].map((a) => step * (Math.ceil(high[a] / step) + 1));
    const ends = [];
    for (let x = left; x <= right + step / 2; x += step) ends.push(x, this.floor, near, x, this.floor, far);
    for (let z = near; z <= far + step / 2; z += step) ends.push(left, this.floor, z, right, this.floor, z);
    return ends;
  }

  restyle() {
    const ink = (name) => new THREE.Color(colour(name));
    this.scene.background = ink("stage");
    for (const [name, from] of [["grid", "grid"], ["marks", "accent"], ["truth", "truth"], ["keyframes", "accent"], ["eye", "accent"]])
      this.layers[name]?.material.color.copy(ink(from));
    const axes = [...kAxes, "none"].map(ink);
    const seen = this.seenColours && run.coloured;
    this.paint("lines", run.lines.axes.length, (i) => (seen ? lightOf(run.lines.colours, i) : axes[run.lines.axes[i]] ?? axes[3]));
    const dots = this.layers.points.geometry.attributes.color, plain = ink("points");
    if (seen) dots.array.set(mixedTriples(run.point_colours).map((value) => kLight[value]));
    else for (let i = 0; i < dots.count; ++i) dots.setXYZ(i, plain.r, plain.g, plain.b);
    dots.needsUpdate = true;
    if (this.layers.planes) this.paintPlanes(axes);
    this.worst = run.errors ? quantile(run.errors.position_m.filter((value) => !Number.isNaN(value)), 0.98) || 1 : 1;
    const states = Object.fromEntries(Object.keys(kStateWords).map((s) => [s, ink(s)]));
    this.paint("path", this.pathRows.length, (i) => this.pathColour(this.pathRows[i], states));
    this.legend.show({ by: this.pathColours, worst: this.worst, square: this.square });
    this.showFrame();
  }

  paintPlanes(axes) {
    const { color } = this.layers.planes.geometry.attributes;
    run.planes.axes.forEach((axis, i) => {
      const { r, g, b } = axes[axis] ?? axes[3];
      for (let k = 6 * i; k < 6 * i + 6; ++k) color.setXYZ(k, r, g, b);
    });
    color.needsUpdate = true;
  }

  setLayer(name, on) {
    if (on) this.hidden.delete(name);
    else this.hidden.add(name);
    if (this.layers[name]) this.layers[name].visible = on;
    if (name === "pictures") this.eyePicture.visible = on && Boolean(this.eyePicture.material.map);
    this.request();
  }

  showFrame() {
    const posed = run.frames.count > 0 && run.hasPose(shown.row);
    this.eye.visible = posed;
    if (posed) {
      const [x, y, z, qx, qy, qz, qw] = run.poses.subarray(7 * shown.row, 7 * shown.row + 7);
      this.eye.position.set(x, y, z);
      this.eye.quaternion.set(qx, qy, qz, qw);
      this.viewpoint.showFrame();
    }
    this.request();
  }

  resize() {
    const { clientWidth: width, clientHeight: height } = this.canvas.parentElement;
    if (width === 0 || height === 0) return;
    const first = this.width === undefined;
    this.width = width;
    this.renderer.setSize(width, height, false);
    this.viewpoint.shape(width / height);
    if (first) this.viewpoint.home();
    this.draw();
  }

  request() {
    if (this.waiting) return;
    this.waiting = true;
    requestAnimationFrame(() => this.draw());
  }

  // A software renderer draws some of the points while the view moves, all of them when it rests.
  draw(resting = !this.software) {
    this.waiting = false;
    clearTimeout(this.rest);
    const { geometry } = this.layers.points;
    const abridged = !resting && geometry.attributes.position.count > kPointsInMotion;
    geometry.setDrawRange(0, abridged ? kPointsInMotion : Infinity);
    this.renderer.render(this.scene, this.viewpoint.camera);
    if (!this.software) return;
    const gl = this.renderer.getContext();
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));  // waits: else frames would queue up
    if (abridged) this.rest = setTimeout(() => this.draw(true), 200);
  }
}
