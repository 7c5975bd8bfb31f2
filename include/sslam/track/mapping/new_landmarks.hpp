// SPDX-License-Identifier: BSD-3-Clause
// New landmarks for a new keyframe: free points and lines are matched with the connected keyframes and
// triangulated.
#pragma once

#include <span>
#include <vector>

#include "sslam/core/parameter.hpp"
#include "sslam/solver/triangulation/triangulate_line.hpp"
#include "sslam/solver/triangulation/triangulate_point.hpp"
#include "sslam/track/matching/match_lines.hpp"
#include "sslam/track/matching/mutual_matcher.hpp"

namespace sslam {

template <Scalar S>
struct NewLandmarkOptions {
  bool use_points = true;
  bool use_lines = true;
  std::size_t max_neighbours = 8;        // connected keyframes to match with
  S min_baseline = S(0.015);             // between the two cameras over the median scene depth
  S nearest = S(0.2), farthest = S(15);  // depth of a new landmark over the median scene depth
  S max_epipolar = S(2.5);               // distance from the epipolar line over the feature's sigma
  S min_line_overlap = S(0.3);           // of the stretches that the two views see
  PointTriangulationOptions<S> point{.min_parallax = radians(S(0.8))};
  LineTriangulationOptions<S> line{.min_parallax = radians(S(2)), .solver = {}};
  PointMatchOptions<S> points{.max_distance = 50};
  LineMatchOptions<S> lines{.max_distance = 50, .max_angle = radians(S(20))};

  template <class Self, class Visit>
  static void parameters(Self& self, Visit&& visit) {
    visit("use_points", self.use_points, Unit::kCount, 0, 1, "1: new points are made");
    visit("use_lines", self.use_lines, Unit::kCount, 0, 1, "1: new lines are made");
    visit("max_neighbours", self.max_neighbours, Unit::kCount, 0, 1e6, "keyframes to triangulate with");
    visit("min_baseline", self.min_baseline, Unit::kNumber, 0, 1e6,
          "between two keyframes over the median scene depth");
    visit("nearest", self.nearest, Unit::kNumber, 0, 1e6,
          "depth of a new landmark over the median scene depth, at least");
    visit("farthest", self.farthest, Unit::kNumber, 0, 1e6,
          "depth of a new landmark over the median scene depth, at most");
    visit("max_epipolar", self.max_epipolar, Unit::kNumber, 0.1, 1000,
          "distance from the epipolar line over the feature's sigma");
    visit("min_point_parallax", self.point.min_parallax, Unit::kDegrees, 0, 90, "of a new point");
    visit("min_line_parallax", self.line.min_parallax, Unit::kDegrees, 0, 90,
          "between the planes of a new line");
    visit("min_line_overlap", self.min_line_overlap, Unit::kShare, 0, 1,
          "of the stretches that the two views see");
    visit_within("points.", self.points, visit);
    visit_within("lines.", self.lines, visit);
    visit_within("point.", self.point, visit);
    visit_within("line.", self.line, visit);
  }
};
static_assert(Described<NewLandmarkOptions<double>>);

template <Scalar S>
class NewLandmarks {
 public:
  NewLandmarkOptions<S> options;

  // Returns how many landmarks were added.
  int create(Map<S>& map, KeyframeId id, S median_depth);

 private:
  int create_points(Map<S>& map, KeyframeId id_a, KeyframeId id_b, S median_depth) {
    const Keyframe<S>& a = map.keyframes[map.index(id_a)];
    const Keyframe<S>& b = map.keyframes[map.index(id_b)];
    grid_.build(b.frame.points, b.frame.width, b.frame.height);
    const Mat3<S> essential = hat(b_from_a_.translation) * b_from_a_.rotation.matrix();
    matcher_.match(
        a.frame.points, b.frame.points, options.points,
        [&](std::int32_t i, auto visit) { visit_epipolar(a, b, essential, median_depth, i, visit); }, pairs_);
    int added = 0;
    for (const IndexPair& p : pairs_) added += add_point(map, id_a, id_b, p, median_depth) ? 1 : 0;
    return added;
  }

