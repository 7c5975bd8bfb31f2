// SPDX-License-Identifier: BSD-3-Clause
// The named pipelines that a System can use. Those of sslam are compiled once, in src/; your program adds its
// own with add_preset (pipeline_engine.hpp makes an engine from a pipeline).
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
  bool use_points = true;  // of the images; false: they are not extracted
  bool use_lines = true;
  bool use_normals = true;
  bool new_points = true;  // false: no new points after the first map
  std::unique_ptr<Engine> (*make)() = nullptr;
  std::unique_ptr<Engine> (*make_live)() = nullptr;  // with mapping in its own thread; null: not supported
};

// In the order in which they were added; those of sslam first.
[[nodiscard]] const std::vector<Preset>& all_presets();

// Call it before the first System that uses the preset, and not while another thread searches presets.
// Replaces a preset of the same name.
void add_preset(Preset preset);

// Throws Error, which lists the known names, if the name is not known.
[[nodiscard]] const Preset& find_preset(std::string_view name);

}  // namespace sslam
