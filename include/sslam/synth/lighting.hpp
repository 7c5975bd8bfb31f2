// SPDX-License-Identifier: BSD-3-Clause
// Bakes light into a scene and chooses the exposure. Shading keeps edges between equally painted walls
// visible, faintly, as in a real room.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "sslam/synth/light_baker.hpp"

namespace sslam::synth {

// Bends bright values softly towards a limit, as film and cameras do.
[[nodiscard]] inline double shoulder(double value) noexcept {
  constexpr double kStart = 0.85, kRoom = 0.25;
  return value <= kStart ? value : kStart + kRoom * (1.0 - std::exp((kStart - value) / kRoom));
}

// Irradiance over faces, summed over their area.
struct Brightness {
  double sum = 0.0, area = 0.0;

  Brightness& operator+=(const Brightness& other) noexcept {
    sum += other.sum;
    area += other.area;
    return *this;
  }
};

[[nodiscard]] inline Brightness brightness(const Face& face) noexcept {
  double mean = 0.0;
  for (const float node : face.light.nodes) mean += node / static_cast<double>(face.light.nodes.size());
  return {face.width * face.height * mean, face.width * face.height};
}

// The exposure that shows white paint at options.mean_display on average.
[[nodiscard]] inline double exposure_gain(const Brightness& all, const LightingOptions& options) noexcept {
  return all.sum > 0.0 ? std::pow(options.mean_display, 2.2) * all.area / all.sum : 1.0;
}

// Turns irradiance into factors on display values (gamma 2.2).
inline void expose_light_map(LightMap& map, double gain) {
  for (float& node : map.nodes) node = static_cast<float>(shoulder(std::pow(gain * node, 1.0 / 2.2)));
}

inline void expose_light_maps(Scene& scene, const LightingOptions& options) {
  Brightness all;
  for (const Face& face : scene.faces) all += brightness(face);
  const double gain = exposure_gain(all, options);
  for (Face& face : scene.faces) expose_light_map(face.light, gain);
}

// Calls work(i) for i in [0, count) one after the other; a caller with threads brings its own.
struct InOrder {
  template <class Work>
  void operator()(std::size_t count, Work&& work) const {
    for (std::size_t i = 0; i < count; ++i) work(i);
  }
};

// Lights every face of the scene. The result does not depend on the order of the calls for_each makes.
template <class ForEach = InOrder>
void bake_lighting(Scene& scene, const LightingOptions& options = {}, const ForEach& for_each = {}) {
  const LightBaker baker(scene, options);
  std::vector<LightMap> maps(scene.faces.size());
  for_each(maps.size(), [&](std::size_t i) { maps[i] = baker.bake(scene.faces[i]); });
  for (std::size_t i = 0; i < maps.size(); ++i) scene.faces[i].light = std::move(maps[i]);
  expose_light_maps(scene, options);
}

}  // namespace sslam::synth