  // Calls visit for the free features of b on the part of the epipolar line of feature i where a depth is
  // plausible.
  template <class Visit>
  void visit_epipolar(const Keyframe<S>& a, const Keyframe<S>& b, const Mat3<S>& essential, S median_depth,
                      std::int32_t i, Visit visit) const {
    if (a.point_landmarks[Map<S>::index(i)] != kNone) return;
    const PointFeature<S>& feature = a.frame.points[Map<S>::index(i)];
    const Vec3<S> ray = a.frame.pinhole.unproject(feature.pixel);
    const Vec3<S> near = b_from_a_ * (ray * options.nearest * median_depth);
    const Vec3<S> far = b_from_a_ * (ray * options.farthest * median_depth);
    if (near.z() <= 0 || far.z() <= 0) return;
    const Vec2<S> from = b.frame.pinhole.project(near), to = b.frame.pinhole.project(far);
    const Vec3<S> line = essential * ray;  // in normalised coordinates of b
    const S norm = line.template head<2>().norm();
    if (!(norm > 0)) return;
    constexpr S kStep = 15;  // pixels between looks into the grid
    const S length = std::min((to - from).norm(), S(2 * std::max(b.frame.width, b.frame.height)));
    const int steps = 1 + static_cast<int>(length / kStep);
    for (int k = 0; k <= steps; ++k) {
      const Vec2<S> at = to + (from - to) * (static_cast<S>(k) / static_cast<S>(steps));
      if (at.x() < 0 || at.y() < 0 || at.x() >= S(b.frame.width) || at.y() >= S(b.frame.height)) continue;
      grid_.near(at, kStep / 2 + options.max_epipolar, [&](std::int32_t j) {
        if (b.point_landmarks[Map<S>::index(j)] != kNone) return;
        const PointFeature<S>& other = b.frame.points[Map<S>::index(j)];
        const S scale = other.sigma / feature.sigma;
        if (scale > options.points.max_scale_ratio || scale * options.points.max_scale_ratio < 1) return;
        const S distance =
            std::abs(line.dot(b.frame.pinhole.unproject(other.pixel))) / norm * b.frame.pinhole.fx;
        if (distance < options.max_epipolar * other.sigma) visit(j);
      });
    }
  }

  bool add_point(Map<S>& map, KeyframeId id_a, KeyframeId id_b, const IndexPair& p, S median_depth) {
    const Keyframe<S>& a = map.keyframes[map.index(id_a)];
    const Keyframe<S>& b = map.keyframes[map.index(id_b)];
    const auto view = [](const Keyframe<S>& kf, std::int32_t feature) {
      const PointFeature<S>& f = kf.frame.points[Map<S>::index(feature)];
      return PointView<S>{kf.cam_from_world, kf.frame.pinhole.unproject(f.pixel).template head<2>(),
                          f.sigma / kf.frame.pinhole.fx};
    };
    const std::array views{view(a, p.first), view(b, p.second)};
    const auto answer = triangulate_point<S>(views, options.point);
    if (!usable(answer.status) || !plausible_depth(a, answer.point, median_depth)) return false;
    const LandmarkId landmark = map.add_point(answer.point, id_a);
    map.observe_point(landmark, id_b, Map<S>::index(p.second));
    map.observe_point(landmark, id_a, Map<S>::index(p.first));
    return true;
  }

  int create_lines(Map<S>& map, KeyframeId id_a, KeyframeId id_b, S median_depth) {
    const Keyframe<S>& a = map.keyframes[map.index(id_a)];
    const Keyframe<S>& b = map.keyframes[map.index(id_b)];
    const SO3<S> turn = b_from_a_.rotation;
    const auto may_match = [&](std::size_t i, std::size_t j) {
      if (b.line_landmarks[j] != kNone) return false;
      if (a.line_axes[i] != kNone && b.line_axes[j] != kNone && a.line_axes[i] != b.line_axes[j])
        return false;
      return similar_direction(a, a.frame.lines[i].segment, b, b.frame.lines[j].segment, turn);
    };
    matcher_.match(
        a.frame.lines, b.frame.lines, options.lines,
        [&](std::int32_t i, auto visit) {
          if (a.line_landmarks[map.index(i)] != kNone) return;
          for (std::size_t j = 0; j < b.frame.lines.size(); ++j)
            if (may_match(map.index(i), j)) visit(static_cast<std::int32_t>(j));
        },
        pairs_);
    int added = 0;
    for (const IndexPair& p : pairs_) added += add_line(map, id_a, id_b, p, median_depth) ? 1 : 0;
    return added;
  }

