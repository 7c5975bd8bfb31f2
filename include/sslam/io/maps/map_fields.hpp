// SPDX-License-Identifier: BSD-3-Clause
// What of a map goes into a file, in order, and within which range: one list of fields that a writer and a
// reader both walk.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <type_traits>
#include <vector>

#include "sslam/io/maps/byte_archive.hpp"
#include "sslam/map/map.hpp"

namespace sslam::io {

// Walks the fields of a map with an archive, in an order that the file's version stands for. Each field is
// handed over with its range: there is no other way to the archive. Whether ids and lists agree with each
// other is left to check_map.
template <class Archive>
class MapFields {
 public:
  explicit MapFields(Archive& archive) : archive_(archive) {}

  void walk(Map<double>& map) {
    list("keyframes", map.keyframes);
    list("points", map.points);
    list("lines", map.lines);
    list("planes", map.planes);
    list("Manhattan frames", map.world_from_manhattan);
  }

  // A pose by itself.
  void walk(SE3<double>& pose) { fields(pose); }

 private:
  // Wider than anything that a camera sees, and so narrow that squares and products stay finite.
  static constexpr double kMetres = 1e15, kPixels = 1e9, kCovariance = 1e30;
  static constexpr std::int32_t kCount = 1'000'000'000;

  template <class T>
  void field(T& value, const FieldRange<T>& range) {
    archive_(value, range);
  }

  template <int R, int C>
  void field(Eigen::Matrix<double, R, C>& m, const char* name, double largest) {
    for (double& value : m.reshaped()) field(value, {name, -largest, largest});
  }

  void id(std::int32_t& value, const char* name) { field(value, {name, kNone, kCount}); }
  void count(std::int32_t& value, const char* name) { field(value, {name, 0, kCount}); }

  // As a byte: another value than 0 and 1 would be no bool.
  void truth(bool& value, const char* name) {
    std::uint8_t byte = value ? 1 : 0;
    field(byte, {name, 0, 1});
    if constexpr (Archive::kReads) value = byte != 0;
  }

  void fields(SO3<double>& rotation) {
    Vec4<double> q(rotation.quaternion().w(), rotation.quaternion().x(), rotation.quaternion().y(),
                   rotation.quaternion().z());
    field(q, "a rotation", 1 + 1e-6);
    if constexpr (Archive::kReads) {
      if (std::abs(q.norm() - 1) > 1e-6) throw Error("a rotation is not of unit length");
      rotation = SO3<double>::from_quaternion(q[0], q[1], q[2], q[3]);
    }
  }

  void fields(SE3<double>& pose) {
    fields(pose.rotation);
    field(pose.translation, "a translation", kMetres);
  }

  // An entry takes a byte or more; what is set aside at once is no more than the file has.
  template <class T, class Entry>
  void list(const char* name, std::vector<T>& values, Entry entry) {
    std::uint64_t size = values.size();
    if constexpr (Archive::kReads) {
      field(size, {name, 0, archive_.left().size()});
      values.clear();
      values.reserve(std::min<std::size_t>(size, archive_.left().size() / sizeof(T)));
      for (std::uint64_t i = 0; i < size; ++i) entry(values.emplace_back());
    } else {
      field(size, {name});
      for (T& value : values) entry(value);
    }
  }

  template <class T>
  void list(const char* name, std::vector<T>& values) {
    list(name, values, [this](T& value) { fields(value); });
  }

  void fields(Descriptor& descriptor) {
    for (std::uint64_t& word : descriptor.words) field(word, {"a descriptor"});
  }

  void fields(PointFeature<double>& f) {
    field(f.pixel, "a pixel", kPixels);
    sigma(f.sigma);
    field(f.angle, {"an angle", -1e3, 1e3});
    octave(f.octave);
    fields(f.descriptor);
  }

