// SPDX-License-Identifier: BSD-3-Clause
// A map as a COLMAP model, as text and in binary form: cameras, images (the keyframes with their point
// features) and points3D. Lines have no place in such a model.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <ostream>
#include <span>
#include <string>
#include <vector>

#include "sslam/io/files/output_file.hpp"
#include "sslam/io/maps/byte_archive.hpp"
#include "sslam/io/maps/map_writer.hpp"
#include "sslam/map/map.hpp"

namespace sslam::io {

struct ColmapCounts {
  std::size_t cameras = 0, images = 0, points = 0, observations = 0;
};

struct ColmapImages {
  std::span<const std::string> names;  // of each keyframe's image, by the keyframe's id
  // Keyframes of the size `worked_on` are of images of the size `whole`, which were shrunk; 0: of none.
  std::array<int, 2> worked_on{}, whole{};
  std::span<const Colour> colours = {};  // of the points, by id; the others are grey
};

namespace colmap_detail {

// COLMAP counts ids from 1, and pixels from the corner of the first one instead of its centre.
inline constexpr std::int64_t kFirstId = 1;
inline constexpr double kPixelShift = 0.5;
inline constexpr std::int32_t kPinholeModel = 1;  // COLMAP's number of PINHOLE

struct ImageCamera {
  Pinhole<double> pinhole;
  int width = 0, height = 0;
  double scale_x = 1, scale_y = 1;  // the image's pixels in one of the features'

  friend bool operator==(const ImageCamera& a, const ImageCamera& b) noexcept {
    return a.pinhole.fx == b.pinhole.fx && a.pinhole.fy == b.pinhole.fy && a.pinhole.cx == b.pinhole.cx &&
           a.pinhole.cy == b.pinhole.cy && a.width == b.width && a.height == b.height;
  }
};

class Writer {
 public:
  Writer(const std::filesystem::path& folder, const Map<double>& map, const ColmapImages& images)
      : folder_(folder), map_(map), images_(images) {
    for (const auto& point : map.points) {
      counts_.points += in_model(point) ? 1U : 0U;
      counts_.observations += in_model(point) ? point.observations.size() : 0U;
    }
    for (const auto& keyframe : map.keyframes) {
      cameras_by_keyframe_.push_back(keyframe.alive() ? camera_of(keyframe) : 0);
      counts_.images += keyframe.alive() ? 1U : 0U;
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
    ImageCamera camera{keyframe.frame.pinhole, keyframe.frame.width, keyframe.frame.height};
    const bool shrunk =
        images_.whole[0] > 0 && camera.width == images_.worked_on[0] && camera.height == images_.worked_on[1];
    if (shrunk) {
      camera.scale_x = static_cast<double>(images_.whole[0]) / camera.width;
      camera.scale_y = static_cast<double>(images_.whole[1]) / camera.height;
      camera.width = images_.whole[0];
      camera.height = images_.whole[1];
    }
    Pinhole<double>& lens = camera.pinhole;  // from here on by COLMAP's pixels
    lens = {lens.fx * camera.scale_x, lens.fy * camera.scale_y, (lens.cx + kPixelShift) * camera.scale_x,
            (lens.cy + kPixelShift) * camera.scale_y};
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
          c.pinhole.fx, c.pinhole.fy, c.pinhole.cx, c.pinhole.cy);
    }
    file.commit();
    ByteWriter bytes;
    bytes(static_cast<std::uint64_t>(cameras_.size()));
    for (std::size_t i = 0; i < cameras_.size(); ++i) {
      const ImageCamera& c = cameras_[i];
      bytes(static_cast<std::uint32_t>(id(i)));
      bytes(kPinholeModel);
      for (const int side : {c.width, c.height}) bytes(static_cast<std::uint64_t>(side));
      for (const double value : {c.pinhole.fx, c.pinhole.fy, c.pinhole.cx, c.pinhole.cy}) bytes(value);
    }
    write_bytes("cameras.bin", bytes);
  }

  void write_images() {
    OutputFile file(folder_ / "images.txt");
    file.stream() << "# Image list with two lines of data per image:\n"
                  << "#   IMAGE_ID, QW, QX, QY, QZ, TX, TY, TZ, CAMERA_ID, NAME\n"
                  << "#   POINTS2D[] as (X, Y, POINT3D_ID)\n"
                  << "# Number of images: " << counts_.images
                  << ", mean observations per image: " << observations_per(counts_.images) << "\n";
    ByteWriter bytes;
    bytes(static_cast<std::uint64_t>(counts_.images));
    for (const auto& keyframe : map_.keyframes)
      if (keyframe.alive()) write_image(file.stream(), bytes, keyframe);
    file.commit();
    write_bytes("images.bin", bytes);
  }