  // Whether the segment, turned into the other camera as if far away, points the same way there.
  [[nodiscard]] bool similar_direction(const Keyframe<S>& a, const Segment2<S>& in_a, const Keyframe<S>& b,
                                       const Segment2<S>& in_b, const SO3<S>& b_from_a) const {
    const Vec3<S> start = b_from_a * a.frame.pinhole.unproject(in_a.start);
    const Vec3<S> end = b_from_a * a.frame.pinhole.unproject(in_a.end);
    if (start.z() <= 0 || end.z() <= 0) return false;
    const Vec2<S> turned = b.frame.pinhole.project(end) - b.frame.pinhole.project(start);
    return turned.normalized().dot(in_b.direction()) > std::cos(options.lines.max_angle);
  }

  bool add_line(Map<S>& map, KeyframeId id_a, KeyframeId id_b, const IndexPair& p, S median_depth) {
    const Keyframe<S>& a = map.keyframes[map.index(id_a)];
    const Keyframe<S>& b = map.keyframes[map.index(id_b)];
    const auto view = [](const Keyframe<S>& kf, std::int32_t feature) {
      const LineFeature<S>& f = kf.frame.lines[Map<S>::index(feature)];
      return make_line_view(kf.cam_from_world, kf.frame.pinhole, f.segment, f.sigma);
    };
    const std::array views{view(a, p.first), view(b, p.second)};
    const auto answer =
        triangulate(map, a.line_axes[map.index(p.first)], b.line_axes[map.index(p.second)], views);
    if (!usable(answer.status)) return false;
    if (!plausible_depth(a, answer.start, median_depth) || !plausible_depth(a, answer.end, median_depth))
      return false;
    if (answer.overlap < options.min_line_overlap) return false;
    const LandmarkId landmark = map.add_line(answer.line, answer.start, answer.end, id_a);
    map.observe_line(landmark, id_b, Map<S>::index(p.second));
    map.observe_line(landmark, id_a, Map<S>::index(p.first));
    return true;
  }

  // With too little parallax for four degrees of freedom there may be enough for the two that are left along
  // the Manhattan axis which both views see the segment follow.
  [[nodiscard]] LineTriangulation<S> triangulate(const Map<S>& map, std::int8_t axis_a, std::int8_t axis_b,
                                                 std::span<const LineView<S>> views) const {
    const auto answer = triangulate_line<S>(views, options.line);
    if (answer.status != Status::kLowParallax || axis_a == kNone || axis_a != axis_b) return answer;
    return triangulate_line_along<S>(views, map.axis(axis_a), options.line);
  }

  [[nodiscard]] bool plausible_depth(const Keyframe<S>& keyframe, const Vec3<S>& point,
                                     S median_depth) const {
    const S depth = (keyframe.cam_from_world * point).z();
    return depth > options.nearest * median_depth && depth < options.farthest * median_depth;
  }

  SE3<S> b_from_a_;
  FeatureGrid<S> grid_;
  MutualMatcher matcher_;
  std::vector<IndexPair> pairs_;
};

template <Scalar S>
int NewLandmarks<S>::create(Map<S>& map, KeyframeId id, S median_depth) {
  int added = 0;
  const auto neighbours = map.keyframes[map.index(id)].neighbours;
  for (std::size_t i = 0; i < neighbours.size() && i < options.max_neighbours; ++i) {
    const Keyframe<S>& a = map.keyframes[map.index(id)];
    const Keyframe<S>& b = map.keyframes[map.index(neighbours[i].keyframe)];
    b_from_a_ = b.cam_from_world * a.cam_from_world.inverse();
    if (b_from_a_.translation.norm() < options.min_baseline * median_depth) continue;
    if (options.use_points) added += create_points(map, id, neighbours[i].keyframe, median_depth);
    if (options.use_lines) added += create_lines(map, id, neighbours[i].keyframe, median_depth);
  }
  return added;
}

}  // namespace sslam
