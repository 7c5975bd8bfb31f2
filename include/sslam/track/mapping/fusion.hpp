// SPDX-License-Identifier: BSD-3-Clause
// Fusion: landmarks that stand twice in the map become one, and keyframes see landmarks that they had missed.
#pragma once

#include "sslam/core/parameter.hpp"
#include "sslam/map/local_map.hpp"
#include "sslam/track/matching/match_lines.hpp"

namespace sslam {

template <Scalar S>
struct FusionOptions {
  std::size_t max_neighbours = 8;
  S point_radius = 3;  // pixels between a projected landmark and the feature that takes it over
  S line_radius = 4;   // pixels between a projected line and the ends of the segment
  PointMatchOptions<S> points{.max_distance = 50};
  LineMatchOptions<S> lines{.max_distance = 60};

  template <class Self, class Visit>
  static void parameters(Self& self, Visit&& visit) {
    visit("max_neighbours", self.max_neighbours, Unit::kCount, 0, 1e6, "keyframes to fuse with");
    visit("point_radius", self.point_radius, Unit::kPixels, 0.1, kUnbounded,
          "between a projected landmark and the feature that takes it over");
    visit("line_radius", self.line_radius, Unit::kPixels, 0.1, kUnbounded,
          "between a projected line and the ends of the segment");
    visit_within("points.", self.points, visit);
    visit_within("lines.", self.lines, visit);
  }
};
static_assert(Described<FusionOptions<double>>);

template <Scalar S>
class LandmarkFusion {
 public:
  FusionOptions<S> options;

  // Both ways between the keyframe and its neighbours.
  void fuse(Map<S>& map, KeyframeId id);

  // The keyframe observes those of the landmarks that it shows; what it saw in their stead becomes one with
  // them.
  void take_in(Map<S>& map, KeyframeId target, std::vector<LandmarkId> point_ids,
               std::vector<LandmarkId> line_ids);

 private:
  void fuse_point(Map<S>& map, KeyframeId target, LandmarkId id) {
    const Keyframe<S>& kf = map.keyframes[map.index(target)];
    const PointLandmark<S>& landmark = map.points[map.index(id)];
    const auto predicted =
        predict_point(landmark, kf.frame, kf.cam_from_world, options.points.min_view_cosine);
    if (!predicted.visible) return;
    const S reach = options.point_radius * std::max(S(1), predicted.sigma);
    BestTwo two;
    grid_.near(predicted.pixel, reach, [&](std::int32_t i) {
      const PointFeature<S>& feature = kf.frame.points[map.index(i)];
      const S scale = feature.sigma / predicted.sigma;
      if (scale > options.points.max_scale_ratio || scale * options.points.max_scale_ratio < 1) return;
      if ((feature.pixel - predicted.pixel).squaredNorm() < reach * reach)
        two.offer(hamming(landmark.descriptor, feature.descriptor), i);
    });
    if (two.index == kNone || two.best > options.points.max_distance) return;
    const LandmarkId other = kf.point_landmarks[map.index(two.index)];
    if (other == kNone) {
      map.observe_point(id, target, map.index(two.index));
    } else if (map.points[map.index(other)].observations.size() > landmark.observations.size()) {
      map.fuse_points(id, other);
    } else {
      map.fuse_points(other, id);
    }
  }

  void fuse_line(Map<S>& map, KeyframeId target, LandmarkId id) {
    const Keyframe<S>& kf = map.keyframes[map.index(target)];
    const LineLandmark<S>& landmark = map.lines[map.index(id)];
    const auto predicted = predict_segment(landmark, kf.frame, kf.cam_from_world, options.lines.near_plane);
    if (!predicted || predicted->length() < options.line_radius) return;
    BestTwo two;
    for (std::size_t i = 0; i < kf.frame.lines.size(); ++i)
      if (segments_agree(*predicted, kf.frame.lines[i].segment, options.line_radius, options.lines))
        two.offer(hamming(landmark.descriptor, kf.frame.lines[i].descriptor), static_cast<std::int32_t>(i));
    if (two.index == kNone || two.best > options.lines.max_distance) return;
    const LandmarkId other = kf.line_landmarks[map.index(two.index)];
    if (other == kNone) {
      map.observe_line(id, target, map.index(two.index));
    } else if (map.lines[map.index(other)].observations.size() > landmark.observations.size()) {
      map.fuse_lines(id, other);
    } else {
      map.fuse_lines(other, id);
    }
  }

  LocalMap<S> local_;
  FeatureGrid<S> grid_;
};

template <Scalar S>
void LandmarkFusion<S>::fuse(Map<S>& map, KeyframeId id) {
  local_.gather_around(map, id, options.max_neighbours + 1);
  const auto around = local_.keyframes;
  const auto neighbour_points = local_.points;
  const auto neighbour_lines = local_.lines;
  take_in(map, id, neighbour_points, neighbour_lines);
  for (std::size_t i = 1; i < around.size(); ++i)
    take_in(map, around[i], map.keyframes[map.index(id)].point_landmarks,
            map.keyframes[map.index(id)].line_landmarks);
}

template <Scalar S>
void LandmarkFusion<S>::take_in(Map<S>& map, KeyframeId target, std::vector<LandmarkId> point_ids,
                                std::vector<LandmarkId> line_ids) {
  const Keyframe<S>& kf = map.keyframes[map.index(target)];
  grid_.build(kf.frame.points, kf.frame.width, kf.frame.height);
  for (const LandmarkId id : point_ids)
    if (id != kNone && map.points[map.index(id)].alive && !map.points[map.index(id)].seen_by(target))
      fuse_point(map, target, id);
  for (const LandmarkId id : line_ids)
    if (id != kNone && map.lines[map.index(id)].alive && !map.lines[map.index(id)].seen_by(target))
      fuse_line(map, target, id);
}

}  // namespace sslam
