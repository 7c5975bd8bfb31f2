// SPDX-License-Identifier: BSD-3-Clause
// A camera as it is built: rows are read one after the other, and a lens bends what they see.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "sslam/geometry/row_offset.hpp"
#include "sslam/synth/shutter.hpp"

namespace sslam::synth {

struct Shutter {
  double open = 0.0;      // seconds that each row is exposed
  double read_out = 0.0;  // seconds from the first row to the last
};

// When the middle of a row's exposure is; of the frame's `seconds` for the row in the middle of the image.
[[nodiscard]] inline double row_moment(const Shutter& shutter, double seconds, double row,
                                       int rows) noexcept {
  return seconds + row_offset<double>(shutter.read_out, row, rows);
}

// How many bands of rows are rendered, each at the moment of its middle row: a tenth of a pixel of motion a
// band.
template <class PoseAt>
[[nodiscard]] int read_out_bands(const PoseAt& pose_at, double seconds, const Shutter& shutter,
                                 const View& view) {
  if (!(shutter.read_out > 0.0)) return 1;
  constexpr double kStep = 0.1;  // pixels
  constexpr int kParts = 8;      // a shake may turn round within one read-out
  double motion = 0.0;
  for (int i = 0; i < kParts; ++i) {
    const auto pose = [&](int part) {
      return pose_at(seconds + shutter.read_out * (static_cast<double>(part) / kParts - 0.5));
    };
    motion += image_motion(view, pose(i), pose(i + 1));
  }
  return static_cast<int>(std::clamp(std::ceil(motion / kStep), 1.0, static_cast<double>(view.height)));
}

// Renders a frame through the lens, row by row as it is read; the pose at `seconds` is that of the middle
// row. Depth and normals are those that each row sees in the middle of its exposure.
template <class PoseAt>
void render_rolling_shutter(Renderer& renderer, const PoseAt& pose_at, double seconds, const Shutter& shutter,
                            View view, const LensGrid& lens, RenderedFrame& frame) {
  frame.resize(view.width, view.height);
  const int bands = read_out_bands(pose_at, seconds, shutter, view);
  std::vector<float> sum;
  for (int band = 0; band < bands; ++band) {
    const int top = view.height * band / bands, bottom = view.height * (band + 1) / bands;
    const double moment = row_moment(shutter, seconds, 0.5 * (top + bottom - 1), view.height);
    const std::size_t row = 3 * static_cast<std::size_t>(view.width), faces = frame.normals.size();
    const auto render = [&](double at) {
      view.cam_from_world = pose_at(at);
      frame.normals.resize(faces);  // not those of the exposure before
      frame.face.resize(faces);
      renderer.render_rows(view, lens, top, bottom, frame);
      return std::span(frame.rgb).subspan(row * top, row * (bottom - top));
    };
    average_exposures(render, moment, shutter.open, exposures_within(pose_at, moment, shutter.open, view),
                      sum);
  }
}

}  // namespace sslam::synth
