// SPDX-License-Identifier: BSD-3-Clause
// The light that reaches each face of a scene: soft direct light from rectangular lamps with shadows, and an
// ambient term that fades near other surfaces (ambient obscurance; Zhukov, Iones, Kronin, EGWR 1998).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "sslam/synth/scene.hpp"

namespace sslam::synth {

struct LightingOptions {
  double ambient = 0.55;       // irradiance of the ambient term far from any edge, relative to the lamps
  double reach = 0.45;         // metres over which a nearby surface darkens the ambient light
  double spacing = 0.07;       // metres between the nodes of the light maps
  double mean_display = 0.74;  // what white paint shows on average
};

class LightBaker {
 public:
  // The scene's faces and lamps must stay in place while the baker lives; their light maps may change.
  LightBaker(const Scene& scene, const LightingOptions& options) : scene_(scene), options_(options) {
    for (int i = 0; i < kRays; ++i) {  // cosine-weighted directions on a Fibonacci spiral
      const double r2 = (i + 0.5) / kRays, angle = i * std::numbers::pi * (3.0 - std::sqrt(5.0));
      directions_[i] = {std::sqrt(r2) * std::cos(angle), std::sqrt(r2) * std::sin(angle),
                        std::sqrt(1.0 - r2)};
    }
  }

  // Irradiance over one face, relative.
  [[nodiscard]] LightMap bake(const Face& face) const {
    LightMap map;
    map.columns = std::max(2, static_cast<int>(std::ceil(face.width / options_.spacing)) + 1);
    map.rows = std::max(2, static_cast<int>(std::ceil(face.height / options_.spacing)) + 1);
    map.nodes.resize(static_cast<std::size_t>(map.columns) * map.rows);
    for (int row = 0; row < map.rows; row += kTile) {
      for (int column = 0; column < map.columns; column += kTile) bake_tile(face, column, row, map);
    }
    return map;
  }

 private:
  struct Blocker {
    Vec3<double> origin, s, t, normal;  // s and t divided by the squared size: inside means [0, 1]
    double offset;
  };
  struct Ball {
    Vec3<double> centre;
    double radius;
  };
  using Blockers = std::vector<Blocker>;
  static constexpr int kRays = 40, kLampRays = 3, kTile = 8;
  static constexpr double kSlack = 0.002;  // nodes stand off their face by less than this, in metres
  static constexpr double kThin =
      0.06;  // blockers that stand out less than this are finer than the light map

  // Node i of n over [0, size], the outer ones 2 mm inside so that they do not lie in a neighbouring face.
  static double inset(double size, int i, int n) {
    return std::clamp(size * i / (n - 1), 0.002, std::max(size - 0.002, 0.002));
  }

  // Neighbouring nodes see about the same blockers: these are collected once for a tile of nodes.
  void bake_tile(const Face& face, int column, int row, LightMap& map) const {
    const int columns = std::min(kTile, map.columns - column), rows = std::min(kTile, map.rows - row);
    const auto node = [&](int c, int r) {
      return face.at(inset(face.width, column + c, map.columns), inset(face.height, row + r, map.rows));
    };
    const Vec3<double> low = node(0, 0), high = node(columns - 1, rows - 1);
    const Ball tile{0.5 * (low + high), 0.5 * (high - low).norm()};
    const Blockers near = blockers_near(face, tile);
    std::vector<Blockers> before_lamp;
    for (const Lamp& lamp : scene_.lamps) before_lamp.push_back(blockers_between(face, tile, lamp));
    for (int r = 0; r < rows; ++r) {
      for (int c = 0; c < columns; ++c) {
        const Vec3<double> from = node(c, r) + 1e-3 * face.normal();
        double sum = options_.ambient * openness(near, from, face);
        for (std::size_t i = 0; i < before_lamp.size(); ++i) {
          sum += from_lamp(scene_.lamps[i], before_lamp[i], from, face.normal());
        }
        map.nodes[static_cast<std::size_t>(row + r) * map.columns + column + c] = static_cast<float>(sum);
      }
    }
  }

  static Ball ball(const Face& face) {
    return {face.at(0.5 * face.width, 0.5 * face.height), 0.5 * std::hypot(face.width, face.height)};
  }

  static bool may_block(const Face& face, const Face& other) {
    if (other.paint.glows) return false;
    double highest = -1.0;
    for (const double s : {0.0, other.width}) {
      for (const double t : {0.0, other.height}) {
        highest = std::max(highest, face.normal().dot(other.at(s, t) - face.origin));
      }
    }
    return highest > kThin;
  }

  static Blocker blocker(const Face& face) {
    const Vec3<double> normal = face.normal();
    return {face.origin, face.along_s / face.width, face.along_t / face.height, normal,
            normal.dot(face.origin)};
  }

  // Whether the tile lies behind the face's plane, where it is not seen.
  static bool behind(const Face& other, const Ball& tile) {
    return other.normal().dot(tile.centre - other.origin) < -(tile.radius + kSlack);
  }

