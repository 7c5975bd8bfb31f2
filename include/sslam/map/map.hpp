// SPDX-License-Identifier: BSD-3-Clause
// The map: keyframes and landmarks by id, and what has to be kept in step when they change: observations,
// covisibility, members of planes, and what landmarks look like.
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "sslam/core/move_to_end.hpp"
#include "sslam/map/covisibility.hpp"
#include "sslam/map/free_ids.hpp"
#include "sslam/map/id_shift.hpp"
#include "sslam/map/keyframe.hpp"
#include "sslam/map/look_index.hpp"
#include "sslam/map/manhattan_axes.hpp"
#include "sslam/map/observation_links.hpp"
#include "sslam/map/plane_members.hpp"

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
    keyframes.push_back(std::move(keyframe));
    Keyframe<S>& kf = keyframes.back();
    ObservationLinks::complete(id, kf.point_landmarks, points);
    ObservationLinks::complete(id, kf.line_landmarks, lines);
    for (std::size_t i = 0; i < kf.point_landmarks.size(); ++i)
      if (kf.point_landmarks[i] != kNone) renew_point(kf.point_landmarks[i], kf, i);
    for (std::size_t i = 0; i < kf.line_landmarks.size(); ++i)
      if (kf.line_landmarks[i] != kNone) look_like(kf.line_landmarks[i], kf.frame.lines[i].descriptor);
    update_covisibility(id);
    return id;
  }

  LandmarkId add_point(const Vec3<S>& position, KeyframeId creator) {
    PointLandmark<S> point;
    point.position = position;
    point.viewing_direction.setZero();
    point.first_keyframe = creator;
    point.visible = point.found = 1;
    return free_points_.settle(points, std::move(point));
  }

  LandmarkId add_line(const Line3<S>& line, const Vec3<S>& start, const Vec3<S>& end, KeyframeId creator) {
    LineLandmark<S> landmark;
    landmark.line = line;
    landmark.start = start;
    landmark.end = end;
    landmark.first_keyframe = creator;
    landmark.visible = landmark.found = 1;
    return free_lines_.settle(lines, std::move(landmark));
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
    look_like(id, kf.frame.lines[feature].descriptor);
    if (line.axis == kNone) line.axis = kf.line_axes.empty() ? std::int8_t{kNone} : kf.line_axes[feature];
  }

  // The id is given to a later landmark: whoever keeps ids beyond the next add_ must be ready for that.
  void erase_point(LandmarkId id) {
    lay_point(id, kNone);
    erase(points, free_points_, id, &Keyframe<S>::point_landmarks);
    point_looks_.remove(id);
  }
  void erase_line(LandmarkId id) {
    lay_line(id, kNone);
    erase(lines, free_lines_, id, &Keyframe<S>::line_landmarks);
    line_looks_.remove(id);
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
    forget_indices();
    free_points_ = later.free_points_;
    free_lines_ = later.free_lines_;
    free_planes_ = later.free_planes_;
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
    forget_indices();
    free_points_.collect(points);
    free_lines_.collect(lines);
    free_planes_.collect(planes);
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
    hand_over(points, from, into,
              [&](const Observation& o) { observe_point(into, o.keyframe, index(o.feature)); });
    if (points[index(into)].plane == kNone) lay_point(into, points[index(from)].plane);
    erase_point(from);
  }
  void fuse_lines(LandmarkId from, LandmarkId into) {
    hand_over(lines, from, into,
              [&](const Observation& o) { observe_line(into, o.keyframe, index(o.feature)); });
    if (lines[index(into)].plane == kNone) lay_line(into, lines[index(from)].plane);
    erase_line(from);
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
    Keyframe<S> rest;
    rest.id = id;
    rest.parent = parent;
    rest.cam_from_parent = kf.cam_from_world * keyframes[index(parent)].cam_from_world.inverse();
    kf = std::move(rest);
  }

  // The keyframe itself, or the parent that carries its place on.
  [[nodiscard]] KeyframeId surviving(KeyframeId id) const noexcept {
    while (!keyframes[index(id)].alive()) id = keyframes[index(id)].parent;
    return id;
  }

  // cam_from_world of a keyframe, alive or carried on by its parents.
  [[nodiscard]] SE3<S> pose(KeyframeId id) const noexcept {
    SE3<S> cam_from_survivor;
    for (; !keyframes[index(id)].alive(); id = keyframes[index(id)].parent)
      cam_from_survivor = cam_from_survivor * keyframes[index(id)].cam_from_parent;
    return cam_from_survivor * keyframes[index(id)].cam_from_world;
  }

  // Counts anew which keyframes share landmarks with this one, on both sides.
  void update_covisibility(KeyframeId id) { covisibility_.renew(id, points, lines, keyframes); }

  // Which landmarks may look like a descriptor.
  [[nodiscard]] const LookIndex& point_looks() const { return made(point_looks_, points); }
  [[nodiscard]] const LookIndex& line_looks() const { return made(line_looks_, lines); }

  [[nodiscard]] static constexpr std::size_t index(std::int32_t id) noexcept {
    return static_cast<std::size_t>(id);
  }

 private:
  void forget_indices() {
    point_looks_.forget();
    line_looks_.forget();
    members_.forget();
  }

  template <class Landmarks>
  [[nodiscard]] static const LookIndex& made(LookIndex& looks, const Landmarks& landmarks) {
    if (!looks.made()) looks.make(landmarks);
    return looks;
  }

  template <class Landmarks>
  void lay(Landmarks& landmarks, std::vector<LandmarkId> PlaneMembers::Lists::*kind, LandmarkId id,
           LandmarkId plane) {
    members_.move(id, kind, landmarks[index(id)].plane, plane);
    landmarks[index(id)].plane = plane;
  }

  void look_like(LandmarkId line, const Descriptor& descriptor) {
    lines[index(line)].descriptor = descriptor;
    line_looks_.set(line, descriptor);
  }

  static void move_ids(LandmarkCommon& landmark, const IdShift& shift) {
    ObservationLinks::shift(landmark, shift);
    IdShift::apply(landmark.first_keyframe, shift.keyframes);
    IdShift::apply(landmark.plane, shift.planes);
  }

  void renew_point(LandmarkId id, const Keyframe<S>& kf, std::size_t feature) {
    PointLandmark<S>& point = points[index(id)];
    const Vec3<S> to_camera = kf.cam_from_world.inverse().translation - point.position;
    const S distance = to_camera.norm();
    point.descriptor = kf.frame.points[feature].descriptor;
    point_looks_.set(id, point.descriptor);
    point.extent = kf.frame.points[feature].sigma * distance;
    const auto n = static_cast<S>(point.observations.size());
    const Vec3<S> mean = point.viewing_direction * (n - 1) + to_camera / std::max(distance, S(1e-9));
    point.viewing_direction = mean.normalized();
  }

  template <class Landmarks, class Member>
  void erase(Landmarks& landmarks, FreeIds& free, LandmarkId id, Member seen) {
    auto& landmark = landmarks[index(id)];
    if (!landmark.alive) return;
    ObservationLinks::remove_all(id, landmark, keyframes, seen);
    landmark.alive = false;
    free.add(id);
  }

  template <class Landmarks, class Observe>
  void hand_over(Landmarks& landmarks, LandmarkId from, LandmarkId into, Observe observe) {
    const std::vector<Observation> moved = landmarks[index(from)].observations;
    for (const Observation& o : moved) {
      const auto& has = landmarks[index(into)].observations;
      if (std::none_of(has.begin(), has.end(),
                       [&](const Observation& p) { return p.keyframe == o.keyframe; }))
        observe(o);
    }
    landmarks[index(into)].visible += landmarks[index(from)].visible;
    landmarks[index(into)].found += landmarks[index(from)].found;
  }

  FreeIds free_points_, free_lines_, free_planes_;
  // Made when they are first asked.
  mutable LookIndex point_looks_, line_looks_;
  mutable PlaneMembers members_;
  Covisibility covisibility_;
};

}  // namespace sslam
