// SPDX-License-Identifier: BSD-3-Clause
// The camera of resized images. (0, 0) is the centre of the first pixel.
#pragma once

#include "sslam/geometry/camera.hpp"

namespace sslam {

// sx, sy: new width and height over the old.
template <Scalar S>
[[nodiscard]] constexpr Pinhole<S> resized(const Pinhole<S>& p, S sx, S sy) noexcept {
  return {p.fx * sx, p.fy * sy, (p.cx + S(0.5)) * sx - S(0.5), (p.cy + S(0.5)) * sy - S(0.5)};
}

// The camera for images of this size, in pixels. The camera's own size must not be 0.
template <Scalar S>
[[nodiscard]] Camera<S> resized(const Camera<S>& camera, int width, int height) {
  Camera<S> out = camera;
  out.pinhole = resized(camera.pinhole, static_cast<S>(width) / static_cast<S>(camera.width),
                        static_cast<S>(height) / static_cast<S>(camera.height));
  out.width = width;
  out.height = height;
  return out;
}

}  // namespace sslam
