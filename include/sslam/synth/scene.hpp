// SPDX-License-Identifier: BSD-3-Clause
// A world of flat rectangles: where they lie, how they are painted, what lights them. Metres, z up.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "sslam/core/types.hpp"
#include "sslam/synth/texture.hpp"

namespace sslam::synth {

// Colours are display values (gamma encoded) in [0, 1], order red, green, blue. A texture of one channel
// moves the colour by swing * (value - 0.5); one of three channels replaces it. -1: no texture.
struct Paint {
  Vec3<float> colour = Vec3<float>::Constant(0.8f);
  Vec3<float> swing = Vec3<float>::Zero();
  int texture = -1;
  Vec2<float> offset = Vec2<float>::Zero();  // texture coordinates of the face's corner, metres
  bool glows = false;                        // its own light: shown as painted
};

// Light that falls on a face, as factors on display values, at columns x rows nodes spread corner to corner.
struct LightMap {
  int columns = 0, rows = 0;
  std::vector<float> nodes;
};

// A rectangle seen from one side only: the side that normal() points to, where along_s runs to the right and
// along_t upwards.
struct Face {
  Vec3<double> origin;            // the lower left corner
  Vec3<double> along_s, along_t;  // orthonormal
  double width, height;           // metres along s and t
  Paint paint;
  LightMap light = {};

  [[nodiscard]] Vec3<double> normal() const noexcept {
    return {along_s.y() * along_t.z() - along_s.z() * along_t.y(),
            along_s.z() * along_t.x() - along_s.x() * along_t.z(),
            along_s.x() * along_t.y() - along_s.y() * along_t.x()};
  }
  [[nodiscard]] Vec3<double> at(double s, double t) const noexcept {
    return origin + s * along_s + t * along_t;
  }
};

// A rectangle that shines to the side of `normal`.
struct Lamp {
  Vec3<double> centre, half_s, half_t, normal;
  double power;  // irradiance at 1 m in front of it, relative
};

// An open doorway as a cell sees it: a rectangle, and the cell behind it.
struct Doorway {
  std::array<Vec3<double>, 4> corners;
  std::int32_t into;
};

// A room or a corridor, upright walls along x and y. What stands in it is seen from outside through its
// doorways alone.
struct Cell {
  Vec2<double> low, high;  // between its walls
  double sill = 0.0;       // how far the doorways that belong to it reach beyond, metres
  std::vector<std::int32_t> faces = {};
  std::vector<Lamp> lamps = {};
  std::vector<Doorway> doorways = {};

  [[nodiscard]] bool holds(const Vec3<double>& p, double beyond) const noexcept {
    return p.x() >= low.x() - beyond && p.x() <= high.x() + beyond && p.y() >= low.y() - beyond &&
           p.y() <= high.y() + beyond;
  }
};

struct Scene {
  std::vector<Face> faces;
  std::vector<Texture> textures;
  std::vector<Lamp> lamps;
  std::vector<Cell> cells = {};  // of a large house; none: any face may be seen from anywhere
  // The light of a face that is not baked beforehand; from any thread.
  std::function<const LightMap&(std::size_t face)> late_light = {};

  int add(Texture texture) {
    textures.push_back(std::move(texture));
    return static_cast<int>(textures.size()) - 1;
  }
  [[nodiscard]] const LightMap& light(std::size_t face) const {
    return late_light ? late_light(face) : faces[face].light;
  }
};

// A right-handed frame standing on the floor: x along a wall or a piece of furniture, y away from the wall, z
// up.
struct Placement {
  Vec2<double> at = Vec2<double>::Zero();
  double yaw = 0.0;

  [[nodiscard]] Vec3<double> x_axis() const noexcept { return {std::cos(yaw), std::sin(yaw), 0.0}; }
  [[nodiscard]] Vec3<double> y_axis() const noexcept { return {-std::sin(yaw), std::cos(yaw), 0.0}; }
  [[nodiscard]] Vec3<double> point(double x, double y, double z) const noexcept {
    return Vec3<double>(at.x(), at.y(), z) + x * x_axis() + y * y_axis();
  }
};

// The sides of a box in its Placement, as bits.
struct Sides {
  static constexpr unsigned kFront = 1, kBack = 2, kLeft = 4, kRight = 8, kTop = 16, kBottom = 32;
  static constexpr unsigned kAll = 63;
};

// An upright box between two corners of the placement's frame; its front looks along +y.
inline void add_box(Scene& scene, const Placement& p, const Vec3<double>& low, const Vec3<double>& high,
                    const Paint& paint, unsigned sides = Sides::kAll) {
  const Vec3<double> x = p.x_axis(), y = p.y_axis(), z = Vec3<double>::UnitZ();
  const Vec3<double> size = high - low;
  const auto face = [&](unsigned side, const Vec3<double>& corner, const Vec3<double>& s,
                        const Vec3<double>& t, double width, double height) {
    if ((sides & side) != 0) {
      scene.faces.push_back({p.point(corner.x(), corner.y(), corner.z()), s, t, width, height, paint});
    }
  };
  face(Sides::kFront, {high.x(), high.y(), low.z()}, -x, z, size.x(), size.z());
  face(Sides::kBack, low, x, z, size.x(), size.z());
  face(Sides::kRight, {high.x(), low.y(), low.z()}, y, z, size.y(), size.z());
  face(Sides::kLeft, {low.x(), high.y(), low.z()}, -y, z, size.y(), size.z());
  face(Sides::kTop, {low.x(), low.y(), high.z()}, x, y, size.x(), size.y());
  face(Sides::kBottom, {low.x(), high.y(), low.z()}, x, -y, size.x(), size.y());
}

}  // namespace sslam::synth
