// SPDX-License-Identifier: BSD-3-Clause
// The light of a large house, baked face by face when a camera first comes to see them: most of it is never
// looked at by a short walk. Each room is lit by its own lamps and windows alone.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "sslam/synth/lighting.hpp"
#include "sslam/synth/scene.hpp"

namespace sslam::synth {

class LateLighting {
 public:
  // The scene's cells must be complete. for_each as in bake_lighting.
  template <class ForEach>
  LateLighting(const Scene& scene, const LightingOptions& options, const ForEach& for_each)
      : options_(options), rooms_(scene.cells.size()), place_of_(scene.faces.size()) {
    for (std::size_t c = 0; c < rooms_.size(); ++c) {
      rooms_[c].lamps = scene.cells[c].lamps;
      for (const std::int32_t face : scene.cells[c].faces) {
        place_of_[static_cast<std::size_t>(face)] = {c, rooms_[c].faces.size()};
        rooms_[c].faces.push_back(scene.faces[static_cast<std::size_t>(face)]);
      }
    }
    std::vector<Brightness> mean(rooms_.size());
    for_each(rooms_.size(), [&](std::size_t c) { mean[c] = estimate(rooms_[c]); });
    Brightness all;
    for (const Brightness& room : mean) all += room;
    gain_ = exposure_gain(all, options_);
    ready_ = std::make_unique<std::once_flag[]>(place_of_.size());
  }

  // Of a face of the scene; from any thread.
  [[nodiscard]] const LightMap& light(std::size_t face) {
    const Place& place = place_of_[face];
    Scene& room = rooms_[place.room];
    std::call_once(ready_[face], [&] {
      LightMap map = LightBaker(room, options_).bake(room.faces[place.face]);
      expose_light_map(map, gain_);
      room.faces[place.face].light = std::move(map);
    });
    return room.faces[place.face].light;
  }

 private:
  struct Place {
    std::size_t room, face;
  };

  // By a few nodes a face.
  [[nodiscard]] Brightness estimate(const Scene& room) const {
    LightingOptions coarse = options_;
    coarse.spacing = 1.0;
    const LightBaker baker(room, coarse);
    Brightness sum;
    for (Face face : room.faces) {
      face.light = baker.bake(face);
      sum += brightness(face);
    }
    return sum;
  }

  LightingOptions options_;
  std::vector<Scene> rooms_;  // their faces and lamps alone
  std::vector<Place> place_of_;
  double gain_ = 1.0;
  std::unique_ptr<std::once_flag[]> ready_;  // by face
};

// The result does not depend on what is looked at first.
template <class ForEach = InOrder>
void light_late(Scene& scene, const LightingOptions& options = {}, const ForEach& for_each = {}) {
  scene.late_light = [late = std::make_shared<LateLighting>(scene, options, for_each)](
                         std::size_t face) -> const LightMap& { return late->light(face); };
}

}  // namespace sslam::synth
