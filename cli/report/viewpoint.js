// SPDX-License-Identifier: BSD-3-Clause
// Where the 3D view is looked at from: orbit by mouse, touch and keys, home, and along with the shown camera.

class Viewpoint {
  // world: the group in which the map stands; seen: { middle, radius, corners } of what is to be seen; changed: asks for a picture.
  constructor(canvas, world, seen, changed) {
    Object.assign(this, { world, changed }, seen);
    this.follows = false;
    this.camera = new THREE.PerspectiveCamera(50, 1, this.radius / 500, 60 * this.radius);
    this.controls = new THREE.OrbitControls(this.camera, canvas);
    this.controls.addEventListener("change", changed);
    this.controls.addEventListener("start", () => { this.moved = true; });
    canvas.addEventListener("keydown", (event) => this.key(event));
    this.home();
  }

  // There is more to be seen. Whoever has not moved goes on seeing all of it.
  grow({ middle, radius, corners }) {
    const near = Math.abs(radius / this.radius - 1) < 0.05 && middle.distanceTo(this.middle) < 0.05 * radius;
    if (near) return;
    Object.assign(this, { middle, radius, corners });
    Object.assign(this.camera, { near: radius / 500, far: 60 * radius });
    this.camera.updateProjectionMatrix();
    if (!this.moved && !this.follows) this.home();
  }

  setFollow(on) {
    this.follows = on;
    if (on) this.behind();
    else this.home();
  }

  // Which way a camera of the map looks.
  aheadOf(pose) { return new THREE.Vector3(...forwardOf(pose)).transformDirection(this.world.matrixWorld); }

  // Where the shown camera stands, and which way it looks over the floor.
  heading() {
    const pose = run.poses.subarray(7 * shown.row, 7 * shown.row + 7);
    const at = this.world.localToWorld(new THREE.Vector3(pose[0], pose[1], pose[2]));
    const { x, z } = this.aheadOf(pose);
    return { at, angle: Math.atan2(x, z) };
  }

  behind() {
    if (run.frames.count === 0 || !run.hasPose(shown.row)) return;
    const { at, angle } = this.heading();
    this.angle = angle;
    const back = 0.45 * this.radius;
    this.controls.target.copy(at);
    this.camera.position.set(at.x - back * Math.sin(angle), at.y + 0.45 * back, at.z - back * Math.cos(angle));
    this.controls.update();
    this.changed();
  }

  // Goes along with the shown camera and turns with it, from wherever the user looks at it.
  chase() {
    const { at, angle } = this.heading();
    const offset = this.camera.position.clone().sub(this.controls.target);
    offset.applyAxisAngle(new THREE.Vector3(0, 1, 0), angle - (this.angle ?? angle));
    this.angle = angle;
    this.controls.target.copy(at);
    this.camera.position.copy(at).add(offset);
    this.controls.update();
  }

  // Goes along with the shown frame if it is to.
  showFrame() {
    if (this.follows) this.chase();
  }

  shape(aspect) {
    this.camera.aspect = aspect;
    this.camera.updateProjectionMatrix();
  }

  // From above and aside, as near as all corners are in the picture.
  home() {
    this.moved = false;
    const from = new THREE.Vector3(-0.35, 0.75, 0.62).normalize(), right = new THREE.Vector3(0, 1, 0).cross(from).normalize(), up = from.clone().cross(right);
    const high = Math.tan(this.camera.fov * Math.PI / 360) * 0.96, wide = high * this.camera.aspect;
    const away = this.corners.map((corner) => {
      const offset = corner.clone().sub(this.middle);
      return offset.dot(from) + Math.max(Math.abs(offset.dot(right)) / wide, Math.abs(offset.dot(up)) / high);
    });
    this.controls.target.copy(this.middle);
    this.camera.position.copy(this.middle).addScaledVector(from, Math.max(...away, 0.2 * this.radius));
    this.controls.update();
    this.changed();
  }

  // Goes near a place of the map, from the side on which it is looked at.
  flyTo(place) {
    const at = this.world.localToWorld(new THREE.Vector3(...place));
    const back = this.camera.position.clone().sub(this.controls.target).setLength(0.4 * this.radius);
    this.moved = true;
    this.controls.target.copy(at);
    this.camera.position.copy(at).add(back);
    this.controls.update();
    this.changed();
  }

  // Looks from where a camera stood, the way it looked.
  lookFrom(pose) {
    const at = this.world.localToWorld(new THREE.Vector3(pose[0], pose[1], pose[2]));
    const ahead = this.aheadOf(pose);
    this.moved = true;
    this.camera.position.copy(at).addScaledVector(ahead, -0.15 * this.radius);
    this.controls.target.copy(at).addScaledVector(ahead, 0.4 * this.radius);
    this.controls.update();
    this.changed();
  }

  reset() {
    if (this.follows) this.behind();
    else this.home();
  }

  // right and up in radians, nearer as a factor.
  orbit(right, up, nearer) {
    const offset = this.camera.position.clone().sub(this.controls.target);
    const length = offset.length() * nearer;
    const polar = Math.min(Math.max(Math.acos(offset.y / offset.length()) - up, 0.05), Math.PI - 0.05);
    const azimuth = Math.atan2(offset.x, offset.z) + right;
    offset.set(Math.sin(polar) * Math.sin(azimuth), Math.cos(polar), Math.sin(polar) * Math.cos(azimuth)).multiplyScalar(length);
    this.camera.position.copy(this.controls.target).add(offset);
    this.controls.update();
    this.changed();
  }

  key(event) {
    const turns = { ArrowLeft: [-0.1, 0, 1], ArrowRight: [0.1, 0, 1], ArrowUp: [0, 0.08, 1], ArrowDown: [0, -0.08, 1], "+": [0, 0, 0.9], "=": [0, 0, 0.9], "-": [0, 0, 1.1] };
    const turn = turns[event.key];
    if (!turn || event.ctrlKey || event.metaKey) return;
    this.moved = true;
    this.orbit(...turn);
    event.preventDefault();
    event.stopPropagation();
  }
}
