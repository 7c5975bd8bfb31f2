// SPDX-License-Identifier: BSD-3-Clause
// The map: keyframes and landmarks by id, and what has to be kept in step when they change: observations,
// covisibility, members of planes, and what landmarks look like.
#pragma once

#include <utility>
#include <vector>

#include "sslam/core/move_to_end.hpp"
#include "sslam/map/covisibility.hpp"
#include "sslam/map/free_ids.hpp"
#include "sslam/map/id_shift.hpp"
#include "sslam/map/keyframe.hpp"
#include "sslam/map/landmark_index.hpp"
#include "sslam/map/manhattan_axes.hpp"
#include "sslam/map/observation_links.hpp"
#include "sslam/map/plane_members.hpp"
#include "sslam/map/removed_keyframe.hpp"

namespace sslam {

template <Scalar S>
class Map {
 public:
  using ScalarType = S;

  std::vector<Keyframe<S>> keyframes;
  std::vector<PointLandmark<S>> points;
  std::vector<LineLandmark<S>> lines;
  std::vector<PlaneLandmark<S>> planes;
  std::vector<SO3<S>> world_from_manhattan;  // how the Manhattan frames that are known stand in the world

  [[nodiscard]] bool empty() const noexcept { return keyframes.empty(); }

  // Direction in the world of a Manhattan axis.
  [[nodiscard]] Vec3<S> axis(std::int8_t number) const {
    return axis_direction(world_from_manhattan, number);
  }

  // Takes the keyframe over, gives it its id, and enters it in the landmarks that it already observes.
  KeyframeId add_keyframe(Keyframe<S> keyframe) {
    const auto id = static_cast<KeyframeId>(keyframes.size());
    keyframe.id = id;
    keyframe.neighbours.clear();  // those of another map, where some may be newer than it
    Keyframe<S>& kf = keyframes.emplace_back(std::move(keyframe));
    ObservationLinks::complete(id, kf.point_landmarks, points);
    ObservationLinks::complete(id, kf.line_landmarks, lines);
    for (std::size_t i = 0; i < kf.point_landmarks.size(); ++i)
      if (kf.point_landmarks[i] != kNone) renew_point(kf.point_landmarks[i], kf, i);
    for (std::size_t i = 0; i < kf.line_landmarks.size(); ++i)
      if (kf.line_landmarks[i] != kNone)
        line_index_.look_like(lines, kf.line_landmarks[i], kf.frame.lines[i].descriptor);
    update_covisibility(id);
    return id;
  }

  LandmarkId add_point(const Vec3<S>& position, KeyframeId creator) {
    return point_index_.settle(points, new_point_landmark(position, creator));
  }

  LandmarkId add_line(const Line3<S>& line, const Vec3<S>& start, const Vec3<S>& end, KeyframeId creator) {
    return line_index_.settle(lines, new_line_landmark(line, start, end, creator));
  }

  LandmarkId add_plane(const Plane3<S>& plane, std::int8_t axis) {
    return free_planes_.settle(planes, PlaneLandmark<S>{plane, axis, 0, true});
  }

  void observe_point(LandmarkId id, KeyframeId keyframe, std::size_t feature) {
    Keyframe<S>& kf = keyframes[index(keyframe)];
    ObservationLinks::add(id, points[index(id)], keyframe, feature, kf.point_landmarks);
    renew_point(id, kf, feature);
  }

  void observe_line(LandmarkId id, KeyframeId keyframe, std::size_t feature) {
    Keyframe<S>& kf = keyframes[index(keyframe)];
    LineLandmark<S>& line = lines[index(id)];
    ObservationLinks::add(id, line, keyframe, feature, kf.line_landmarks);
    line_index_.look_like(lines, id, kf.frame.lines[feature].descriptor);
    if (line.axis == kNone) line.axis = kf.line_axes.empty() ? std::int8_t{kNone} : kf.line_axes[feature];
  }

