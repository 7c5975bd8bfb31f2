// SPDX-License-Identifier: BSD-3-Clause
// A room with an open door, filmed from its middle: a map with points on its walls, as tracking leaves one,
// and the keyframes' images.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "sslam/core/random.hpp"
#include "sslam/dense/dense_model.hpp"
#include "sslam/dense/map_views.hpp"
#include "sslam/synth/render.hpp"
#include "support/random_draws.hpp"
#include "synth/flat_scene.hpp"

namespace sslam::testing {

struct FilmedRoomOptions {
  bool clutter = false;         // points anywhere in the room's air, and images of noise
  double points_per_metre = 8;  // square metre
  double place_noise = 0.006;   // of each coordinate of a landmark, metres, uniform to either side
};

class FilmedRoom {
 public:
  static constexpr double kHalfWidth = 2.4, kNear = 1.9, kFar = 3.6, kHeight = 2.5;  // metres
  static constexpr double kHalfDoor = 0.5, kDoorHeight = 2.0;

  synth::Scene scene;  // z up; the door is in the wall y = kNear, and behind it there is a wall at kFar
  Map<double> map;
  std::vector<std::vector<std::uint8_t>> greys;
  std::vector<dense::DenseView> views;
  std::vector<synth::RenderedFrame> frames;

  explicit FilmedRoom(const FilmedRoomOptions& options = {}) : options_(options) {
    build();
    film();
    make_map();
  }

  [[nodiscard]] double depth() const { return dense::median_depth(map); }

  [[nodiscard]] dense::DenseModel model(const dense::DenseOptions& wanted = {}) const {
    return dense::DenseBuilder(wanted).build(map, depth(), views);
  }

 private:
  static constexpr int kViews = 24, kColumns = 320, kRows = 240;

  void add(const Vec3<double>& origin, const Vec3<double>& s, const Vec3<double>& t, double width,
           double height, std::uint64_t seed) {
    const auto blotches = [seed](float a, float b, float* out) {
      constexpr float kSide = 0.08F;  // metres
      const auto column = static_cast<std::uint64_t>(a / kSide), row = static_cast<std::uint64_t>(b / kSide);
      out[0] = Random(seed * 1000003 + column * 1009 + row).uniform(0.0F, 1.0F);
    };
    synth::Face face{origin, s, t, width, height, {Vec3<float>::Constant(0.55F)}, synth::even_light()};
    face.paint.texture = scene.add(
        synth::Texture::bake(static_cast<float>(width), static_cast<float>(height), 0.01F, 1, blotches));
    face.paint.swing = Vec3<float>::Constant(0.5F);
    scene.faces.push_back(face);
  }

  void build() {
    const Vec3<double> x = Vec3<double>::UnitX(), y = Vec3<double>::UnitY(), z = Vec3<double>::UnitZ();
    const double wide = 2 * kHalfWidth, left = kHalfWidth - kHalfDoor;
    add({-kHalfWidth, -kNear, 0}, x, y, wide, kNear + kFar, 1);       // floor
    add({-kHalfWidth, kFar, kHeight}, x, -y, wide, kNear + kFar, 2);  // ceiling
    add({kHalfWidth, -kNear, 0}, -x, z, wide, kHeight, 3);            // behind the camera
    add({-kHalfWidth, -kNear, 0}, y, z, kNear + kFar, kHeight, 4);    // left
    add({kHalfWidth, kFar, 0}, -y, z, kNear + kFar, kHeight, 5);      // right
    add({-kHalfWidth, kFar, 0}, x, z, wide, kHeight, 6);              // beyond the door
    add({-kHalfWidth, kNear, 0}, x, z, left, kHeight, 7);             // left of the door
    add({kHalfDoor, kNear, 0}, x, z, left, kHeight, 8);               // right of it
    add({-kHalfDoor, kNear, kDoorHeight}, x, z, 2 * kHalfDoor, kHeight - kDoorHeight, 9);  // above it
  }

  [[nodiscard]] static SE3<double> world_from_cam(int view) {
    const double yaw = 2 * std::numbers::pi * view / kViews, pitch = radians(view % 2 == 0 ? 14.0 : -14.0);
    const Vec3<double> forward(std::cos(yaw) * std::cos(pitch), std::sin(yaw) * std::cos(pitch),
                               std::sin(pitch));
    const Vec3<double> right(std::sin(yaw), -std::cos(yaw), 0);
    Mat3<double> axes;
    axes << right, forward.cross(right), forward;
    return {SO3<double>::from_matrix(axes), Vec3<double>(std::sin(yaw), -std::cos(yaw), 1.3)};
  }

  void film() {
    synth::Renderer renderer(scene);
    for (int v = 0; v < kViews; ++v) {
      frames.emplace_back();
      renderer.render({pinhole_, kColumns, kRows, world_from_cam(v).inverse()}, frames.back());
      std::vector<std::uint8_t> grey;
      for (std::size_t i = 0; i < frames.back().rgb.size(); i += 3)
        grey.push_back(static_cast<std::uint8_t>(std::clamp(255 * frames.back().rgb[i], 0.0F, 255.0F)));
      Random noise(static_cast<std::uint64_t>(v) + 100);
      if (options_.clutter)
        for (std::uint8_t& value : grey) value = static_cast<std::uint8_t>(noise.below(256));
      greys.push_back(std::move(grey));
    }
  }

