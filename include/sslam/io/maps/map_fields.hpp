// SPDX-License-Identifier: BSD-3-Clause
// What of a map goes into a file, in order: one list of fields that a writer and a reader both walk.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "sslam/io/maps/byte_archive.hpp"
#include "sslam/map/map.hpp"

namespace sslam::io {

// Walks the fields of a map with an archive, in an order that the file's version stands for.
template <class Archive>
class MapFields {
 public:
  explicit MapFields(Archive& archive) : archive_(archive) {}

  void walk(Map<double>& map) {
    fields(map.keyframes);
    fields(map.points);
    fields(map.lines);
    fields(map.planes);
    fields(map.world_from_manhattan);
  }

 private:
  template <int R, int C>
  void fields(Eigen::Matrix<double, R, C>& m) {
    for (double& value : m.reshaped()) archive_(value);
  }

  void fields(SO3<double>& rotation) {
    Vec4<double> q(rotation.quaternion().w(), rotation.quaternion().x(), rotation.quaternion().y(),
                   rotation.quaternion().z());
    fields(q);
    if constexpr (Archive::kReads) rotation = SO3<double>::from_quaternion(q[0], q[1], q[2], q[3]);
  }

  void fields(SE3<double>& pose) {
    fields(pose.rotation);
    fields(pose.translation);
  }

  template <class T>
  requires std::is_arithmetic_v<T>
  void fields(T& value) { archive_(value); }

  template <class T>
  void fields(std::optional<T>& value) {
    std::uint8_t there = value.has_value() ? 1 : 0;
    archive_(there);
    if constexpr (Archive::kReads) value = there != 0 ? std::optional<T>(T()) : std::nullopt;
    if (value) fields(*value);
  }

  template <class T>
  void fields(std::vector<T>& values) {
    std::uint64_t size = values.size();
    archive_(size);
    if constexpr (Archive::kReads) {
      if (size > archive_.left().size()) throw Error("ends too early");  // an entry takes a byte or more
      values.resize(static_cast<std::size_t>(size));
    }
    for (T& value : values) fields(value);
  }

  void fields(Descriptor& descriptor) {
    for (std::uint64_t& word : descriptor.words) archive_(word);
  }

  void fields(PointFeature<double>& f) {
    fields(f.pixel);
    archive_(f.sigma);
    archive_(f.angle);
    archive_(f.octave);
    fields(f.descriptor);
  }

  void fields(LineFeature<double>& f) {
    fields(f.segment.start);
    fields(f.segment.end);
    archive_(f.sigma);
    archive_(f.octave);
    fields(f.descriptor);
  }

  void fields(RotationObservation<double>& o) {
    fields(o.cam_from_world);
    fields(o.covariance);
  }

  void fields(Neighbour& n) {
    archive_(n.keyframe);
    archive_(n.shared);
  }

  void fields(Observation& o) {
    archive_(o.keyframe);
    archive_(o.feature);
  }

  void fields(Keyframe<double>& kf) {
    archive_(kf.id);
    archive_(kf.frame.index);
    archive_(kf.frame.stamp);
    for (double* value :
         {&kf.frame.pinhole.fx, &kf.frame.pinhole.fy, &kf.frame.pinhole.cx, &kf.frame.pinhole.cy})
      archive_(*value);
    archive_(kf.frame.width);
    archive_(kf.frame.height);
    fields(kf.frame.points);
    fields(kf.frame.lines);
    fields(kf.cam_from_world);
    fields(MapDoor::open(kf.point_landmarks));
    fields(MapDoor::open(kf.line_landmarks));
    fields(kf.line_axes);
    fields(kf.manhattan);
    fields(kf.neighbours);
    archive_(kf.parent);
    fields(kf.cam_from_parent);
  }

  void fields_in_common(LandmarkCommon& l) {
    fields(l.descriptor);
    fields(MapDoor::open(l.observations));
    archive_(l.first_keyframe);
    archive_(l.visible);
    archive_(l.found);
    archive_(l.plane);
    archive_(l.alive);
  }

  void fields(PointLandmark<double>& p) {
    fields_in_common(p);
    fields(p.position);
    fields(p.viewing_direction);
    archive_(p.extent);
  }

  void fields(LineLandmark<double>& l) {
    fields_in_common(l);
    fields(l.line.moment);
    fields(l.line.direction);
    fields(l.start);
    fields(l.end);
    archive_(l.axis);
  }

  void fields(PlaneLandmark<double>& p) {
    fields(p.plane.normal);
    archive_(p.plane.distance);
    archive_(p.axis);
    archive_(p.support);
    archive_(p.alive);
  }

  Archive& archive_;
};

}  // namespace sslam::io
