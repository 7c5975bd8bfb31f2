// SPDX-License-Identifier: BSD-3-Clause
// A map as a COLMAP model in text form: cameras.txt, images.txt (the keyframes with their point features) and
// points3D.txt. Lines have no place in such a model.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <ostream>
#include <span>
#include <string>
#include <vector>

#include "sslam/io/files/output_file.hpp"
#include "sslam/map/map.hpp"

namespace sslam::io {

struct ColmapCounts {
  std::size_t cameras = 0, images = 0, points = 0, observations = 0;
};

namespace colmap_detail {

// COLMAP counts ids from 1, and pixels from the corner of the first one instead of its centre.
inline constexpr std::int64_t kFirstId = 1;
inline constexpr double kPixelShift = 0.5;

struct ImageCamera {
  Pinhole<double> pinhole;
  int width = 0, height = 0;

  friend bool operator==(const ImageCamera& a, const ImageCamera& b) noexcept {
    return a.pinhole.fx == b.pinhole.fx && a.pinhole.fy == b.pinhole.fy && a.pinhole.cx == b.pinhole.cx &&
           a.pinhole.cy == b.pinhole.cy && a.width == b.width && a.height == b.height;
  }
};

class Writer {
 public:
  Writer(const std::filesystem::path& folder, const Map<double>& map, std::span<const std::string> names)
      : folder_(folder), map_(map), names_(names) {
    for (const auto& point : map.points) {
      counts_.points += in_model(point) ? 1U : 0U;
      counts_.observations += in_model(point) ? point.observations.size() : 0U;
    }
    for (const auto& keyframe : map.keyframes) {
      if (!keyframe.alive()) continue;
      ++counts_.images;
      (void)camera_of(keyframe);
    }
    counts_.cameras = cameras_.size();
  }

  [[nodiscard]] ColmapCounts write() {
    write_cameras();
    write_images();
    write_points();
    return counts_;
  }

 private:
  // COLMAP wants two views of a point.
  static bool in_model(const PointLandmark<double>& point) noexcept {
    return point.alive && point.observations.size() >= 2;
  }

  std::size_t camera_of(const Keyframe<double>& keyframe) {
    const ImageCamera camera{keyframe.frame.pinhole, keyframe.frame.width, keyframe.frame.height};
    std::size_t at = 0;
    while (at < cameras_.size() && !(cameras_[at] == camera)) ++at;
    if (at == cameras_.size()) cameras_.push_back(camera);
    return at;
  }

  template <class... Values>
  void put(std::ostream& out, const char* form, Values... values) {
    std::snprintf(text_, sizeof text_, form, values...);
    out << text_;
  }

  [[nodiscard]] double observations_per(std::size_t count) const noexcept {
    return count > 0 ? static_cast<double>(counts_.observations) / static_cast<double>(count) : 0;
  }

  void write_cameras() {
    OutputFile file(folder_ / "cameras.txt");
    file.stream() << "# Camera list with one line of data per camera:\n"
                  << "#   CAMERA_ID, MODEL, WIDTH, HEIGHT, PARAMS[]\n"
                  << "# Number of cameras: " << cameras_.size() << "\n";
    for (std::size_t i = 0; i < cameras_.size(); ++i) {
      const ImageCamera& c = cameras_[i];
      put(file.stream(), "%lld PINHOLE %d %d %.12g %.12g %.12g %.12g\n", id(i), c.width, c.height,
          c.pinhole.fx, c.pinhole.fy, c.pinhole.cx + kPixelShift, c.pinhole.cy + kPixelShift);
    }
    file.commit();
  }

  void write_images() {
    OutputFile file(folder_ / "images.txt");
    file.stream() << "# Image list with two lines of data per image:\n"
                  << "#   IMAGE_ID, QW, QX, QY, QZ, TX, TY, TZ, CAMERA_ID, NAME\n"
                  << "#   POINTS2D[] as (X, Y, POINT3D_ID)\n"
                  << "# Number of images: " << counts_.images
                  << ", mean observations per image: " << observations_per(counts_.images) << "\n";
    for (const auto& keyframe : map_.keyframes)
      if (keyframe.alive()) write_image(file.stream(), keyframe);
    file.commit();
  }

  void write_image(std::ostream& out, const Keyframe<double>& keyframe) {
    const auto index = Map<double>::index(keyframe.id);
    const auto q = keyframe.cam_from_world.rotation.quaternion();
    const Vec3<double>& t = keyframe.cam_from_world.translation;
    put(out, "%lld %.12g %.12g %.12g %.12g %.12g %.12g %.12g %lld ", id(index), q.w(), q.x(), q.y(), q.z(),
        t.x(), t.y(), t.z(), id(camera_of(keyframe)));
    out << names_[index] << '\n';
    const auto& points = keyframe.frame.points;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const LandmarkId landmark = keyframe.point_landmarks[i];
      const bool seen = landmark != kNone && in_model(map_.points[Map<double>::index(landmark)]);
      put(out, "%s%.4f %.4f %lld", i > 0 ? " " : "", points[i].pixel.x() + kPixelShift,
          points[i].pixel.y() + kPixelShift, seen ? id(Map<double>::index(landmark)) : -1);
    }
    out << '\n';
  }

  void write_points() {
    OutputFile file(folder_ / "points3D.txt");
    file.stream() << "# 3D point list with one line of data per point:\n"
                  << "#   POINT3D_ID, X, Y, Z, R, G, B, ERROR, TRACK[] as (IMAGE_ID, POINT2D_IDX)\n"
                  << "# Number of points: " << counts_.points
                  << ", mean track length: " << observations_per(counts_.points) << "\n";
    for (std::size_t i = 0; i < map_.points.size(); ++i) {
      const auto& point = map_.points[i];
      if (!in_model(point)) continue;
      const Vec3<double>& x = point.position;
      put(file.stream(), "%lld %.9g %.9g %.9g 128 128 128 %.4f", id(i), x.x(), x.y(), x.z(),
          mean_error(point));
      for (const Observation& o : point.observations)
        put(file.stream(), " %lld %d", id(Map<double>::index(o.keyframe)), o.feature);
      file.stream() << '\n';
    }
    file.commit();
  }

  // Pixels between the features and the point's images.
  [[nodiscard]] double mean_error(const PointLandmark<double>& point) const {
    double sum = 0;
    for (const Observation& o : point.observations) {
      const auto& keyframe = map_.keyframes[Map<double>::index(o.keyframe)];
      const Vec2<double> seen = keyframe.frame.pinhole.project(keyframe.cam_from_world * point.position);
      sum += (keyframe.frame.points[Map<double>::index(o.feature)].pixel - seen).norm();
    }
    return sum / static_cast<double>(point.observations.size());
  }

  static long long id(std::size_t index) noexcept { return static_cast<long long>(index) + kFirstId; }

  const std::filesystem::path& folder_;
  const Map<double>& map_;
  std::span<const std::string> names_;
  std::vector<ImageCamera> cameras_;
  ColmapCounts counts_;
  char text_[256] = {};
};

}  // namespace colmap_detail

// image_names: of each keyframe's image, by id. Features and poses are those of an ideal pinhole camera: the
// images that belong to the model are undistorted ones. Throws Error when a file cannot be written.
inline ColmapCounts write_colmap_model(const std::filesystem::path& folder, const Map<double>& map,
                                       std::span<const std::string> image_names) {
  return colmap_detail::Writer(folder, map, image_names).write();
}

}  // namespace sslam::io
