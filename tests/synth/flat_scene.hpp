// SPDX-License-Identifier: BSD-3-Clause
// Small hand-made scenes under even light, and a way to find an edge in an image to a fraction of a pixel.
#pragma once

#include <cmath>

#include "sslam/synth/render.hpp"
#include "sslam/synth/scene.hpp"

namespace sslam::synth {

inline LightMap even_light() {
  return {2, 2, {1.0f, 1.0f, 1.0f, 1.0f}};
}

// A rectangle of one grey value that faces the origin, which looks along +z of the world (x right, y down).
inline Face facing_card(const Vec3<double>& top_left, double width, double height, double turn, float grey) {
  // along_s to the right, along_t up; the card is turned about the viewing axis by `turn` around its corner.
  const Vec3<double> s(std::cos(turn), std::sin(turn), 0.0), t(std::sin(turn), -std::cos(turn), 0.0);
  return {top_left - height * t, s, t, width, height, {Vec3<float>::Constant(grey)}, even_light()};
}

inline View front_view(int width = 160, int height = 120) {
  return {{130.0, 130.0, 0.5 * (width - 1), 0.5 * (height - 1)}, width, height, {}};
}

inline float grey_at(const RenderedFrame& frame, int x, int y) {
  return frame.rgb[3 * (static_cast<std::size_t>(y) * frame.width + x)];
}

// Where on row y, within reach of x, the image changes from `before` to `after`: the step that has the same
// sum.
inline double step_on_row(const RenderedFrame& frame, int y, int x, int reach, float before, float after) {
  double beyond = 0.0;
  for (int u = x - reach; u <= x + reach; ++u) beyond += (grey_at(frame, u, y) - before) / (after - before);
  return x + reach + 0.5 - beyond;
}

}  // namespace sslam::synth
