// SPDX-License-Identifier: BSD-3-Clause
// How the camera has turned from one frame to another, by their features alone: a guess for a frame that
// neither motion nor structure predicts, as in a quick turn of the hand.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "sslam/map/frame.hpp"
#include "sslam/solver/two_view/rotation_from_bearings.hpp"
#include "sslam/track/matching/mutual_matcher.hpp"

namespace sslam {

// The pose of a camera that has turned by R_10 where it stood.
template <Scalar S>
[[nodiscard]] SE3<S> turned(const SO3<S>& R_10, const SE3<S>& cam_from_world) {
  return {R_10 * cam_from_world.rotation, R_10 * cam_from_world.translation};
}

// What a match says of a turn: parallax may move its feature by three standard deviations.
template <Scalar S>
[[nodiscard]] BearingMatch<S> match_of_turn(const Vec3<S>& from, const PointFeature<S>& to,
                                            const Pinhole<S>& pinhole) {
  constexpr S kParallax = 3;
  return {from, pinhole.unproject(to.pixel), kParallax * to.sigma / pinhole.fx};
}

template <Scalar S>
class FrameTurn {
 public:
  // R_10, from the camera of frame `from` to that of `to`; none where too few features agree on one. Every
  // feature is compared with every other: nothing is known of where to look.
  [[nodiscard]] std::optional<SO3<S>> between(const Frame<S>& from, const Frame<S>& to) {
    const PointMatchOptions<S> match{.max_distance = 50, .max_ratio = S(0.75)};
    matcher_.match(
        from.points, to.points, match,
        [&](std::int32_t, auto visit) {
          for (std::size_t j = 0; j < to.points.size(); ++j) visit(static_cast<std::int32_t>(j));
        },
        pairs_);
    keep_consistent_rotation<S>(from.points, to.points, pairs_);
    bearings_.clear();
    for (const IndexPair& p : pairs_) {
      const PointFeature<S>& a = from.points[static_cast<std::size_t>(p.first)];
      const PointFeature<S>& b = to.points[static_cast<std::size_t>(p.second)];
      bearings_.push_back(match_of_turn<S>(from.pinhole.unproject(a.pixel), b, to.pinhole));
    }
    const RotationFromBearings<S> found = rotation_from_bearings<S>(bearings_, {}, 1);
    return usable(found.status) ? std::optional(found.R_10) : std::nullopt;
  }

 private:
  MutualMatcher matcher_;
  std::vector<IndexPair> pairs_;
  std::vector<BearingMatch<S>> bearings_;
};

}  // namespace sslam
