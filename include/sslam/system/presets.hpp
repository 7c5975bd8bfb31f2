// SPDX-License-Identifier: BSD-3-Clause
// The named pipelines that a System can be made of. Those that come with sslam are compiled once, in src/; a
// program of yours adds its own with add_preset (pipeline_engine.hpp makes an engine of a pipeline).
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "sslam/system/engine.hpp"

namespace sslam {

struct Preset {
  std::string name;
  std::string meaning;
  bool use_points = true;  // of the images; the rest is not even looked for
  bool use_lines = true;
  bool use_normals = true;
  bool new_points = true;  // false: no points but those that start the map
  std::unique_ptr<Engine> (*make)() = nullptr;
  std::unique_ptr<Engine> (*make_live)() = nullptr;  // mapping in a thread of its own; null: it cannot
};

// In the order in which they were added; those that come with sslam first.
[[nodiscard]] const std::vector<Preset>& all_presets();

// Before the first System that asks for it; not while another thread looks for one. Replaces one of the same
// name.
void add_preset(Preset preset);

// Throws Error, which lists the known names, when the name is not known.
[[nodiscard]] const Preset& find_preset(std::string_view name);

}  // namespace sslam
