// SPDX-License-Identifier: BSD-3-Clause
// The surfaces of the dense model: triangles that are seen from the side from which they were filmed, with one texture.

class Surfaces {
  constructor({ places, textures, indices, jpeg }) {
    Object.assign(this, { places, textures, indices, jpeg });
  }

  // The texture; null where the browser cannot read it.
  image() {
    this.loading ??= new Promise((resolve) => {
      const image = new Image();
      image.onload = () => resolve(image);
      image.onerror = () => resolve(null);
      image.src = URL.createObjectURL(new Blob([bytesOf(this.jpeg)], { type: "image/jpeg" }));
      this.jpeg = null;
    });
    return this.loading;
  }

  // Where a ray (from, along: of the map) first meets a surface that it sees: {place, normal}, null for nowhere.
  hit(from, along) {
    const { places, indices } = this;
    let best = null, least = Infinity;
    for (let t = 0; t < indices.length; t += 3) {
      const [i, j, k] = [3 * indices[t], 3 * indices[t + 1], 3 * indices[t + 2]];
      const a = [places[j] - places[i], places[j + 1] - places[i + 1], places[j + 2] - places[i + 2]];
      const b = [places[k] - places[i], places[k + 1] - places[i + 1], places[k + 2] - places[i + 2]];
      const normal = cross(a, b), towards = -dot(normal, along);
      if (!(towards > 0)) continue;
      const to = [from[0] - places[i], from[1] - places[i + 1], from[2] - places[i + 2]];
      const far = dot(to, normal) / towards;
      if (!(far > 0 && far < least)) continue;
      const turned = cross(to, along), u = -dot(b, turned) / towards, v = dot(a, turned) / towards;
      if (!(u >= 0 && v >= 0 && u + v <= 1)) continue;
      least = far;
      best = { place: from.map((value, n) => value + far * along[n]), normal };
    }
    return best;
  }

  // As they are seen from above; toPixel: of a place of the levelled map. For browsers without WebGL.
  fromAbove(image, width, height, toPixel) {
    const { textures, indices } = this, levelled = [];
    for (let i = 0; i < this.places.length; i += 3) levelled.push(run.levelled(this.places[i], this.places[i + 1], this.places[i + 2]));
    const picture = new ImageData(width, height), pixels = new Uint32Array(picture.data.buffer);
    const texels = texelsOf(image), top = new Float32Array(width * height).fill(Infinity);
    for (let t = 0; t < indices.length; t += 3) {
      const corners = [0, 1, 2].map((n) => indices[t + n]);
      const [a, b, c] = corners.map((i) => toPixel(levelled[i]));
      const area = (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]);
      if (!(area < 0)) continue;  // from below
      const cells = (k, size) => [Math.max(0, Math.ceil(Math.min(a[k], b[k], c[k]))), Math.min(size - 1, Math.floor(Math.max(a[k], b[k], c[k])))];
      const [left, right] = cells(0, width), [upper, lower] = cells(1, height);
      const mixed = (of) => (p, q) => of(corners[0]) * (1 - p - q) + of(corners[1]) * p + of(corners[2]) * q;
      const [down, u, v] = [mixed((i) => levelled[i][1]), mixed((i) => textures[2 * i]), mixed((i) => textures[2 * i + 1])];
      for (let y = upper; y <= lower; ++y) {
        for (let x = left; x <= right; ++x) {
          const p = ((x - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (y - a[1])) / area;
          const q = ((b[0] - a[0]) * (y - a[1]) - (x - a[0]) * (b[1] - a[1])) / area;
          if (p < 0 || q < 0 || p + q > 1 || down(p, q) >= top[y * width + x]) continue;
          top[y * width + x] = down(p, q);
          pixels[y * width + x] = texels.at(u(p, q), v(p, q));
        }
      }
    }
    return picture;
  }
}

// The pixels of an image by shares of its width and height.
function texelsOf(image) {
  const shrunk = Math.min(1, 2048 / Math.max(image.naturalWidth, image.naturalHeight));
  const width = Math.max(1, Math.round(shrunk * image.naturalWidth)), height = Math.max(1, Math.round(shrunk * image.naturalHeight));
  const context = element("canvas", { width, height }).getContext("2d", { willReadFrequently: true });
  context.drawImage(image, 0, 0, width, height);
  const texels = new Uint32Array(context.getImageData(0, 0, width, height).data.buffer);
  const cell = (share, count) => Math.min(Math.max(Math.floor(share * count), 0), count - 1);
  return { at: (u, v) => texels[cell(v, height) * width + cell(u, width)] };
}

// That plane of metrics.json on which a place of a surface lies, and its number.
function densePlaneAt({ place, normal }) {
  const length = Math.hypot(...normal);
  const planes = (run.metrics.dense?.planes ?? []).map((plane, index) => ({ plane, index }))
    .filter(({ plane }) => Math.abs(dot(plane.normal, normal)) > 0.999 * length);
  const away = ({ plane }) => Math.abs(dot(plane.normal, place) - plane.distance);
  return planes.sort((a, b) => away(a) - away(b))[0] ?? null;
}
