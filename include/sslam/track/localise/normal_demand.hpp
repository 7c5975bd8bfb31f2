// SPDX-License-Identifier: BSD-3-Clause
// When normals are worth their price: where the frame's lines leave its rotation open. Decided by what was
// measured, never by time, so that the same images are asked about in every run.
#pragma once

#include "sslam/core/parameter.hpp"
#include "sslam/geometry/spread.hpp"
#include "sslam/track/contract/normal_need.hpp"
#include "sslam/track/contract/rotation_answer.hpp"

namespace sslam {

template <Scalar S>
struct NormalDemandOptions {
  // By lines alone, about any axis; half of RotationOptions::max_sigma. Normals of a network are good to 5
  // degrees: what lines know better than this they change by less than 3 %.
  S max_sigma = radians(S(0.75));
  // Points and lines of the map that the last frame was found by: from so many on they give the next rotation
  // to tenths of a degree, and normals that lines do not bear out can only mislead.
  int held_by = 30;

  template <class Self, class Visit>
  static void parameters(Self& self, Visit&& visit) {
    visit("max_sigma", self.max_sigma, Unit::kDegrees, 0, 180,
          "standard deviation of a rotation by lines alone, above which normals are asked for");
    visit("held_by", self.held_by, Unit::kCount, 0, 1e6,
          "points and lines of the map in the last frame, from which on no normals are asked for");
  }
};
static_assert(Described<NormalDemandOptions<double>>);

template <Scalar S>
class NormalDemand {
 public:
  NormalDemandOptions<S> options;

  template <class Self, class Visit>
  static void parameters(Self& self, Visit&& visit) {
    visit_within("", self.options, visit);
  }

  // By what the rotation stage says of the frame's lines, in a world that has a Manhattan frame.
  [[nodiscard]] NormalNeed need(const RotationAnswer<S>& by_lines) const {
    if (!by_lines.seen) return NormalNeed::kNoAxis;
    if (by_lines.axes_seen < 2) return NormalNeed::kAxisOpen;
    const bool sure = largest_sigma<S>(by_lines.seen->rotation.covariance) < options.max_sigma;
    return sure ? NormalNeed::kNotNeeded : NormalNeed::kUncertain;
  }
};

}  // namespace sslam