  // The id is given to a later landmark: whoever keeps ids beyond the next add_ must be ready for that.
  void erase_point(LandmarkId id) {
    lay_point(id, kNone);
    erase(points, point_index_, id, &Keyframe<S>::point_landmarks);
  }
  void erase_line(LandmarkId id) {
    lay_line(id, kNone);
    erase(lines, line_index_, id, &Keyframe<S>::line_landmarks);
  }

  // Its members lie on none afterwards.
  void erase_plane(LandmarkId id) {
    move_members(id, kNone);
    planes[index(id)].alive = false;
    free_planes_.add(id);
  }

  // The landmark lies on the plane from now on; kNone: on none.
  void lay_point(LandmarkId id, LandmarkId plane) { lay(points, &PlaneMembers::Lists::points, id, plane); }
  void lay_line(LandmarkId id, LandmarkId plane) { lay(lines, &PlaneMembers::Lists::lines, id, plane); }
  void move_members(LandmarkId from, LandmarkId into) {
    const PlaneMembers::Lists moved = members(from);
    for (const LandmarkId id : moved.points) lay_point(id, into);
    for (const LandmarkId id : moved.lines) lay_line(id, into);
  }
  [[nodiscard]] const PlaneMembers::Lists& members(LandmarkId plane) const {
    if (!members_.made()) members_.make(points, lines);
    return members_.of(plane);
  }

  // Becomes a later state of the same map, without copying the features that are here already.
  void renew_from(const Map& later) {
    keyframes.resize(later.keyframes.size());
    for (std::size_t k = 0; k < keyframes.size(); ++k) keyframes[k].renew_from(later.keyframes[k]);
    points = later.points;
    lines = later.lines;
    planes = later.planes;
    world_from_manhattan = later.world_from_manhattan;
    point_index_ = later.point_index_;
    line_index_ = later.line_index_;
    free_planes_ = later.free_planes_;
    members_.forget();
  }

  // Takes over all of another map; its ids follow those of this one.
  IdShift append(Map other) {
    const IdShift shift{static_cast<std::int32_t>(keyframes.size()), static_cast<std::int32_t>(points.size()),
                        static_cast<std::int32_t>(lines.size()), static_cast<std::int32_t>(planes.size())};
    for (Keyframe<S>& kf : other.keyframes) {
      IdShift::apply(kf.id, shift.keyframes);
      IdShift::apply(kf.parent, shift.keyframes);
      for (Neighbour& n : kf.neighbours) n.keyframe += shift.keyframes;
      ObservationLinks::shift(kf, shift);
    }
    for (auto& point : other.points) move_ids(point, shift);
    for (auto& line : other.lines) move_ids(line, shift);
    move_to_end(other.keyframes, keyframes);
    move_to_end(other.points, points);
    move_to_end(other.lines, lines);
    move_to_end(other.planes, planes);
    collect_free_ids();
    return shift;
  }

  // Finds the ids that can be given away in landmarks that were filled in from outside.
  void collect_free_ids() {
    point_index_.collect(points);
    line_index_.collect(lines);
    free_planes_.collect(planes);
    members_.forget();
  }

  // Withdraws one observation; a landmark left with fewer than two goes too.
  void forget_point(LandmarkId id, KeyframeId keyframe) {
    if (ObservationLinks::remove(points[index(id)], keyframe, keyframes, &Keyframe<S>::point_landmarks))
      erase_point(id);
  }
  void forget_line(LandmarkId id, KeyframeId keyframe) {
    if (ObservationLinks::remove(lines[index(id)], keyframe, keyframes, &Keyframe<S>::line_landmarks))
      erase_line(id);
  }

  // Hands the observations of `from` to `into`, where `into` has none in that keyframe, and erases `from`.
  void fuse_points(LandmarkId from, LandmarkId into) {
    fuse(points, from, into, &Map::observe_point, &Map::lay_point, &Map::erase_point);
  }
  void fuse_lines(LandmarkId from, LandmarkId into) {
    fuse(lines, from, into, &Map::observe_line, &Map::lay_line, &Map::erase_line);
  }

