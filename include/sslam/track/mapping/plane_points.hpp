// SPDX-License-Identifier: BSD-3-Clause
// New points where the views are too close together to triangulate: a ray meets a known plane, and the plane
// gives the depth. Only where a keyframe sees few landmarks, for it is a guess that the views hardly check.
#pragma once

#include <optional>
#include <vector>

#include "sslam/core/parameter.hpp"
#include "sslam/map/feature_grid.hpp"
#include "sslam/map/plane_extent.hpp"
#include "sslam/track/matching/mutual_matcher.hpp"

namespace sslam {

template <Scalar S>
struct PlanePointOptions {
  std::size_t few_landmarks = 0;   // that a keyframe sees, points and lines, below which it is done; 0: never
  std::size_t max_neighbours = 3;  // connected keyframes to match with
  S reach = S(0.15);               // of a plane beyond its members, over the median scene depth
  S max_error = 3;                 // between the point's image and its match, standard deviations
  PointMatchOptions<S> match{.max_distance = 50};

  template <class Self, class Visit>
  static void parameters(Self& self, Visit&& visit) {
    // few_landmarks is listed with the planes.
    visit("max_neighbours", self.max_neighbours, Unit::kCount, 0, 1e6, "keyframes to match with");
    visit("reach", self.reach, Unit::kNumber, 0, 1e6,
          "of a plane beyond its members over the median scene depth");
    visit("max_error", self.max_error, Unit::kNumber, 0.1, 100,
          "between a point's image and its match, standard deviations");
    visit_within("", self.match, visit);
  }
};
static_assert(Described<PlanePointOptions<double>>);

template <Scalar S>
class PlanePoints {
 public:
  PlanePointOptions<S> options;

  // Returns how many points were added; each is a member of its plane, which bundle adjustment may take back.
  int create(Map<S>& map, KeyframeId id, S median_depth) {
    if (options.few_landmarks == 0 || seen(map.keyframes[map.index(id)]) >= options.few_landmarks) return 0;
    gather_extents(map, extents_);
    int added = 0;
    const auto neighbours = map.keyframes[map.index(id)].neighbours;
    for (std::size_t i = 0; i < neighbours.size() && i < options.max_neighbours; ++i)
      added += create_with(map, id, neighbours[i].keyframe, median_depth);
    return added;
  }

 private:
  struct Intersection {
    Vec3<S> place;  // world
    LandmarkId plane;
  };

  [[nodiscard]] static std::size_t seen(const Keyframe<S>& kf) {
    return static_cast<std::size_t>(count_held(kf.point_landmarks) + count_held(kf.line_landmarks));
  }

  int create_with(Map<S>& map, KeyframeId id_a, KeyframeId id_b, S median_depth) {
    const Keyframe<S>& a = map.keyframes[map.index(id_a)];
    const Keyframe<S>& b = map.keyframes[map.index(id_b)];
    grid_.build(b.frame.points, b.frame.width, b.frame.height);
    intersections_.assign(a.frame.points.size(), std::nullopt);
    for (std::size_t i = 0; i < intersections_.size(); ++i)
      if (a.point_landmarks[i] == kNone)
        intersections_[i] = meet(map, a, a.frame.points[i].pixel, median_depth);
    matcher_.match(
        a.frame.points, b.frame.points, options.match,
        [&](std::int32_t i, auto visit) {
          const auto& hit = intersections_[map.index(i)];
          if (!hit) return;
          const Vec3<S> in_b = b.cam_from_world * hit->place;
          if (!(in_b.z() > 0)) return;
          const Vec2<S> expected = b.frame.pinhole.project(in_b);
          const S sigma = a.frame.points[map.index(i)].sigma;
          const S radius = options.max_error * sigma;
          grid_.near(expected, radius, [&](std::int32_t j) {
            const PointFeature<S>& other = b.frame.points[map.index(j)];
            const S scale = other.sigma / sigma;
            if (b.point_landmarks[map.index(j)] != kNone || scale > options.match.max_scale_ratio ||
                scale * options.match.max_scale_ratio < 1)
              return;
            if ((other.pixel - expected).squaredNorm() < radius * radius) visit(j);
          });
        },
        pairs_);
    for (const IndexPair& p : pairs_) {
      const Intersection& hit = *intersections_[map.index(p.first)];
      const LandmarkId landmark = map.add_point(hit.place, id_a);
      map.lay_point(landmark, hit.plane);
      map.observe_point(landmark, id_b, map.index(p.second));
      map.observe_point(landmark, id_a, map.index(p.first));
    }
    return static_cast<int>(pairs_.size());
  }

  // The nearest place where the pixel's ray meets a plane, not far from what is known to lie on it.
  [[nodiscard]] std::optional<Intersection> meet(const Map<S>& map, const Keyframe<S>& kf,
                                                 const Vec2<S>& pixel, S median_depth) const {
    const SE3<S> world_from_cam = kf.cam_from_world.inverse();
    const Vec3<S> ray = world_from_cam.rotation * kf.frame.pinhole.unproject(pixel);
    std::optional<Intersection> best;
    S nearest = std::numeric_limits<S>::infinity();
    for (std::size_t p = 0; p < map.planes.size(); ++p) {
      S along = 0;
      if (!map.planes[p].alive || !map.planes[p].plane.meet(world_from_cam.translation, ray, along)) continue;
      if (!(along > 0) || along >= nearest) continue;
      const Vec3<S> place = world_from_cam.translation + along * ray;
      if (!extents_[p].covers(place, options.reach * median_depth)) continue;
      nearest = along;
      best = Intersection{place, static_cast<LandmarkId>(p)};
    }
    return best;
  }

  std::vector<PlaneExtent<S>> extents_;  // by plane
  FeatureGrid<S> grid_;
  std::vector<std::optional<Intersection>> intersections_;  // by feature
  MutualMatcher matcher_;
  std::vector<IndexPair> pairs_;
};

}  // namespace sslam
