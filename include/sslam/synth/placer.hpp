// SPDX-License-Identifier: BSD-3-Clause
// Finds room for furniture along the walls: clear of the path, of openings, of other pieces.
#pragma once

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "sslam/synth/furniture.hpp"
#include "sslam/synth/walls.hpp"

namespace sslam::synth {

class FurniturePlacer {
 public:
  // walked: places of the camera, seen from above. turned: pieces stand at any heading, not along their wall.
  FurniturePlacer(Scene& scene, Decor& decor, std::vector<Vec2<double>> walked, bool turned)
      : maker_(scene, decor), random_(decor.random().next()), walked_(std::move(walked)), turned_(turned) {}

  // Tries pieces along every wall, larger rooms get more; a piece must leave the path and the openings free.
  void furnish(const std::vector<Wall>& walls) {
    for (const Wall& wall : walls) {
      const int wanted = wall.length > 5.0 ? 3 : 2;
      for (int attempt = 0, placed = 0; attempt < 14 && placed < wanted; ++attempt) {
        const Piece piece = static_cast<Piece>(random_.below(kPieces));
        Vec3<double> size = random_size(piece, random_);
        if (piece == Piece::kPillar) size.z() = wall.height;
        if (wall.length < size.x() + 0.2) continue;
        const double x = random_.uniform(0.5 * size.x() + 0.02, wall.length - 0.5 * size.x() - 0.02);
        if (place(piece, size, wall, x, walls)) ++placed;
      }
    }
  }

 private:
  struct Area {
    Placement place;
    Vec2<double> low, high;  // in the placement's frame
  };
  static constexpr double kClearance = 0.45;  // from the path, metres

  bool place(Piece piece, const Vec3<double>& size, const Wall& wall, double x,
             const std::vector<Wall>& walls) {
    const double turn = piece == Piece::kPillar || !turned_ ? 0.0 : random_turn();
    const double gap = turn == 0.0 ? 0.02 : 0.02 + 0.5 * size.x() * std::sin(std::abs(turn));
    for (const Opening& o : wall.openings) {
      const bool low_enough = o.kind == Opening::kWindow && size.z() < o.bottom - 0.08 && size.z() > 0.0;
      if (!low_enough && x + 0.5 * size.x() > o.left - 0.12 && x - 0.5 * size.x() < o.right + 0.12)
        return false;
    }
    const Vec3<double> at = wall.place.point(x, gap, 0.0);
    const Area footprint{
        {at.head<2>(), wall.place.yaw + turn}, {-0.5 * size.x(), 0.0}, {0.5 * size.x(), size.y()}};
    for (const Vec2<double>& p : walked_) {
      if (distance(footprint, p) < kClearance) return false;
    }
    for (const Area& other : placed_) {
      if (overlap(footprint, other) || overlap(other, footprint)) return false;
    }
    for (const Wall& other : walls) {
      if (&other != &wall && pierces(footprint, other)) return false;
    }
    placed_.push_back(footprint);
    maker_.make(piece, footprint.place, size);
    return true;
  }

  double random_turn() noexcept {
    const double angle = random_.uniform(0.2, 0.8);
    return random_.below(2) == 0 ? angle : -angle;
  }

  static Vec2<double> corner(const Area& f, double a, double b) {
    return f.place
        .point(f.low.x() + a * (f.high.x() - f.low.x()), f.low.y() + b * (f.high.y() - f.low.y()), 0.0)
        .head<2>();
  }

  static double distance(const Area& f, const Vec2<double>& p) {
    const Vec2<double> d = p - f.place.at;
    const Vec2<double> local(f.place.x_axis().head<2>().dot(d), f.place.y_axis().head<2>().dot(d));
    return (local - local.cwiseMax(f.low).cwiseMin(f.high)).norm();
  }

  static bool overlap(const Area& a, const Area& b) {
    for (int i = 0; i <= 8; ++i) {
      for (int k = 0; k <= 4; ++k) {
        if (distance(a, corner(b, i / 8.0, k / 4.0)) < 0.06) return true;
      }
    }
    return false;
  }

  // True when the footprint reaches through a wall, or in front of one of its openings.
  static bool pierces(const Area& f, const Wall& wall) {
    for (int i = 0; i < 4; ++i) {
      const Vec2<double> d = corner(f, i & 1, i >> 1) - wall.place.at;
      const double along = wall.place.x_axis().head<2>().dot(d), out = wall.place.y_axis().head<2>().dot(d);
      if (along < -0.2 || along > wall.length + 0.2 || out > 0.5) continue;
      if (out < 0.03 && out > -0.6) return true;
      for (const Opening& o : wall.openings) {
        if (along > o.left - 0.1 && along < o.right + 0.1) return true;
      }
    }
    return false;
  }

  FurnitureMaker maker_;
  Random random_;
  std::vector<Vec2<double>> walked_;
  bool turned_;
  std::vector<Area> placed_;
};

}  // namespace sslam::synth
