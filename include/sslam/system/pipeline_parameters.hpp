// SPDX-License-Identifier: BSD-3-Clause
// Every parameter of a pipeline by name, with what it means.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <type_traits>
#include <vector>

#include "sslam/core/error.hpp"
#include "sslam/system/parameter_value.hpp"
#include "sslam/track/presets.hpp"

namespace sslam {

// Of one stage each; a null model has none.
template <class Stage, class Visit>
void visit_rotation(Stage& s, Visit& visit) {
  if constexpr (requires { s.sightings; }) {
    visit("rotation.squareness", s.options.squareness, Unit::kDegrees,
          "how far walls and edges stand from right angles");
    visit("rotation.max_sigma", s.options.max_sigma, Unit::kDegrees,
          "largest standard deviation of a rotation that is trusted");
    visit("rotation.frames", s.sightings.options.most, Unit::kNumber,
          "Manhattan frames that are told apart; 1: the first is the only one");
    visit("rotation.told_apart", s.sightings.options.told_apart, Unit::kDegrees,
          "least angle between two Manhattan frames");
    visit("rotation.agreement", s.sightings.options.agreement, Unit::kDegrees,
          "between sightings of a Manhattan frame found late");
    visit("rotation.confirmations", s.sightings.options.confirmations, Unit::kNumber,
          "sightings in a row that make one believed");
    visit("rotation.min_normal_share", s.options.search.rotation.min_normal_share, Unit::kNumber,
          "share of the normals that shows an axis");
    visit("rotation.widest_kernel", s.options.search.rotation.widest_kernel, Unit::kDegrees,
          "first kernel width of the mean-shift");
    visit("rotation.narrowest_kernel", s.options.search.rotation.narrowest_kernel, Unit::kDegrees,
          "last kernel width");
  }
}

template <class Stage, class Visit>
void visit_initialisation(Stage& s, Visit& visit) {
  if constexpr (requires { s.min_points; }) {
    visit("initialisation.min_points", s.min_points, Unit::kNumber, "landmarks of the first map");
    visit("initialisation.min_matches", s.min_matches, Unit::kNumber, "matches with the reference frame");
    visit("initialisation.min_parallax", s.min_parallax, Unit::kDegrees, "of a landmark that counts");
    visit("initialisation.max_direction_sigma", s.max_direction_sigma, Unit::kDegrees,
          "standard deviation of the direction of the translation");
    visit("initialisation.search_radius", s.search_radius, Unit::kPixels,
          "around where a feature was last seen");
  }
}

template <class Stage, class Visit>
void visit_translation(Stage& s, Visit& visit) {
  if constexpr (requires { s.match; }) {
    visit("translation.point_radius", s.match.point_radius, Unit::kPixels,
          "search window around a predicted point");
    visit("translation.line_radius", s.match.line_radius, Unit::kPixels,
          "search band around a predicted line");
    visit("translation.min_inliers", s.acceptance.min_inliers, Unit::kNumber, "points plus lines");
    visit("translation.min_inlier_share", s.acceptance.min_inlier_share, Unit::kNumber, "of all matches");
  }
}

template <class Stage, class Visit>
void visit_fallback(Stage& s, Visit& visit) {
  if constexpr (requires { s.match; }) {
    visit("fallback.point_radius", s.match.point_radius, Unit::kPixels,
          "search window around a predicted point");
    visit("fallback.line_radius", s.match.line_radius, Unit::kPixels, "search band around a predicted line");
    visit("fallback.widening", s.widening, Unit::kNumber, "of the windows at the second try");
    visit("fallback.min_inliers", s.acceptance.min_inliers, Unit::kNumber, "points plus lines");
    visit("fallback.min_inlier_share", s.acceptance.min_inlier_share, Unit::kNumber, "of all matches");
  }
}

template <class Stage, class Visit>
void visit_refinement(Stage& s, Visit& visit) {
  if constexpr (requires { s.match; }) {
    visit("refinement.point_radius", s.match.point_radius, Unit::kPixels,
          "search window around a predicted point");
    visit("refinement.line_radius", s.match.line_radius, Unit::kPixels,
          "search band around a predicted line");
    visit("refinement.max_keyframes", s.max_keyframes, Unit::kNumber, "of the local map");
    visit("refinement.min_inliers", s.acceptance.min_inliers, Unit::kNumber, "points plus lines");
    visit("refinement.min_inliers_turned", s.min_inliers_turned, Unit::kNumber,
          "the same where the Manhattan frame gives the rotation");
    visit("refinement.min_inlier_share", s.acceptance.min_inlier_share, Unit::kNumber, "of all matches");
    visit("refinement.max_position_sigma", s.acceptance.max_position_sigma, Unit::kNumber,
          "of the camera's place, over the median scene depth");
    visit("refinement.max_rotation_sigma", s.acceptance.max_rotation_sigma, Unit::kDegrees,
          "of the camera's rotation");
  }
}

template <class Stage, class Visit>
void visit_keyframes(Stage& s, Visit& visit) {
  if constexpr (requires { s.options.min_shared; }) {
    visit("keyframes.min_shared", s.options.min_shared, Unit::kNumber,
          "share of the reference keyframe's landmarks still seen");
    visit("keyframes.max_baseline", s.options.max_baseline, Unit::kNumber,
          "distance to the reference over the median scene depth");
    visit("keyframes.max_turn", s.options.max_turn, Unit::kDegrees, "rotation against the reference");
    visit("keyframes.min_gap", s.options.min_gap, Unit::kNumber, "frames between keyframes");
  }
}

template <class Stage, class Visit>
void visit_mapping(Stage& s, Visit& visit) {
  if constexpr (requires { s.creation; }) {
    visit("mapping.min_point_parallax", s.creation.options.min_point_parallax, Unit::kDegrees,
          "of a new point");
    visit("mapping.min_line_parallax", s.creation.options.min_line_parallax, Unit::kDegrees,
          "between the planes of a new line");
    visit("mapping.max_neighbours", s.creation.options.max_neighbours, Unit::kNumber,
          "keyframes to triangulate with");
    visit("mapping.probation", s.culling.probation, Unit::kNumber, "keyframes for which a landmark is young");
    visit("mapping.redundant_share", s.keyframe_culling.redundant_share, Unit::kNumber,
          "of a keyframe's landmarks, seen well elsewhere: it is removed (over 1: never)");
  }
}

template <class Stage, class Visit>
void visit_planes(Stage& s, Visit& visit) {
  if constexpr (requires { s.planes.options; }) {
    visit("planes.min_members", s.planes.options.min_members, Unit::kNumber,
          "points and lines that make a plane; 0: none is looked for");
    visit("planes.tolerance", s.planes.options.tolerance, Unit::kNumber,
          "distance of a member from its plane over the median scene depth");
    visit("planes.max_sigma", s.planes.options.max_sigma, Unit::kNumber,
          "of a member along the plane's normal over the median scene depth");
    visit("planes.min_spread", s.planes.options.min_spread, Unit::kNumber,
          "of the members in the plane over the median scene depth");
    visit("planes.min_contrast", s.planes.options.min_contrast, Unit::kNumber,
          "members over what their surroundings make expect");
    visit("planes.max_turn", s.planes.options.max_turn, Unit::kDegrees,
          "between a keyframe's rotation and the Manhattan frame's, beyond which it finds none");
    visit("planes.few_landmarks", s.planes.points.few_landmarks, Unit::kNumber,
          "of a keyframe, below which planes give new points their depth; 0: never");
    visit("planes.flatness", s.optimiser.solver.options.losses.flatness, Unit::kNumber,
          "standard deviation of a member's distance from its plane over the median scene depth");
  }
}

template <class Stage, class Visit>
void visit_loops(Stage& s, Visit& visit) {
  if constexpr (requires { s.detection.places; }) {
    visit("loops.candidates", s.detection.places.most, Unit::kNumber,
          "places to compare a new keyframe with; 0: no loop is closed");
    visit("loops.min_inliers", s.detection.refinement.acceptance.min_inliers, Unit::kNumber,
          "points plus lines that must be seen again");
    visit("loops.max_turn", s.detection.options.max_turn, Unit::kDegrees,
          "of the world that a loop may undo");
    visit("loops.max_scale_drift", s.detection.options.max_scale_drift, Unit::kNumber,
          "that a loop may undo, factor");
  }
}

// visit(name, value, unit, meaning) for the parameters that decide how a pipeline behaves. What is visited
// depends on the preset.
template <class Pipeline, class Visit>
void visit_parameters(Pipeline& p, Visit visit) {
  visit_rotation(p.rotation, visit);
  visit_initialisation(p.initialisation, visit);
  visit_translation(p.translation, visit);
  visit_fallback(p.fallback, visit);
  visit_refinement(p.refinement, visit);
  visit("motion.horizon", p.motion.horizon, Unit::kNumber,
        "seconds without a pose through which the velocity is believed; 0: none");
  visit_keyframes(p.keyframes, visit);
  visit_mapping(p.mapping, visit);
  visit_planes(p.mapping, visit);
  visit("atlas.leave_after", p.trial.options.leave_after, Unit::kNumber,
        "frames in a row that show enough and have no pose, until a new map is begun");
  visit("atlas.most", p.atlas.options.most, Unit::kNumber,
        "maps that are kept for when the camera comes back; 0: a lost map is never left");
  visit_loops(p.loops, visit);
}

template <class P>
[[nodiscard]] std::vector<ParameterInfo> list_parameters(P& pipeline) {
  std::vector<ParameterInfo> values;
  visit_parameters(pipeline, [&](const char* name, const auto& value, Unit unit, const char* meaning) {
    values.push_back({{name, static_cast<double>(value) / inside_unit(unit)}, unit, meaning});
  });
  return values;
}

template <class P>
void set_parameter(P& pipeline, const ParameterValue& wanted) {
  bool known = false;
  visit_parameters(pipeline, [&](const char* name, auto& value, Unit unit, const char*) {
    if (wanted.name != name) return;
    using Value = std::remove_reference_t<decltype(value)>;
    const double inside = wanted.value * inside_unit(unit);
    if (inside < 0) throw Error(wanted.name + ": must not be negative");
    if constexpr (std::is_integral_v<Value>) {
      constexpr Value kMost = std::numeric_limits<Value>::max();
      if (inside != std::floor(inside) || inside >= static_cast<double>(kMost))
        throw Error(wanted.name + ": expected a whole number below " + std::to_string(kMost));
    }
    value = static_cast<Value>(inside);
    known = true;
  });
  if (!known) throw Error(wanted.name + ": no such parameter in this preset; see --list-parameters");
}

}  // namespace sslam