  [[nodiscard]] std::vector<Vec3<double>> places(Random& random) const {
    std::vector<Vec3<double>> places;
    for (const synth::Face& face : scene.faces) {
      const int count = static_cast<int>(options_.points_per_metre * face.width * face.height);
      for (int i = 0; i < count; ++i) {
        const Vec3<double> share = uniform_vector<double, 3>(random, 0, 1);
        if (options_.clutter)
          places.emplace_back((2 * share.x() - 1) * kHalfWidth, (2 * share.y() - 1) * kNear,
                              share.z() * kHeight);
        else
          places.push_back(face.at(share.x() * face.width, share.y() * face.height));
      }
    }
    return places;
  }

  // The feature that shows the place in a view, if it is not hidden.
  [[nodiscard]] bool sees(int view, const Vec3<double>& place, Vec2<double>& pixel) const {
    const Vec3<double> in_cam = world_from_cam(view).inverse() * place;
    if (!(in_cam.z() > 0.1)) return false;
    pixel = pinhole_.project(in_cam);
    if (pixel.minCoeff() < 2 || pixel.x() > kColumns - 3 || pixel.y() > kRows - 3) return false;
    const auto i = static_cast<std::size_t>(std::lround(pixel.y()) * kColumns + std::lround(pixel.x()));
    return options_.clutter || frames[static_cast<std::size_t>(view)].inverse_depth[i] * in_cam.z() < 1.02;
  }

  void make_map() {
    Random random(5);
    const std::vector<Vec3<double>> true_places = places(random);
    map.world_from_manhattan.emplace_back();
    for (const Vec3<double>& place : true_places) {
      const double e = options_.place_noise;
      map.add_point(place + uniform_vector<double, 3>(random, -e, e), 0);
    }
    std::vector<KeyframeId> ids;
    for (int v = 0; v < kViews; ++v) {
      Keyframe<double> keyframe;
      keyframe.frame.index = v;
      keyframe.frame.stamp = v;
      keyframe.frame.pinhole = pinhole_;
      keyframe.frame.width = kColumns;
      keyframe.frame.height = kRows;
      keyframe.cam_from_world = world_from_cam(v).inverse();
      std::vector<LandmarkId> seen;
      for (std::size_t i = 0; i < true_places.size(); ++i) {
        PointFeature<double> feature;
        feature.sigma = 0.3;
        if (!sees(v, true_places[i], feature.pixel)) continue;
        keyframe.frame.points.push_back(feature);
        seen.push_back(static_cast<LandmarkId>(i));
      }
      ids.push_back(map.add_keyframe(std::move(keyframe).seeing(std::move(seen), {})));
    }
    for (std::size_t v = 0; v < ids.size(); ++v) {
      views.push_back(dense::view_of_keyframe(map, map.keyframes[v], 1));
      views.back().grey = {greys[v].data(), {kColumns, kRows}};
    }
    dense::connect_views(map, ids, depth(), dense::CostOptions().views, views);
  }

  FilmedRoomOptions options_;
  Pinhole<double> pinhole_{230, 230, 159.5, 119.5};
};

[[nodiscard]] inline double distance_from(const synth::Scene& scene, const Vec3<double>& p) {
  double nearest = 1e9;
  for (const synth::Face& face : scene.faces) {
    const Vec3<double> d = p - face.origin;
    const double s = std::clamp(face.along_s.dot(d), 0.0, face.width),
                 t = std::clamp(face.along_t.dot(d), 0.0, face.height);
    nearest = std::min(nearest, (p - face.at(s, t)).norm());
  }
  return nearest;
}

// Distances of the model's cells from the room, the least first; metres.
[[nodiscard]] inline std::vector<double> distances(const FilmedRoom& room, const dense::DenseModel& model) {
  std::vector<double> distances;
  for (const dense::DensePlane& plane : model.planes)
    for (int r = 0; r < plane.cells.rows; ++r)
      for (int c = 0; c < plane.cells.columns; ++c)
        if (plane.cells.is_solid(c, r))
          distances.push_back(distance_from(room.scene, plane.cells.centre(c, r)));
  std::sort(distances.begin(), distances.end());
  return distances;
}

[[nodiscard]] inline bool covers(const dense::DenseModel& model, const Vec3<double>& place,
                                 double tolerance) {
  return std::any_of(model.planes.begin(), model.planes.end(), [&](const dense::DensePlane& plane) {
    return std::abs(plane.fit.plane.offset(place)) < tolerance &&
           plane.cells.is_solid_at(plane.cells.basis.transpose() * place);
  });
}

// Share of what the views see that is within `tolerance` of the model.
[[nodiscard]] inline double completeness(const FilmedRoom& room, const dense::DenseModel& model,
                                         double tolerance) {
  std::size_t seen = 0, covered = 0;
  for (std::size_t v = 0; v < room.views.size(); ++v) {
    const SE3<double> world_from_cam = room.views[v].cam_from_world.inverse();
    const synth::RenderedFrame& frame = room.frames[v];
    for (int y = 3; y < frame.height; y += 6)
      for (int x = 3; x < frame.width; x += 6) {
        const double inverse = frame.inverse_depth[static_cast<std::size_t>(y * frame.width + x)];
        if (!(inverse > 0)) continue;
        const Vec3<double> ray = room.views[v].pinhole.unproject(Vec2<double>(x, y));
        ++seen;
        covered += covers(model, world_from_cam * Vec3<double>(ray / inverse), tolerance) ? 1U : 0U;
      }
  }
  return static_cast<double>(covered) / static_cast<double>(seen);
}

}  // namespace sslam::testing
