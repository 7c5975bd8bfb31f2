// SPDX-License-Identifier: BSD-3-Clause
// Point matching: landmarks by projection, and the pairs of two images that turn alike.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <vector>

#include "sslam/core/parameter.hpp"
#include "sslam/map/map.hpp"
#include "sslam/track/contract/tracked_frame.hpp"

namespace sslam {

template <Scalar S>
struct PointMatchOptions {
  int max_distance = 64;       // bits of 256 in which two views of one point may differ
  S max_ratio = S(0.85);       // best distance over second best: lower is less ambiguous
  S max_scale_ratio = S(1.6);  // feature size against the size that distance predicts
  S min_view_cosine = S(0.5);  // between the mean viewing direction and this one: 60 degrees

  template <class Self, class Visit>
  static void parameters(Self& self, Visit&& visit) {
    visit("max_distance", self.max_distance, Unit::kCount, 0, 256,
          "bits in which two views of one point may differ");
    visit("max_ratio", self.max_ratio, Unit::kShare, 0, 1, "best distance over second best");
    visit("max_scale_ratio", self.max_scale_ratio, Unit::kNumber, 1, 100,
          "feature size against the size that distance predicts");
    visit("min_view_cosine", self.min_view_cosine, Unit::kNumber, -1, 1,
          "cosine of the turn of the viewing direction");
  }
};
static_assert(Described<PointMatchOptions<double>>);

// Best and second best of a stream of candidates.
struct BestTwo {
  int best = std::numeric_limits<int>::max();
  int second = std::numeric_limits<int>::max();
  std::int32_t index = kNone;

  // Offering the same candidate again changes nothing.
  void offer(int distance, std::int32_t candidate) noexcept {
    if (candidate == index) return;
    if (distance < best) {
      second = best;
      best = distance;
      index = candidate;
    } else if (distance < second) {
      second = distance;
    }
  }

  template <Scalar S>
  [[nodiscard]] bool accepted(int max_distance, S max_ratio) const noexcept {
    return index != kNone && best <= max_distance &&
           (second == std::numeric_limits<int>::max() ||
            static_cast<S>(best) <= max_ratio * static_cast<S>(second));
  }
};

// Where a landmark should appear, if it can be seen from this pose at all.
template <Scalar S>
struct PredictedPoint {
  Vec2<S> pixel;
  S sigma;  // feature size at this distance
  bool visible = false;
};

template <Scalar S>
[[nodiscard]] PredictedPoint<S> predict_point(const PointLandmark<S>& landmark, const Frame<S>& frame,
                                              const SE3<S>& cam_from_world, S min_view_cosine) {
  PredictedPoint<S> predicted;
  const Vec3<S> in_camera = cam_from_world * landmark.position;
  if (in_camera.z() <= S(1e-6)) return predicted;
  predicted.pixel = frame.pinhole.project(in_camera);
  if (!(predicted.pixel.x() >= 0 && predicted.pixel.y() >= 0 && predicted.pixel.x() < S(frame.width) &&
        predicted.pixel.y() < S(frame.height)))
    return predicted;
  const S distance = in_camera.norm();
  const Vec3<S> to_camera = cam_from_world.rotation.inverse() * (-in_camera / distance);
  predicted.sigma = landmark.extent / distance;
  predicted.visible = to_camera.dot(landmark.viewing_direction) > min_view_cosine;
  return predicted;
}

// Matches landmarks to features of the frame that are still free, within `radius` pixels (times the predicted
// feature size) of where the frame's pose puts them. Returns the number of new matches; landmarks that should
// be visible are passed to `seen(id, matched)`.
template <Scalar S, class Seen>
int match_points_by_projection(const Map<S>& map, std::span<const LandmarkId> candidates,
                               TrackedFrame<S>& frame, S radius, const PointMatchOptions<S>& options,
                               Seen seen) {
  int matched = 0;
  for (const LandmarkId id : candidates) {
    const PointLandmark<S>& landmark = map.points[map.index(id)];
    if (!landmark.alive) continue;
    const auto predicted =
        predict_point(landmark, frame.frame, frame.cam_from_world, options.min_view_cosine);
    if (!predicted.visible) continue;
    const S reach = radius * std::max(S(1), predicted.sigma);
    const Descriptor& descriptor = landmark.descriptor;
    BestTwo two;
    frame.grid.near(predicted.pixel, reach, [&](std::int32_t i) {
      const PointFeature<S>& feature = frame.frame.points[map.index(i)];
      if (frame.point_landmarks[map.index(i)] != kNone) return;
      if ((feature.pixel - predicted.pixel).squaredNorm() > reach * reach) return;
      const S scale = feature.sigma / predicted.sigma;
      if (scale > options.max_scale_ratio || scale * options.max_scale_ratio < 1) return;
      two.offer(hamming(descriptor, feature.descriptor), i);
    });
    const bool found = two.accepted(options.max_distance, options.max_ratio);
    if (found) {
      frame.point_landmarks[map.index(two.index)] = id;
      ++matched;
    }
    seen(id, found);
  }
  return matched;
}

struct IndexPair {
  std::int32_t first = kNone;
  std::int32_t second = kNone;
};

// Keeps only pairs whose feature rotation agrees with the three most common ones (30 bins of 12 degrees).
template <Scalar S>
void keep_consistent_rotation(std::span<const PointFeature<S>> a, std::span<const PointFeature<S>> b,
                              std::vector<IndexPair>& pairs) {
  constexpr int kBins = 30;
  std::array<int, kBins> histogram{};
  const auto bin_of = [&](const IndexPair& p) {
    S turn = (b[static_cast<std::size_t>(p.second)].angle - a[static_cast<std::size_t>(p.first)].angle) /
             (2 * std::numbers::pi_v<S>);
    turn -= std::floor(turn);
    return static_cast<std::size_t>(std::lround(turn * kBins)) % kBins;
  };
  for (const auto& p : pairs) ++histogram[bin_of(p)];
  std::array<std::size_t, kBins> order{};
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::sort(order.begin(), order.end(), [&](auto x, auto y) {
    return histogram[x] != histogram[y] ? histogram[x] > histogram[y] : x < y;
  });
  const int least = histogram[order[0]] / 10;
  std::array<bool, kBins> keep{};
  for (std::size_t k = 0; k < 3; ++k) keep[order[k]] = histogram[order[k]] > least;
  std::erase_if(pairs, [&](const IndexPair& p) { return !keep[bin_of(p)]; });
}

}  // namespace sslam
