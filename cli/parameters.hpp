// SPDX-License-Identifier: BSD-3-Clause
// Every parameter of a pipeline by name, with what it means: for --set, for --list-parameters and for
// metrics.json.
#pragma once

#include <cstdint>
#include <string>

#include "sslam/track/presets.hpp"

namespace sslam::cli {

enum class Unit { kNumber, kPixels, kDegrees };  // kDegrees: radians inside, degrees outside

// visit(name, value, unit, meaning) for the parameters that decide how a pipeline behaves. A stage's null
// model has none, so what is visited depends on the preset.
template <class Pipeline, class Visit>
void visit_parameters(Pipeline& p, Visit visit) {
  if constexpr (requires { p.rotation.search; }) {
    visit("rotation.squareness", p.rotation.squareness, Unit::kDegrees,
          "how far walls and edges stand from right angles");
    visit("rotation.max_sigma", p.rotation.max_sigma, Unit::kDegrees,
          "largest standard deviation of a rotation that is trusted");
    visit("rotation.frames", p.rotation.frames.most, Unit::kNumber,
          "Manhattan frames that are told apart; 1: the first is the only one");
    visit("rotation.told_apart", p.rotation.frames.told_apart, Unit::kDegrees,
          "least angle between two Manhattan frames");
    visit("rotation.agreement", p.rotation.frames.agreement, Unit::kDegrees,
          "between sightings of a Manhattan frame found late");
    visit("rotation.confirmations", p.rotation.frames.confirmations, Unit::kNumber,
          "sightings in a row that make one believed");
    visit("rotation.min_normal_share", p.rotation.search.rotation.min_normal_share, Unit::kNumber,
          "share of the normals that shows an axis");
    visit("rotation.widest_kernel", p.rotation.search.rotation.widest_kernel, Unit::kDegrees,
          "first kernel width of the mean-shift");
    visit("rotation.narrowest_kernel", p.rotation.search.rotation.narrowest_kernel, Unit::kDegrees,
          "last kernel width");
  }
  if constexpr (requires { p.initialisation.min_points; }) {
    visit("initialisation.min_points", p.initialisation.min_points, Unit::kNumber,
          "landmarks of the first map");
    visit("initialisation.min_matches", p.initialisation.min_matches, Unit::kNumber,
          "matches with the reference frame");
    visit("initialisation.min_parallax", p.initialisation.min_parallax, Unit::kDegrees,
          "of a landmark that counts");
    visit("initialisation.max_direction_sigma", p.initialisation.max_direction_sigma, Unit::kDegrees,
          "standard deviation of the direction of the translation");
    visit("initialisation.search_radius", p.initialisation.search_radius, Unit::kPixels,
          "around where a feature was last seen");
  }
  if constexpr (requires { p.translation.match; }) {
    visit("translation.point_radius", p.translation.match.point_radius, Unit::kPixels,
          "search window around a predicted point");
    visit("translation.line_radius", p.translation.match.line_radius, Unit::kPixels,
          "search band around a predicted line");
    visit("translation.min_inliers", p.translation.acceptance.min_inliers, Unit::kNumber,
          "points plus lines");
    visit("translation.min_inlier_share", p.translation.acceptance.min_inlier_share, Unit::kNumber,
          "of all matches");
  }
  if constexpr (requires { p.fallback.match; }) {
    visit("fallback.point_radius", p.fallback.match.point_radius, Unit::kPixels,
          "search window around a predicted point");
    visit("fallback.line_radius", p.fallback.match.line_radius, Unit::kPixels,
          "search band around a predicted line");
    visit("fallback.widening", p.fallback.widening, Unit::kNumber, "of the windows at the second try");
    visit("fallback.min_inliers", p.fallback.acceptance.min_inliers, Unit::kNumber, "points plus lines");
    visit("fallback.min_inlier_share", p.fallback.acceptance.min_inlier_share, Unit::kNumber,
          "of all matches");
  }
  if constexpr (requires { p.refinement.match; }) {
    visit("refinement.point_radius", p.refinement.match.point_radius, Unit::kPixels,
          "search window around a predicted point");
    visit("refinement.line_radius", p.refinement.match.line_radius, Unit::kPixels,
          "search band around a predicted line");
    visit("refinement.max_keyframes", p.refinement.max_keyframes, Unit::kNumber, "of the local map");
    visit("refinement.min_inliers", p.refinement.acceptance.min_inliers, Unit::kNumber, "points plus lines");
    visit("refinement.min_inliers_turned", p.refinement.min_inliers_turned, Unit::kNumber,
          "the same where the Manhattan frame gives the rotation");
    visit("refinement.min_inlier_share", p.refinement.acceptance.min_inlier_share, Unit::kNumber,
          "of all matches");
    visit("refinement.max_position_sigma", p.refinement.acceptance.max_position_sigma, Unit::kNumber,
          "of the camera's place, over the median scene depth");
    visit("refinement.max_rotation_sigma", p.refinement.acceptance.max_rotation_sigma, Unit::kDegrees,
          "of the camera's rotation");
  }
  visit("motion.horizon", p.motion.horizon, Unit::kNumber,
        "seconds without a pose through which the velocity is believed; 0: none");
  if constexpr (requires { p.keyframes.min_shared; }) {
    visit("keyframes.min_shared", p.keyframes.min_shared, Unit::kNumber,
          "share of the reference keyframe's landmarks still seen");
    visit("keyframes.max_baseline", p.keyframes.max_baseline, Unit::kNumber,
          "distance to the reference over the median scene depth");
    visit("keyframes.max_turn", p.keyframes.max_turn, Unit::kDegrees, "rotation against the reference");
    visit("keyframes.min_gap", p.keyframes.min_gap, Unit::kNumber, "frames between keyframes");
  }
  if constexpr (requires { p.mapping.creation; }) {
    visit("mapping.min_point_parallax", p.mapping.creation.options.min_point_parallax, Unit::kDegrees,
          "of a new point");
    visit("mapping.min_line_parallax", p.mapping.creation.options.min_line_parallax, Unit::kDegrees,
          "between the planes of a new line");
    visit("mapping.max_neighbours", p.mapping.creation.options.max_neighbours, Unit::kNumber,
          "keyframes to triangulate with");
    visit("mapping.probation", p.mapping.culling.probation, Unit::kNumber,
          "keyframes for which a landmark is young");
    visit("mapping.redundant_share", p.mapping.keyframe_culling.redundant_share, Unit::kNumber,
          "of a keyframe's landmarks, seen well elsewhere: it is removed (over 1: never)");
  }
  if constexpr (requires { p.mapping.planes.options; }) {
    visit("planes.min_members", p.mapping.planes.options.min_members, Unit::kNumber,
          "points and lines that make a plane; 0: none is looked for");
    visit("planes.tolerance", p.mapping.planes.options.tolerance, Unit::kNumber,
          "distance of a member from its plane over the median scene depth");
    visit("planes.max_sigma", p.mapping.planes.options.max_sigma, Unit::kNumber,
          "of a member along the plane's normal over the median scene depth");
    visit("planes.min_spread", p.mapping.planes.options.min_spread, Unit::kNumber,
          "of the members in the plane over the median scene depth");
    visit("planes.min_contrast", p.mapping.planes.options.min_contrast, Unit::kNumber,
          "members over what their surroundings make expect");
    visit("planes.max_turn", p.mapping.planes.options.max_turn, Unit::kDegrees,
          "between a keyframe's rotation and the Manhattan frame's, beyond which it finds none");
    visit("planes.few_landmarks", p.mapping.planes.points.few_landmarks, Unit::kNumber,
          "of a keyframe, below which planes give new points their depth; 0: never");
    visit("planes.flatness", p.mapping.optimiser.solver.options.losses.flatness, Unit::kNumber,
          "standard deviation of a member's distance from its plane over the median scene depth");
  }
  visit("atlas.leave_after", p.trial.leave_after, Unit::kNumber,
        "frames in a row that show enough and have no pose, until a new map is begun");
  visit("atlas.most", p.atlas.most, Unit::kNumber,
        "maps that are kept for when the camera comes back; 0: a lost map is never left");
  if constexpr (requires { p.loops.detection.places; }) {
    visit("loops.candidates", p.loops.detection.places.most, Unit::kNumber,
          "places to compare a new keyframe with; 0: no loop is closed");
    visit("loops.min_inliers", p.loops.detection.refinement.acceptance.min_inliers, Unit::kNumber,
          "points plus lines that must be seen again");
    visit("loops.max_turn", p.loops.detection.max_turn, Unit::kDegrees, "of the world that a loop may undo");
    visit("loops.max_scale_drift", p.loops.detection.max_scale_drift, Unit::kNumber,
          "that a loop may undo, factor");
  }
}

}  // namespace sslam::cli
