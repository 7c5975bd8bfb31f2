// SPDX-License-Identifier: BSD-3-Clause
// Line matching: landmarks by reprojection search.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>

#include "sslam/core/parameter.hpp"
#include "sslam/track/matching/match_points.hpp"

namespace sslam {

template <Scalar S>
struct LineMatchOptions {
  int max_distance = 70;        // bits of 256 in which two views of one segment may differ
  S max_ratio = S(0.85);        // best distance over second best, when matching by descriptor alone
  S max_angle = radians(S(6));  // between the predicted and the seen segment
  S min_overlap = S(0.3);       // of the shorter segment, along the predicted one
  S near_plane = S(1e-2);       // depth below which a landmark is cut off, map units

  template <class Self, class Visit>
  static void parameters(Self& self, Visit&& visit) {
    visit("max_distance", self.max_distance, Unit::kCount, 0, 256,
          "bits in which two views of one segment may differ");
    visit("max_ratio", self.max_ratio, Unit::kShare, 0, 1,
          "best distance over second best, by descriptor alone");
    visit("max_angle", self.max_angle, Unit::kDegrees, 0, 90, "between the predicted and the seen segment");
    visit("min_overlap", self.min_overlap, Unit::kShare, 0, 1,
          "of the shorter segment along the predicted one");
    visit("near_plane", self.near_plane, Unit::kNumber, 0, 1e6,
          "depth below which a landmark is cut off, units of the map");
  }
};
static_assert(Described<LineMatchOptions<double>>);

// The part of a 3D segment in front of the camera, in pixels; nothing when it lies behind or outside the
// image.
template <Scalar S>
[[nodiscard]] std::optional<Segment2<S>> predict_segment(const LineLandmark<S>& landmark,
                                                         const Frame<S>& frame, const SE3<S>& cam_from_world,
                                                         S near_plane) {
  Vec3<S> a = cam_from_world * landmark.start;
  Vec3<S> b = cam_from_world * landmark.end;
  if (a.z() < near_plane && b.z() < near_plane) return std::nullopt;
  const auto cut = [&](Vec3<S>& behind, const Vec3<S>& front) {
    if (behind.z() < near_plane)
      behind += (front - behind) * ((near_plane - behind.z()) / (front.z() - behind.z()));
  };
  cut(a, b);
  cut(b, a);
  Segment2<S> segment{frame.pinhole.project(a), frame.pinhole.project(b)};
  const Vec2<S> direction = segment.end - segment.start;
  // Liang-Barsky clipping against the image rectangle.
  S enter = 0, leave = 1;
  const auto clip = [&](S origin, S slope, S low, S high) {
    if (std::abs(slope) < S(1e-9)) return origin >= low && origin <= high;
    const S t0 = (low - origin) / slope, t1 = (high - origin) / slope;
    enter = std::max(enter, std::min(t0, t1));
    leave = std::min(leave, std::max(t0, t1));
    return enter < leave;
  };
  if (!clip(segment.start.x(), direction.x(), 0, S(frame.width - 1)) ||
      !clip(segment.start.y(), direction.y(), 0, S(frame.height - 1)))
    return std::nullopt;
  segment.end = segment.start + leave * direction;
  segment.start += enter * direction;
  return segment;
}

// Length that two nearly parallel segments share along the direction of the first, over the shorter length.
template <Scalar S>
[[nodiscard]] S overlap_ratio(const Segment2<S>& along, const Segment2<S>& other) {
  const Vec2<S> axis = along.direction();
  const S length = along.length();
  const S s0 = axis.dot(other.start - along.start), s1 = axis.dot(other.end - along.start);
  const S low = std::max(S(0), std::min(s0, s1)), high = std::min(length, std::max(s0, s1));
  const S shorter = std::min(length, std::abs(s1 - s0));
  return shorter > S(1e-6) ? (high - low) / shorter : S(0);
}

// Geometric agreement of a seen segment with a predicted one: same direction, both ends within `radius`
// pixels of the predicted line, and a common stretch.
template <Scalar S>
[[nodiscard]] bool segments_agree(const Segment2<S>& predicted, const Segment2<S>& seen, S radius,
                                  const LineMatchOptions<S>& options) {
  if (predicted.direction().dot(seen.direction()) < std::cos(options.max_angle)) return false;
  const Vec3<S> line = line_through(predicted.start, predicted.end);
  const S d0 = line.template head<2>().dot(seen.start) + line.z();
  const S d1 = line.template head<2>().dot(seen.end) + line.z();
  return std::abs(d0) < radius && std::abs(d1) < radius &&
         overlap_ratio(predicted, seen) > options.min_overlap;
}

// Matches line landmarks to free segments near where the frame's pose puts them; see
// match_points_by_projection.
template <Scalar S, class Seen>
int match_lines_by_projection(const Map<S>& map, std::span<const LandmarkId> candidates,
                              TrackedFrame<S>& frame, S radius, const LineMatchOptions<S>& options,
                              Seen seen) {
  int matched = 0;
  for (const LandmarkId id : candidates) {
    const LineLandmark<S>& landmark = map.lines[map.index(id)];
    if (!landmark.alive) continue;
    const auto predicted = predict_segment(landmark, frame.frame, frame.cam_from_world, options.near_plane);
    if (!predicted || predicted->length() < radius) continue;
    const Descriptor& descriptor = landmark.descriptor;
    BestTwo two;
    for (std::size_t i = 0; i < frame.frame.lines.size(); ++i) {
      if (frame.line_landmarks[i] != kNone) continue;
      const LineFeature<S>& feature = frame.frame.lines[i];
      if (segments_agree(*predicted, feature.segment, radius, options))
        two.offer(hamming(descriptor, feature.descriptor), static_cast<std::int32_t>(i));
    }
    // Parallel neighbours look alike; the prediction decides between them, so no ratio is asked for.
    const bool found = two.index != kNone && two.best <= options.max_distance;
    if (found) {
      frame.line_landmarks[map.index(two.index)] = id;
      ++matched;
    }
    seen(id, found);
  }
  return matched;
}

}  // namespace sslam