  // Withdraws all that the keyframe sees and frees its features; what hangs on its pose now hangs on
  // `parent`, which must be alive. Its id stays unused.
  void erase_keyframe(KeyframeId id, KeyframeId parent) {
    const auto forget_all = [&](std::vector<LandmarkId> seen, auto forget) {
      for (const LandmarkId landmark : seen)
        if (landmark != kNone) forget(landmark);
    };
    forget_all(keyframes[index(id)].point_landmarks, [&](LandmarkId p) { forget_point(p, id); });
    forget_all(keyframes[index(id)].line_landmarks, [&](LandmarkId l) { forget_line(l, id); });
    Keyframe<S>& kf = keyframes[index(id)];
    for (const Neighbour& n : kf.neighbours) set_neighbour(keyframes[index(n.keyframe)].neighbours, {id, 0});
    kf = remains_of(kf, keyframes[index(parent)]);
  }

  // The keyframe itself, or the parent that carries its place on.
  [[nodiscard]] KeyframeId surviving(KeyframeId id) const noexcept { return survivor(keyframes, id); }

  // cam_from_world of a keyframe, alive or carried on by its parents.
  [[nodiscard]] SE3<S> pose(KeyframeId id) const noexcept { return keyframe_pose(keyframes, id); }

  // Counts anew which keyframes share landmarks with this one, on both sides.
  void update_covisibility(KeyframeId id) { covisibility_.renew(id, points, lines, keyframes); }

  // Which landmarks may look like a descriptor.
  [[nodiscard]] const LookIndex& point_looks() const { return point_index_.looks(points); }
  [[nodiscard]] const LookIndex& line_looks() const { return line_index_.looks(lines); }

  [[nodiscard]] static constexpr std::size_t index(std::int32_t id) noexcept {
    return static_cast<std::size_t>(id);
  }

 private:
  template <class Landmarks>
  void lay(Landmarks& landmarks, std::vector<LandmarkId> PlaneMembers::Lists::*kind, LandmarkId id,
           LandmarkId plane) {
    members_.move(id, kind, landmarks[index(id)].plane, plane);
    landmarks[index(id)].plane = plane;
  }

  static void move_ids(LandmarkCommon& landmark, const IdShift& shift) {
    ObservationLinks::shift(landmark, shift);
    IdShift::apply(landmark.first_keyframe, shift.keyframes);
    IdShift::apply(landmark.plane, shift.planes);
  }

  void renew_point(LandmarkId id, const Keyframe<S>& kf, std::size_t feature) {
    const PointFeature<S>& seen = kf.frame.points[feature];
    points[index(id)].take_view(kf.cam_from_world.inverse().translation, seen.sigma);
    point_index_.look_like(points, id, seen.descriptor);
  }

  template <class Landmarks, class Member>
  void erase(Landmarks& landmarks, LandmarkIndex& known, LandmarkId id, Member seen) {
    if (!landmarks[index(id)].alive) return;
    ObservationLinks::remove_all(id, landmarks[index(id)], keyframes, seen);
    known.bury(landmarks, id);
  }

  template <class Landmarks>
  void fuse(Landmarks& landmarks, LandmarkId from, LandmarkId into,
            void (Map::*observe)(LandmarkId, KeyframeId, std::size_t),
            void (Map::*lay_on)(LandmarkId, LandmarkId), void (Map::*erase_one)(LandmarkId)) {
    const std::vector<Observation> moved = landmarks[index(from)].observations;
    for (const Observation& o : moved)
      if (!landmarks[index(into)].seen_by(o.keyframe)) (this->*observe)(into, o.keyframe, index(o.feature));
    landmarks[index(into)].visible += landmarks[index(from)].visible;
    landmarks[index(into)].found += landmarks[index(from)].found;
    if (landmarks[index(into)].plane == kNone) (this->*lay_on)(into, landmarks[index(from)].plane);
    (this->*erase_one)(from);
  }

  LandmarkIndex point_index_, line_index_;
  FreeIds free_planes_;
  mutable PlaneMembers members_;  // made when they are first asked
  Covisibility covisibility_;
};

}  // namespace sslam