  void write_image(std::ostream& out, ByteWriter& bytes, const Keyframe<double>& keyframe) {
    const auto index = Map<double>::index(keyframe.id);
    const auto q = keyframe.cam_from_world.rotation.quaternion();
    const Vec3<double>& t = keyframe.cam_from_world.translation;
    const std::size_t camera = cameras_by_keyframe_[index];
    put(out, "%lld %.12g %.12g %.12g %.12g %.12g %.12g %.12g %lld ", id(index), q.w(), q.x(), q.y(), q.z(),
        t.x(), t.y(), t.z(), id(camera));
    out << images_.names[index] << '\n';
    bytes(static_cast<std::uint32_t>(id(index)));
    for (const double value : {q.w(), q.x(), q.y(), q.z(), t.x(), t.y(), t.z()}) bytes(value);
    bytes(static_cast<std::uint32_t>(id(camera)));
    bytes.bytes += images_.names[index] + '\0';
    bytes(static_cast<std::uint64_t>(keyframe.frame.points.size()));
    const auto& points = keyframe.frame.points;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const LandmarkId landmark = keyframe.point_landmarks[i];
      const bool seen = landmark != kNone && in_model(map_.points[Map<double>::index(landmark)]);
      const double x = (points[i].pixel.x() + kPixelShift) * cameras_[camera].scale_x;
      const double y = (points[i].pixel.y() + kPixelShift) * cameras_[camera].scale_y;
      const std::int64_t point = seen ? id(Map<double>::index(landmark)) : -1;
      put(out, "%s%.4f %.4f %lld", i > 0 ? " " : "", x, y, static_cast<long long>(point));
      for (const double value : {x, y}) bytes(value);
      bytes(point);
    }
    out << '\n';
  }

  void write_points() {
    OutputFile file(folder_ / "points3D.txt");
    file.stream() << "# 3D point list with one line of data per point:\n"
                  << "#   POINT3D_ID, X, Y, Z, R, G, B, ERROR, TRACK[] as (IMAGE_ID, POINT2D_IDX)\n"
                  << "# Number of points: " << counts_.points
                  << ", mean track length: " << observations_per(counts_.points) << "\n";
    ByteWriter bytes;
    bytes(static_cast<std::uint64_t>(counts_.points));
    for (std::size_t i = 0; i < map_.points.size(); ++i)
      if (in_model(map_.points[i])) write_point(file.stream(), bytes, i);
    file.commit();
    write_bytes("points3D.bin", bytes);
  }

  void write_point(std::ostream& out, ByteWriter& bytes, std::size_t i) {
    const auto& point = map_.points[i];
    const Vec3<double>& x = point.position;
    const Colour colour = i < images_.colours.size() ? images_.colours[i] : kNoColour;
    const double error = mean_error(point);
    put(out, "%lld %.9g %.9g %.9g %d %d %d %.4f", id(i), x.x(), x.y(), x.z(), colour[0], colour[1], colour[2],
        error);
    bytes(static_cast<std::uint64_t>(id(i)));
    for (const double value : {x.x(), x.y(), x.z()}) bytes(value);
    for (const std::uint8_t channel : colour) bytes(channel);
    bytes(error);
    bytes(static_cast<std::uint64_t>(point.observations.size()));
    for (const Observation& o : point.observations) {
      const std::size_t image = Map<double>::index(o.keyframe);
      put(out, " %lld %d", id(image), o.feature);
      bytes(static_cast<std::uint32_t>(id(image)));
      bytes(static_cast<std::uint32_t>(o.feature));
    }
    out << '\n';
  }

  void write_bytes(const char* name, const ByteWriter& bytes) const {
    OutputFile file(folder_ / name);
    file.stream() << bytes.bytes;
    file.commit();
  }

  // Pixels of the images between the features and where they would show the point.
  [[nodiscard]] double mean_error(const PointLandmark<double>& point) const {
    double sum = 0;
    for (const Observation& o : point.observations) {
      const auto& keyframe = map_.keyframes[Map<double>::index(o.keyframe)];
      const Vec2<double> seen = keyframe.frame.pinhole.project(keyframe.cam_from_world * point.position);
      const ImageCamera& camera = cameras_[cameras_by_keyframe_[Map<double>::index(o.keyframe)]];
      const Vec2<double> away = keyframe.frame.points[Map<double>::index(o.feature)].pixel - seen;
      sum += Vec2<double>(away.x() * camera.scale_x, away.y() * camera.scale_y).norm();
    }
    return sum / static_cast<double>(point.observations.size());
  }

  static long long id(std::size_t index) noexcept { return static_cast<long long>(index) + kFirstId; }

  const std::filesystem::path& folder_;
  const Map<double>& map_;
  const ColmapImages& images_;
  std::vector<std::size_t> cameras_by_keyframe_;
  std::vector<ImageCamera> cameras_;
  ColmapCounts counts_;
  char text_[256] = {};
};

}  // namespace colmap_detail

// Features and poses are those of an ideal pinhole camera: the images that belong to the model are
// undistorted ones. Throws Error when a file cannot be written.
inline ColmapCounts write_colmap_model(const std::filesystem::path& folder, const Map<double>& map,
                                       const ColmapImages& images) {
  return colmap_detail::Writer(folder, map, images).write();
}

}  // namespace sslam::io
