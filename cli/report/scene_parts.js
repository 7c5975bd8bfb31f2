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

// The same points in an order whose beginning is spread over all of them.
function mixedPoints(positions) {
  const count = positions.length / 3;
  const step = [7919, 7907].find((prime) => count % prime !== 0) ?? 1;
  const result = new Float32Array(positions.length);
  for (let i = 0; i < count; ++i) {
    const from = 3 * ((i * step) % count);
    result.set(positions.subarray(from, from + 3), 3 * i);
  }
  return result;
}

// A path as the segments between its points.
function joinedPoints(positions) {
  const ends = [];
  for (let i = 3; i < positions.length; i += 3) ends.push(...positions.subarray(i - 3, i + 3));
  return new Float32Array(ends);
}

// A camera x y z qx qy qz qw as 8 segments, `size` deep.
function frustumEnds([x, y, z, qx, qy, qz, qw], size) {
  const [fx, fy] = run.pinhole, [width, height] = run.imageSize;
  const w = Math.min(Math.max(width / 2 / fx, 0.2), 2), h = Math.min(Math.max(height / 2 / fy, 0.2), 2);
  const turn = new THREE.Quaternion(qx, qy, qz, qw);
  const corner = (u, v) => new THREE.Vector3(u * w, v * h, 1).multiplyScalar(size).applyQuaternion(turn).add(new THREE.Vector3(x, y, z)).toArray();
  const corners = [corner(-1, -1), corner(1, -1), corner(1, 1), corner(-1, 1)];
  return corners.flatMap((c, i) => [x, y, z, ...c, ...c, ...corners[(i + 1) % 4]]);
}
