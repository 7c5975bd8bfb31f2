// SPDX-License-Identifier: BSD-3-Clause
// Motion blur: the mean of what the camera sees while its shutter is open.
#pragma once

#include <algorithm>
#include <cmath>
#include <span>
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

// The mean of `count` exposures, an odd number, spread over `open` seconds around `seconds`. render(moment)
// gives the values that it rendered; the last of them, of the middle, become the mean.
template <class Render>
void average_exposures(const Render& render, double seconds, double open, int count,
                       std::vector<float>& sum) {
  const int half = count / 2;
  sum.clear();
  const auto expose = [&](int k) {
    const std::span<float> values = render(seconds + open * k / count);
    sum.resize(values.size(), 0.0f);
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += values[i] / static_cast<float>(count);
    return values;
  };
  for (int k = -half; k <= half; ++k) {
    if (k != 0) expose(k);
  }
  std::copy(sum.begin(), sum.end(), expose(0).begin());
}

// How many exposures make a shutter that is open for `open` seconds: one for each pixel of motion.
template <class PoseAt>
[[nodiscard]] int exposures_within(const PoseAt& pose_at, double seconds, double open, const View& view) {
  constexpr int kMost = 15;
  if (!(open > 0.0)) return 1;
  const double motion = image_motion(view, pose_at(seconds - 0.5 * open), pose_at(seconds + 0.5 * open));
  return 2 * std::min(static_cast<int>(std::ceil(0.5 * motion)), kMost / 2) + 1;
}

// Renders at `seconds` with the shutter open for `open` seconds around it; depth and normals are those of the
// middle. pose_at(t) gives cam_from_world.
template <class PoseAt>
void render_open_shutter(Renderer& renderer, const PoseAt& pose_at, double seconds, double open, View view,
                         RenderedFrame& frame) {
  const auto render = [&](double moment) {
    view.cam_from_world = pose_at(moment);
    renderer.render(view, frame);
    return std::span(frame.rgb);
  };
  std::vector<float> sum;
  average_exposures(render, seconds, open, exposures_within(pose_at, seconds, open, view), sum);
}

}  // namespace sslam::synth
