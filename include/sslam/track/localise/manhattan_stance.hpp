// SPDX-License-Identifier: BSD-3-Clause
// How the first Manhattan frame stands in the world. The image that showed it first says so no better than
// any other; the mean of the first seconds does, and the world keeps its keyframes where they are.
#pragma once

#include "sslam/core/parameter.hpp"
#include "sslam/map/map.hpp"
#include "sslam/track/contract/tracked_frame.hpp"

namespace sslam {

template <Scalar S>
struct ManhattanStanceOptions {
  int frames = 60;                // that take part in the mean; 0: the first one decides
  S max_turn = radians(S(5));     // between a pose and its Manhattan rotation, to take part
  S max_sigma = radians(S(2.5));  // standard deviation of a Manhattan rotation that takes part

  template <class Self, class Visit>
  static void parameters(Self& self, Visit&& visit) {
    visit("frames", self.frames, Unit::kCount, 0, 100000,
          "of which the mean says how the first Manhattan frame stands in the world");
    visit("max_turn", self.max_turn, Unit::kDegrees, 0, 55,
          "between a pose and its Manhattan rotation there");
    visit("max_sigma", self.max_sigma, Unit::kDegrees, 0, 180, "of a Manhattan rotation there");
  }
};
static_assert(Described<ManhattanStanceOptions<double>>);

template <Scalar S>
class ManhattanStance {
 public:
  ManhattanStanceOptions<S> options;

  template <class Self, class Visit>
  static void parameters(Self& self, Visit&& visit) {
    visit_within("", self.options, visit);
  }

  // A world begins, or one is gone on in whose axes are known.
  void begin(bool new_world) noexcept { seen_ = new_world ? 0 : options.frames; }

  // The frame has its pose. Turns the map's Manhattan frame, and what its keyframes and this frame were told
  // by it.
  void refine(Map<S>& map, TrackedFrame<S>& frame) {
    if (seen_ >= options.frames || map.world_from_manhattan.size() != 1 || !frame.manhattan) return;
    const S limit = options.max_sigma * options.max_sigma;
    if (!(frame.manhattan->covariance.diagonal().maxCoeff() < limit)) return;
    const Vec3<S> off = (frame.cam_from_world.rotation.inverse() * frame.manhattan->cam_from_world).log();
    if (off.norm() > options.max_turn) return;
    ++seen_;
    const SO3<S> turn = SO3<S>::exp(off / static_cast<S>(seen_ + 1));
    map.world_from_manhattan[0] = turn * map.world_from_manhattan[0];
    const auto follow = [back = turn.inverse()](std::optional<RotationObservation<S>>& seen) {
      if (seen) seen->cam_from_world = seen->cam_from_world * back;
    };
    for (Keyframe<S>& keyframe : map.keyframes) follow(keyframe.manhattan);
    follow(frame.manhattan);
  }

 private:
  int seen_ = 0;
};

}  // namespace sslam
