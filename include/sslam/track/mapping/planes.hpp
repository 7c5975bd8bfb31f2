// SPDX-License-Identifier: BSD-3-Clause
// Planes across the Manhattan axes: where points and lines crowd at one distance along an axis, and spread in
// the other two, there is a wall, a floor or a ceiling, and they are its members.
#pragma once

#include <algorithm>
#include <concepts>
#include <cstdint>
#include <optional>
#include <vector>

#include "sslam/core/parameter.hpp"
#include "sslam/map/landmark_precision.hpp"
#include "sslam/map/local_map.hpp"
#include "sslam/map/plane_extent.hpp"
#include "sslam/solver/modes/offset_modes.hpp"
#include "sslam/track/mapping/plane_points.hpp"

namespace sslam {

// Finds planes and their members around a new keyframe.
template <class T, class S>
concept PlaneStep = requires(T step, Map<S>& map, KeyframeId keyframe, S median_depth) {
  {step.find(map, keyframe, median_depth)};
};

// No planes.
template <Scalar S>
struct NoPlanes {
  void find(Map<S>&, KeyframeId, S) {}
};
static_assert(PlaneStep<NoPlanes<double>, double>);

// Lengths are parts of the median scene depth.
template <Scalar S>
struct PlaneOptions {
  std::size_t min_members = 16;    // of a new plane, half as many of an old one; 0: no plane is looked for
  S tolerance = S(0.01);           // of a member's distance from the plane, either way
  S max_sigma = S(0.01);           // of a member along the normal: less sure landmarks prove no plane
  S max_tilt = radians(S(2));      // of a line against its plane
  S min_spread = S(0.12);          // standard deviation of the members in the plane, where they spread least
  S min_contrast = 5;              // members over what their surroundings make expect
  S reach = S(0.3);                // of a plane beyond its members
  std::size_t max_keyframes = 10;  // whose landmarks are looked at
  // Between the keyframe's rotation and the one that the Manhattan frame gives it: beyond, or where it gives
  // none, the walls here are not the frame's, and no plane is looked for.
  S max_turn = radians(S(0.5));

  template <class Self, class Visit>
  static void parameters(Self& self, Visit&& visit) {
    visit("min_members", self.min_members, Unit::kCount, 0, 1e6,
          "points and lines that make a plane; 0: none is looked for");
    visit("tolerance", self.tolerance, Unit::kNumber, 1e-6, 10,
          "distance of a member from its plane over the median scene depth");
    visit("max_sigma", self.max_sigma, Unit::kNumber, 1e-6, 10,
          "of a member along the plane's normal over the median scene depth");
    visit("max_tilt", self.max_tilt, Unit::kDegrees, 0, 90, "of a line against its plane");
    visit("min_spread", self.min_spread, Unit::kNumber, 0, 10,
          "of the members in the plane over the median scene depth");
    visit("min_contrast", self.min_contrast, Unit::kNumber, 0, 1e6,
          "members over what their surroundings make expect");
    visit("reach", self.reach, Unit::kNumber, 0, 1e6,
          "of a plane beyond its members over the median scene depth");
    visit("max_keyframes", self.max_keyframes, Unit::kCount, 1, 1e6, "whose landmarks are looked at");
    visit("max_turn", self.max_turn, Unit::kDegrees, 0, 180,
          "between a keyframe's rotation and the Manhattan frame's, beyond which it finds none");
  }
};
static_assert(Described<PlaneOptions<double>>);

template <Scalar S>
class ManhattanPlanes {
 public:
  PlaneOptions<S> options;
  PlanePoints<S> points;

  template <class Self, class Visit>
  static void parameters(Self& self, Visit&& visit) {
    visit_within("", self.options, visit);
    visit("few_landmarks", self.points.options.few_landmarks, Unit::kCount, 0, 1e6,
          "of a keyframe, below which planes give new points their depth; 0: never");
    visit_stage("points.", self.points, visit);
  }

  void find(Map<S>& map, KeyframeId id, S median_depth);

