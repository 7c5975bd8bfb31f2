// SPDX-License-Identifier: BSD-3-Clause
// What the 3D view is made of: a context to draw with, and positions in the forms that three.js wants.

// A context that a software renderer can serve too; null without WebGL.
function webglContext(canvas) {
  if (typeof THREE === "undefined") return null;
  const probe = document.createElement("canvas").getContext("webgl2");
  if (!probe) return null;
  const info = probe.getExtension("WEBGL_debug_renderer_info");
  const name = info ? String(probe.getParameter(info.UNMASKED_RENDERER_WEBGL)) : "";
  const software = /swiftshader|llvmpipe|software|basic render/i.test(name);
  probe.getExtension("WEBGL_lose_context")?.loseContext();
  const context = canvas.getContext("webgl2", { antialias: !software, alpha: false, powerPreference: "high-performance" });
  return context && { context, software };
}

function geometryOf(positions) {
  return new THREE.BufferGeometry().setAttribute("position", new THREE.BufferAttribute(positions, 3));
}

// The same triples in an order whose beginning is spread over all of them.
function mixedTriples(values) {
  const count = values.length / 3;
  const step = [7919, 7907].find((prime) => count % prime !== 0) ?? 1;
  const result = new Float32Array(values.length);
  for (let i = 0; i < count; ++i) {
    const from = 3 * ((i * step) % count);
    result.set(values.subarray(from, from + 3), 3 * i);
  }
  return result;
}

// Colours 0 to 255 as a screen has them, as the light that three.js reckons with.
const kLight = Float32Array.from({ length: 256 }, (_, value) => {
  const share = value / 255;
  return share <= 0.04045 ? share / 12.92 : ((share + 0.055) / 1.055) ** 2.4;
});
function lightOf(colours, i) { return { r: kLight[colours[3 * i]], g: kLight[colours[3 * i + 1]], b: kLight[colours[3 * i + 2]] }; }

// From dark blue by green to yellow, for shares from 0 to 1; grey for what is no number.
const kRamp = [[68, 1, 84], [59, 82, 139], [33, 145, 140], [94, 201, 98], [253, 231, 37]];
function rampColour(share) {
  if (!Number.isFinite(share)) return [128, 128, 128];
  const at = Math.min(Math.max(share, 0), 1) * (kRamp.length - 1), low = Math.min(Math.floor(at), kRamp.length - 2);
  return kRamp[low].map((value, k) => Math.round(value + (at - low) * (kRamp[low + 1][k] - value)));
}

// A path as the segments between its points.
function joinedPoints(positions) {
  const ends = [];
  for (let i = 3; i < positions.length; i += 3) ends.push(...positions.subarray(i - 3, i + 3));
  return new Float32Array(ends);
}

// The corners of what a camera x y z qx qy qz qw sees, `size` before it.
function frustumCorners([x, y, z, qx, qy, qz, qw], size) {
  const [fx, fy] = run.pinhole, [width, height] = run.imageSize;
  const w = Math.min(Math.max(width / 2 / fx, 0.2), 2), h = Math.min(Math.max(height / 2 / fy, 0.2), 2);
  const turn = new THREE.Quaternion(qx, qy, qz, qw);
  const corner = (u, v) => new THREE.Vector3(u * w, v * h, 1).multiplyScalar(size).applyQuaternion(turn).add(new THREE.Vector3(x, y, z)).toArray();
  return [corner(-1, -1), corner(1, -1), corner(1, 1), corner(-1, 1)];
}

// The camera as 8 segments.
function frustumEnds(pose, size) {
  const [x, y, z] = pose, corners = frustumCorners(pose, size);
  return corners.flatMap((c, i) => [x, y, z, ...c, ...c, ...corners[(i + 1) % 4]]);
}