  static double gap(const Face& other, const Vec3<double>& from) {
    const Vec3<double> off = from - other.origin;
    const double s = std::clamp(other.along_s.dot(off), 0.0, other.width);
    const double t = std::clamp(other.along_t.dot(off), 0.0, other.height);
    return (other.at(s, t) - from).norm();
  }

  [[nodiscard]] Blockers blockers_near(const Face& face, const Ball& tile) const {
    Blockers found;
    const double range = tile.radius + kReaches * options_.reach + kSlack;
    for (const Face& other : scene_.faces) {
      if (!behind(other, tile) && gap(other, tile.centre) < range && may_block(face, other)) {
        found.push_back(blocker(other));
      }
    }
    return found;
  }

  // Faces that touch the capsule from the tile to the lamp.
  [[nodiscard]] Blockers blockers_between(const Face& face, const Ball& tile, const Lamp& lamp) const {
    Blockers found;
    if (out_of_reach(lamp, tile.centre, tile.radius)) return found;
    const Vec3<double> run = lamp.centre - tile.centre;
    const double lamp_radius = std::sqrt(lamp.half_s.squaredNorm() + lamp.half_t.squaredNorm());
    for (const Face& other : scene_.faces) {
      if (std::min(other.width, other.height) < 0.04 || behind(other, tile)) continue;
      const Ball b = ball(other);
      const double along = std::clamp(run.dot(b.centre - tile.centre) / run.squaredNorm(), 0.0, 1.0);
      const double range = b.radius + std::max(tile.radius, lamp_radius);
      if ((tile.centre + along * run - b.centre).squaredNorm() < range * range && may_block(face, other)) {
        found.push_back(blocker(other));
      }
    }
    return found;
  }

  static bool out_of_reach(const Lamp& lamp, const Vec3<double>& from, double slack) {
    constexpr double kReach = 8.0;
    return lamp.normal.dot(from - lamp.centre) <= -slack || (lamp.centre - from).norm() > kReach + slack;
  }

  // The distance at which a unit direction meets the blocker's front, or `limit` where that is nearer.
  static double hit(const Blocker& b, const Vec3<double>& from, const Vec3<double>& direction, double limit) {
    const double speed = b.normal.dot(direction);
    if (speed >= -1e-9) return limit;
    const double distance = (b.offset - b.normal.dot(from)) / speed;
    if (distance < 1e-3 || distance >= limit) return limit;
    const Vec3<double> at = from + distance * direction - b.origin;
    const double s = b.s.dot(at), t = b.t.dot(at);
    return s >= 0.0 && s <= 1.0 && t >= 0.0 && t <= 1.0 ? distance : limit;
  }

  static double first_hit(const Blockers& blockers, const Vec3<double>& from, const Vec3<double>& direction,
                          double limit) {
    for (const Blocker& b : blockers) limit = hit(b, from, direction, limit);
    return limit;
  }

  static bool any_hit(const Blockers& blockers, const Vec3<double>& from, const Vec3<double>& direction,
                      double limit) {
    return std::any_of(blockers.begin(), blockers.end(),
                       [&](const Blocker& b) { return hit(b, from, direction, limit) < limit; });
  }

  [[nodiscard]] double openness(const Blockers& near, const Vec3<double>& from, const Face& face) const {
    const Vec3<double> normal = face.normal();
    double open = 0.0;
    for (const Vec3<double>& d : directions_) {
      const Vec3<double> world = d.x() * face.along_s + d.y() * face.along_t + d.z() * normal;
      open += 1.0 - std::exp(-first_hit(near, from, world, kReaches * options_.reach) / options_.reach);
    }
    return open / kRays;
  }

  static double from_lamp(const Lamp& lamp, const Blockers& blockers, const Vec3<double>& from,
                          const Vec3<double>& normal) {
    if (out_of_reach(lamp, from, 0.0)) return 0.0;
    double sum = 0.0;
    for (int i = 0; i < kLampRays * kLampRays; ++i) {
      const double a = (2 * (i % kLampRays) + 1.0) / kLampRays - 1.0;
      const double b = (2 * (i / kLampRays) + 1.0) / kLampRays - 1.0;
      const Vec3<double> ray = lamp.centre + a * lamp.half_s + b * lamp.half_t - from;
      const double distance = ray.norm();
      const double facing = normal.dot(ray) / distance, leaving = -lamp.normal.dot(ray) / distance;
      if (facing <= 0.0 || leaving <= 0.0) continue;
      if (any_hit(blockers, from, ray / distance, distance - 0.021)) continue;
      sum += facing * leaving / std::max(distance * distance, 0.05);
    }
    return lamp.power * sum / (kLampRays * kLampRays);
  }

  static constexpr double kReaches = 3.0;  // blockers further than this many reaches are not looked for

  const Scene& scene_;
  LightingOptions options_;
  std::array<Vec3<double>, kRays> directions_;
};

}  // namespace sslam::synth
