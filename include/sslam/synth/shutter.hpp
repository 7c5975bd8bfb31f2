// SPDX-License-Identifier: BSD-3-Clause
// Motion blur: the mean of what the camera sees while its shutter is open.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "sslam/synth/render.hpp"

namespace sslam::synth {

// Pixels that the middle and the corner of the image move between two poses, for things 2 m away.
[[nodiscard]] inline double image_motion(const View& view, const SE3<double>& from,
                                         const SE3<double>& to) noexcept {
  const SE3<double> to_from = to * from.inverse();
  double most = 0.0;
  for (const Vec2<double>& pixel :
       {Vec2<double>(0.5 * view.width, 0.5 * view.height), Vec2<double>(0.0, 0.0)}) {
    const Vec3<double> moved = to_from * Vec3<double>(2.0 * view.pinhole.unproject(pixel));
    if (moved.z() > 0.1) most = std::max(most, (view.pinhole.project(moved) - pixel).norm());
  }
  return most;
}

// Renders at `seconds` with the shutter open for `open` seconds around it, one exposure for each pixel of
// motion; depth and normals are those of the middle. pose_at(t) gives cam_from_world.
template <class PoseAt>
void render_open_shutter(Renderer& renderer, const PoseAt& pose_at, double seconds, double open, View view,
                         RenderedFrame& frame) {
  constexpr int kMost = 15;
  const double motion = image_motion(view, pose_at(seconds - 0.5 * open), pose_at(seconds + 0.5 * open));
  const int half = open > 0.0 ? std::min(static_cast<int>(std::ceil(0.5 * motion)), kMost / 2) : 0;
  const int count = 2 * half + 1;
  std::vector<float> sum;
  const auto expose = [&](int k) {
    view.cam_from_world = pose_at(seconds + open * k / count);
    renderer.render(view, frame);
    sum.resize(frame.rgb.size(), 0.0f);
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += frame.rgb[i] / static_cast<float>(count);
  };
  for (int k = -half; k <= half; ++k) {
    if (k != 0) expose(k);
  }
  expose(0);
  frame.rgb.swap(sum);
}

}  // namespace sslam::synth
