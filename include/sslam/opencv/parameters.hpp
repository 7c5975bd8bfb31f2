// SPDX-License-Identifier: BSD-3-Clause
// Every parameter of the front end by name: points, lines, and the normals of the source that is plugged in.
#pragma once

#include "sslam/core/parameter_table.hpp"
#include "sslam/opencv/image_frontend.hpp"

namespace sslam {

// visit(name, value, unit, least, most, meaning). A front end of your own has those of what it names alike.
template <class Frontend, class Visit>
void visit_frontend_parameters(Frontend& frontend, Visit&& visit) {
  if constexpr (requires { frontend.points; }) visit_stage("points.", frontend.points, visit);
  if constexpr (requires { frontend.lines; }) visit_stage("lines.", frontend.lines, visit);
  if constexpr (requires { frontend.normals; }) visit_stage("normals.", frontend.normals, visit);
}

template <class Frontend>
void collect_frontend_parameters(const Frontend& frontend, ParameterTable& table) {
  table.collect([&](auto& visit) { visit_frontend_parameters(frontend, visit); });
  table.add_order({"points.contrast.second", "points.contrast.first", "it would not be used"});
  table.add_order({"points.contrast.last", "points.contrast.second", "it would not be used"});
}

template <class Frontend>
void write_frontend_parameters(const ParameterTable& table, Frontend& frontend) {
  table.write([&](auto& visit) { visit_frontend_parameters(frontend, visit); });
}

}  // namespace sslam