 private:
  struct Candidate {
    S offset;  // along the axis
    LandmarkId id;
    bool line;
  };

  // Once for each axis: what it finds has no extent until the next keyframe.
  void find_across(Map<S>& map, std::int8_t axis) {
    const Vec3<S> normal = map.axis(axis);
    gather(map, axis, normal);
    join(map, axis);
    while (add_plane(map, axis, normal)) continue;
  }

  // Counts members, lets planes go that have lost theirs, and joins those that coincide.
  void settle(Map<S>& map) {
    extents_.assign(map.planes.size(), std::nullopt);
    for (std::size_t p = 0; p < map.planes.size(); ++p) {
      const auto id = static_cast<LandmarkId>(p);
      map.planes[p].support = static_cast<std::int32_t>(map.members(id).size());
      if (map.planes[p].alive && 2 * map.members(id).size() < options.min_members) map.erase_plane(id);
    }
    for (std::size_t p = 0; p < map.planes.size(); ++p)
      for (std::size_t q = p + 1; q < map.planes.size() && map.planes[p].alive; ++q)
        if (map.planes[q].alive && coincide(map.planes[p], map.planes[q]) &&
            extent(map, p).meets(extent(map, q), options.reach * depth_))
          merge(map, static_cast<LandmarkId>(q), static_cast<LandmarkId>(p));
  }

  // As the plane's members cover it when this keyframe first asks.
  const PlaneExtent<S>& extent(const Map<S>& map, std::size_t plane) {
    if (!extents_[plane]) extents_[plane] = extent_of(map, static_cast<LandmarkId>(plane));
    return *extents_[plane];
  }

  [[nodiscard]] bool coincide(const PlaneLandmark<S>& a, const PlaneLandmark<S>& b) const {
    return a.axis != kNone && a.axis == b.axis &&
           std::abs(a.plane.distance - b.plane.distance) < options.tolerance * depth_;
  }

  void merge(Map<S>& map, LandmarkId from, LandmarkId into) {
    map.move_members(from, into);
    map.erase_plane(from);
    map.planes[map.index(from)].support = 0;
    map.planes[map.index(into)].support = static_cast<std::int32_t>(map.members(into).size());
    extents_[map.index(into)].reset();
  }

  // The landmarks around that lie on no plane and may lie on one across the axis, by their place along it.
  void gather(const Map<S>& map, std::int8_t axis, const Vec3<S>& normal) {
    candidates_.clear();
    const S max_sigma = options.max_sigma * depth_;
    for (const LandmarkId id : local_.points) {
      const PointLandmark<S>& point = map.points[map.index(id)];
      if (point.alive && point.plane == kNone && sigma_along(map, point, normal) < max_sigma)
        candidates_.push_back({normal.dot(point.position), id, false});
    }
    for (const LandmarkId id : local_.lines) {
      const LineLandmark<S>& line = map.lines[map.index(id)];
      if (!line.alive || line.plane != kNone || line.axis == axis) continue;
      if (std::abs(line.line.direction.dot(normal)) > std::sin(options.max_tilt)) continue;
      if (sigma_along(map, line, normal) < max_sigma)
        candidates_.push_back({normal.dot(line.start + line.end) / 2, id, true});
    }
    std::sort(candidates_.begin(), candidates_.end(), [](const Candidate& a, const Candidate& b) {
      return a.offset != b.offset ? a.offset < b.offset : (a.line != b.line ? b.line : a.id < b.id);
    });
  }

  // Candidates on a plane that stands already become its members.
  void join(Map<S>& map, std::int8_t axis) {
    gather_near(map, axis);
    std::erase_if(candidates_, [&](const Candidate& c) {
      for (const LandmarkId id : near_) {
        const Vec3<S> x = place(map, c);
        if (std::abs(map.planes[map.index(id)].plane.offset(x)) > options.tolerance * depth_) continue;
        if (!extent(map, map.index(id)).covers(x, options.reach * depth_)) continue;
        enter(map, c, id);
        return true;
      }
      return false;
    });
  }

