// SPDX-License-Identifier: BSD-3-Clause
// Follows the features of a reference frame through the frames after it, each near where it was seen last.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "sslam/track/contract/tracked_frame.hpp"
#include "sslam/track/matching/frame_turn.hpp"
#include "sslam/track/matching/mutual_matcher.hpp"

namespace sslam {

template <Scalar S>
class FeatureFollower {
 public:
  // What is followed from now on.
  void begin(const TrackedFrame<S>& reference) {
    last_pixels_.resize(reference.frame.points.size());
    for (std::size_t i = 0; i < last_pixels_.size(); ++i) last_pixels_[i] = reference.frame.points[i].pixel;
    last_rotation_ = reference.cam_from_world.rotation;
  }

  // Pairs of features, of the reference and of the frame, within `radius` pixels of where they should be. The
  // camera has turned since the last frame as the frames' rotations say. Where that finds less than `enough`,
  // it may have turned as it did before, or not at all: what finds most is taken.
  const std::vector<IndexPair>& follow(const TrackedFrame<S>& reference, const TrackedFrame<S>& frame,
                                       S radius, std::size_t enough, const PointMatchOptions<S>& options,
                                       std::uint64_t seed) {
    SO3<S> turn = frame.cam_from_world.rotation * last_rotation_.inverse();
    find(reference, frame, turn, radius, options, pairs_);
    for (const SO3<S>& guess : {last_turn_, SO3<S>()}) {
      if (pairs_.size() >= enough) break;
      find(reference, frame, guess, radius, options, other_pairs_);
      if (other_pairs_.size() <= pairs_.size()) continue;
      std::swap(pairs_, other_pairs_);
      turn = guess;
    }
    last_rotation_ = frame.cam_from_world.rotation;
    measure_turn(frame, seed);
    const Pinhole<S>& pinhole = frame.frame.pinhole;
    for (Vec2<S>& pixel : last_pixels_) {
      const Vec3<S> ray = turn * pinhole.unproject(pixel);
      if (ray.z() > 0) pixel = pinhole.project(ray);
    }
    for (const IndexPair& p : pairs_)
      last_pixels_[Map<S>::index(p.first)] = frame.frame.points[Map<S>::index(p.second)].pixel;
    return pairs_;
  }

 private:
  void find(const TrackedFrame<S>& reference, const TrackedFrame<S>& frame, const SO3<S>& turn, S radius,
            const PointMatchOptions<S>& options, std::vector<IndexPair>& pairs) {
    const Pinhole<S>& pinhole = frame.frame.pinhole;
    matcher_.match(
        reference.frame.points, frame.frame.points, options,
        [&](std::int32_t i, auto visit) {
          const Vec3<S> ray = turn * pinhole.unproject(last_pixels_[Map<S>::index(i)]);
          if (ray.z() <= 0) return;
          const Vec2<S> expected = pinhole.project(ray);
          const PointFeature<S>& from = reference.frame.points[Map<S>::index(i)];
          frame.grid.near(expected, radius, [&](std::int32_t j) {
            const PointFeature<S>& to = frame.frame.points[Map<S>::index(j)];
            const S scale = to.sigma / from.sigma;
            if (scale < options.max_scale_ratio && scale * options.max_scale_ratio > 1 &&
                (to.pixel - expected).squaredNorm() < radius * radius)
              visit(j);
          });
        },
        pairs);
    keep_consistent_rotation<S>(reference.frame.points, frame.frame.points, pairs);
  }

  // How the camera has turned since the last frame, by the pixels of the pairs.
  void measure_turn(const TrackedFrame<S>& frame, std::uint64_t seed) {
    const Pinhole<S>& k = frame.frame.pinhole;
    bearings_.clear();
    for (const IndexPair& p : pairs_) {
      const PointFeature<S>& to = frame.frame.points[Map<S>::index(p.second)];
      bearings_.push_back(match_of_turn<S>(k.unproject(last_pixels_[Map<S>::index(p.first)]), to, k));
    }
    const auto measured = rotation_from_bearings<S>(bearings_, {}, seed);
    last_turn_ = usable(measured.status) ? measured.R_10 : SO3<S>();
  }

  std::vector<Vec2<S>> last_pixels_;  // where each feature of the reference was last seen
  SO3<S> last_rotation_;
  SO3<S> last_turn_;  // between the last two frames, as their features show it
  MutualMatcher matcher_;
  std::vector<IndexPair> pairs_, other_pairs_;
  std::vector<BearingMatch<S>> bearings_;
};

}  // namespace sslam
