// SPDX-License-Identifier: BSD-3-Clause
// Every parameter of a System by name: those of its pipeline, of its front end, and of every source of
// normals.
#pragma once

#include <memory>
#include <vector>

#include "sslam/opencv/parameters.hpp"
#include "sslam/system/normal_choice.hpp"
#include "sslam/system/parameter_value.hpp"
#include "sslam/system/presets.hpp"

namespace sslam {

// Parameters of a source of normals that is not in use may be set as well; they have no effect.
template <class Frontend>
[[nodiscard]] ParameterTable all_parameters(const Engine& engine, const Frontend& frontend) {
  ParameterTable table;
  engine.collect(table);
  collect_frontend_parameters(frontend, table);
  collect_normal_parameters(table);
  return table;
}

// With their defaults.
[[nodiscard]] inline ParameterTable all_parameters(const Preset& preset) {
  const std::unique_ptr<Engine> engine = preset.make();
  engine->create_points(preset.new_points);
  return all_parameters(*engine, ImageFrontend<NormalChoice>());
}

// Sets the values in order. Returns the first fault: of a value, or of all values together.
[[nodiscard]] inline ParameterAnswer set_parameters(const std::vector<ParameterValue>& values,
                                                    ParameterTable& table) {
  for (const ParameterValue& value : values)
    if (ParameterAnswer answer = table.set(value.name, value.value); !answer.ok()) return answer;
  return table.check();
}

}  // namespace sslam
