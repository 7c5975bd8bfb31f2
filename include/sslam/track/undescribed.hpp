// SPDX-License-Identifier: BSD-3-Clause
// Parameters of the stages whose options do not list them yet. It goes once they do.
#pragma once

#include "sslam/core/parameter.hpp"

namespace sslam {

template <class Pipeline, class Visit>
void visit_undescribed(Pipeline& p, Visit& visit) {
  if constexpr (requires { p.rotation.squareness; }) {
    auto& s = p.rotation;
    visit("rotation.squareness", s.squareness, Unit::kDegrees, 0, 45,
          "how far walls and edges stand from right angles");
    visit("rotation.max_sigma", s.max_sigma, Unit::kDegrees, 0, 180,
          "largest standard deviation of a rotation that is trusted");
    visit("rotation.frames", s.frames.most, Unit::kCount, 1, 1e6,
          "Manhattan frames that are told apart; 1: the first is the only one");
    visit("rotation.told_apart", s.frames.told_apart, Unit::kDegrees, 0, 45,
          "least angle between two Manhattan frames");
    visit("rotation.agreement", s.frames.agreement, Unit::kDegrees, 0, 45,
          "between sightings of a Manhattan frame found late");
    visit("rotation.confirmations", s.frames.confirmations, Unit::kCount, 1, 1e6,
          "sightings in a row that make one believed");
    visit_within("rotation.", s.search.rotation, visit);
    visit_within("rotation.search.", s.search, visit);
  }
  if constexpr (requires { p.trial.leave_after; })
    visit("atlas.leave_after", p.trial.leave_after, Unit::kCount, 1, 1e9,
          "frames in a row that show enough and have no pose, until a new map is begun");
  if constexpr (requires { p.atlas.most; })
    visit("atlas.most", p.atlas.most, Unit::kCount, 0, 1e6,
          "maps that are kept for when the camera comes back; 0: a lost map is never left");
  if constexpr (requires { p.loops.detection.max_turn; }) {
    auto& s = p.loops.detection;
    visit_within("loops.", s.places.options, visit);
    visit("loops.min_inliers", s.refinement.options.acceptance.min_inliers, Unit::kCount, 3, 1e6,
          "points plus lines that must be seen again");
    visit("loops.max_turn", s.max_turn, Unit::kDegrees, 0, 180, "of the world that a loop may undo");
    visit("loops.max_scale_drift", s.max_scale_drift, Unit::kNumber, 1, 1e6, "factor that a loop may undo");
  }
}

}  // namespace sslam