  void fields(LineFeature<double>& f) {
    field(f.segment.start, "a segment's start", kPixels);
    field(f.segment.end, "a segment's end", kPixels);
    sigma(f.sigma);
    octave(f.octave);
    fields(f.descriptor);
  }

  void sigma(double& value) { field(value, {"a feature's sigma", 1e-9, kPixels}); }
  void octave(std::uint8_t& value) { field(value, {"an octave", 0, 63}); }

  void fields(std::optional<RotationObservation<double>>& o) {
    bool there = o.has_value();
    truth(there, "whether there is a Manhattan rotation");
    if constexpr (Archive::kReads) o = there ? std::optional<RotationObservation<double>>({}) : std::nullopt;
    if (!there) return;
    fields(o->cam_from_world);
    field(o->covariance, "a covariance", kCovariance);
  }

  void fields(Neighbour& n) {
    id(n.keyframe, "a neighbour");
    count(n.shared, "the count of shared landmarks");
  }

  void fields(Observation& o) {
    id(o.keyframe, "an observation's keyframe");
    id(o.feature, "an observation's feature");
  }

  void fields(Frame<double>& frame) {
    field(frame.index, {"a frame's index", -1, std::int64_t{1'000'000'000'000'000}});
    field(frame.stamp, {"a stamp", -1e15, 1e15});
    Pinhole<double>& pinhole = frame.pinhole;
    for (double* focal : {&pinhole.fx, &pinhole.fy}) field(*focal, {"a focal length", 1e-9, kPixels});
    for (double* centre : {&pinhole.cx, &pinhole.cy})
      field(*centre, {"a principal point", -kPixels, kPixels});
    for (int* side : {&frame.width, &frame.height}) field(*side, {"an image's size", 0, 65535});
    list("point features", frame.points);
    list("line features", frame.lines);
  }

  void fields(Keyframe<double>& kf) {
    id(kf.id, "a keyframe's id");
    fields(kf.frame);
    fields(kf.cam_from_world);
    const auto landmark = [this](LandmarkId& value) { id(value, "a feature's landmark"); };
    list("landmarks of points", MapDoor::open(kf.point_landmarks), landmark);
    list("landmarks of lines", MapDoor::open(kf.line_landmarks), landmark);
    list("axes of lines", kf.line_axes, [this](std::int8_t& value) { axis(value); });
    fields(kf.manhattan);
    list("neighbours", kf.neighbours);
    id(kf.parent, "a parent");
    fields(kf.cam_from_parent);
  }

  void axis(std::int8_t& value) { field(value, {"an axis", kNone, std::int8_t{126}}); }

  void fields_in_common(LandmarkCommon& l) {
    fields(l.descriptor);
    list("observations", MapDoor::open(l.observations));
    id(l.first_keyframe, "a landmark's first keyframe");
    count(l.visible, "how often a landmark should have been seen");
    count(l.found, "how often a landmark was seen");
    id(l.plane, "a landmark's plane");
    truth(l.alive, "whether a landmark is alive");
  }

  void fields(PointLandmark<double>& p) {
    fields_in_common(p);
    field(p.position, "a point", kMetres);
    field(p.viewing_direction, "a viewing direction", 1 + 1e-6);
    field(p.extent, {"a point's extent", 0, kMetres});
  }

  void fields(LineLandmark<double>& l) {
    fields_in_common(l);
    field(l.line.moment, "a line's moment", kMetres);
    field(l.line.direction, "a line's direction", 1 + 1e-6);
    field(l.start, "a line's start", kMetres);
    field(l.end, "a line's end", kMetres);
    axis(l.axis);
  }

  void fields(PlaneLandmark<double>& p) {
    field(p.plane.normal, "a plane's normal", 1 + 1e-6);
    field(p.plane.distance, {"a plane's distance", -kMetres, kMetres});
    axis(p.axis);
    count(p.support, "a plane's support");
    truth(p.alive, "whether a plane is alive");
  }

  Archive& archive_;
};

}  // namespace sslam::io