  // The planes across the axis that pass the box around the candidates, or nearly: few of a large map's.
  void gather_near(const Map<S>& map, std::int8_t axis) {
    near_.clear();
    if (candidates_.empty()) return;
    Vec3<S> low = place(map, candidates_.front()), high = low;
    for (const Candidate& c : candidates_) {
      low = low.cwiseMin(place(map, c));
      high = high.cwiseMax(place(map, c));
    }
    const Vec3<S> middle = (low + high) / 2, half = (high - low) / 2;
    for (std::size_t p = 0; p < map.planes.size(); ++p) {
      const PlaneLandmark<S>& plane = map.planes[p];
      const S reach = plane.plane.normal.cwiseAbs().dot(half) + 2 * options.tolerance * depth_;
      if (plane.alive && plane.axis == axis && std::abs(plane.plane.offset(middle)) <= reach)
        near_.push_back(static_cast<LandmarkId>(p));
    }
  }

  // The strongest plane among the candidates, which it takes with it; false when there is none.
  bool add_plane(Map<S>& map, std::int8_t axis, const Vec3<S>& normal) {
    offsets_.clear();
    for (const Candidate& c : candidates_) offsets_.push_back(c.offset);
    const OffsetMode<S> mode = offset_mode<S>(offsets_, 2 * options.tolerance * depth_);
    if (mode.size() < options.min_members || mode.contrast < options.min_contrast) return false;
    PlaneExtent<S> extent(normal);
    for (std::size_t i = mode.first; i < mode.last; ++i) extent.add(place(map, candidates_[i]));
    const auto first = candidates_.begin() + static_cast<std::ptrdiff_t>(mode.first);
    const auto last = candidates_.begin() + static_cast<std::ptrdiff_t>(mode.last);
    if (extent.least_spread() > options.min_spread * depth_) {
      const S middle = offsets_[(mode.first + mode.last) / 2];
      const LandmarkId id = map.add_plane({normal, middle}, axis);
      for (auto c = first; c != last; ++c) enter(map, *c, id);
    }
    candidates_.erase(first, last);
    return true;
  }

  [[nodiscard]] static Vec3<S> place(const Map<S>& map, const Candidate& c) {
    if (!c.line) return map.points[map.index(c.id)].position;
    return (map.lines[map.index(c.id)].start + map.lines[map.index(c.id)].end) / 2;
  }

  static void enter(Map<S>& map, const Candidate& c, LandmarkId plane) {
    if (c.line)
      map.lay_line(c.id, plane);
    else
      map.lay_point(c.id, plane);
    ++map.planes[map.index(plane)].support;
  }

  S depth_ = 1;
  LocalMap<S> local_;
  std::vector<std::optional<PlaneExtent<S>>> extents_;  // by plane, of those that were asked for
  std::vector<Candidate> candidates_;
  std::vector<LandmarkId> near_;  // planes
  std::vector<S> offsets_;
};

template <Scalar S>
void ManhattanPlanes<S>::find(Map<S>& map, KeyframeId id, S median_depth) {
  if (options.min_members == 0) return;
  depth_ = median_depth;
  settle(map);
  const Keyframe<S>& keyframe = map.keyframes[map.index(id)];
  if (!keyframe.manhattan || !(angle_between(keyframe.manhattan->cam_from_world,
                                             keyframe.cam_from_world.rotation) < options.max_turn))
    return;
  local_.gather_around(map, id, options.max_keyframes);
  const auto axes = static_cast<std::int8_t>(3 * map.world_from_manhattan.size());
  for (std::int8_t axis = 0; axis < axes; ++axis)
    if (stands_for_itself(map.world_from_manhattan, axis)) find_across(map, axis);
  points.create(map, id, median_depth);
}
static_assert(PlaneStep<ManhattanPlanes<float>, float> && PlaneStep<ManhattanPlanes<double>, double>);

}  // namespace sslam
