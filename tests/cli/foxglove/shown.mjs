// SPDX-License-Identifier: BSD-3-Clause
// Messages as JSON.

export function text(_, value) {
  if (typeof value === "bigint") return String(value);
  return ArrayBuffer.isView(value) ? Array.from(value) : value;
}

// An image by its size, a cloud by its points.
export function shown(type, message) {
  if (type.endsWith("/CompressedImage")) return { ...message, data: sizeOfJpeg(message.data) };
  if (type.endsWith("/PointCloud2")) return { ...message, data: message.data.length };
  return message;
}

function sizeOfJpeg(data) {
  const view = new DataView(data.buffer, data.byteOffset, data.byteLength);
  for (let at = 2; at + 9 < view.byteLength; at += 2 + view.getUint16(at + 2)) {
    const marker = view.getUint16(at);
    if (marker >= 0xffc0 && marker <= 0xffc2) return [view.getUint16(at + 7), view.getUint16(at + 5)];
  }
  return null;
}
