// SPDX-License-Identifier: BSD-3-Clause
// Every parameter of a pipeline by name: the slot of its stage, and the name that the stage's options give
// it.
#pragma once

#include <array>

#include "sslam/core/parameter_table.hpp"

namespace sslam {

inline constexpr std::array kPipelineOrders{
    ParameterOrder{"rotation.squareness", "rotation.max_sigma", "no rotation would be trusted"},
    ParameterOrder{"rotation.narrowest_kernel", "rotation.widest_kernel", "the search could not narrow"},
    ParameterOrder{"mapping.nearest", "mapping.farthest", "no landmark could be made"},
};

// visit(name, value, unit, least, most, meaning), stage by stage. A null stage has no parameters; a user's
// own stage has those that it describes.
template <class Pipeline, class Visit>
void visit_parameters(Pipeline& p, Visit&& visit) {
  visit_stage("image_fixed.", p.image_fixed, visit);
  visit_stage("rotation.", p.rotation, visit);
  if constexpr (requires { p.rotation.sightings; }) visit_stage("rotation.", p.rotation.sightings, visit);
  visit_stage("evidence.", p.evidence, visit);
  visit_stage("demand.", p.demand, visit);
  visit_stage("stance.", p.stance, visit);
  visit_stage("initialisation.", p.initialisation, visit);
  visit_stage("translation.", p.translation, visit);
  visit_stage("fallback.", p.fallback, visit);
  visit_stage("refinement.", p.refinement, visit);
  visit_stage("certainty.", p.certainty, visit);
  visit_stage("motion.", p.motion, visit);
  visit_stage("relocalisation.", p.relocalisation, visit);
  visit_stage("keyframes.", p.keyframes, visit);
  visit_stage("mapping.", p.mapping, visit);
  if constexpr (requires { p.mapping.planes; }) visit_stage("planes.", p.mapping.planes, visit);
  if constexpr (requires { p.mapping.optimiser.solver.options.losses; })
    visit("planes.flatness", p.mapping.optimiser.solver.options.losses.flatness, Unit::kNumber, 1e-6, 10,
          "standard deviation of a member's distance from its plane over the median scene depth");
  visit_stage("loops.", p.loops, visit);
  visit_stage("atlas.", p.trial, visit);
  visit_stage("atlas.", p.atlas, visit);
  visit_stage("final_pass.", p.final_pass, visit);
}

template <class Pipeline>
void collect_parameters(const Pipeline& pipeline, ParameterTable& table) {
  table.collect([&](auto& visit) { visit_parameters(pipeline, visit); });
  for (const ParameterOrder& order : kPipelineOrders) table.add_order(order);
}

template <class Pipeline>
void write_parameters(const ParameterTable& table, Pipeline& pipeline) {
  table.write([&](auto& visit) { visit_parameters(pipeline, visit); });
}

}  // namespace sslam
