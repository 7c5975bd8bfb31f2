// SPDX-License-Identifier: BSD-3-Clause
// Furniture out of boxes. Each piece stands with its back on the x axis of its placement and reaches to +y.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "sslam/synth/decor.hpp"
#include "sslam/synth/scene.hpp"

namespace sslam::synth {

enum class Piece : std::uint8_t { kCupboard, kShelf, kTable, kSofa, kCartons, kDesk, kPillar };
inline constexpr int kPieces = 7;

// Width along x, depth along y, height; metres.
[[nodiscard]] inline Vec3<double> random_size(Piece piece, Random& random) noexcept {
  const auto between = [&](double low, double high) { return random.uniform(low, high); };
  switch (piece) {
    case Piece::kCupboard:
      return {between(0.8, 1.6), between(0.4, 0.6), between(1.6, 2.1)};
    case Piece::kShelf:
      return {between(0.7, 1.3), between(0.25, 0.35), between(1.2, 2.0)};
    case Piece::kTable:
      return {between(0.9, 1.5), between(0.6, 0.8), between(0.7, 0.76)};
    case Piece::kSofa:
      return {between(1.4, 2.0), between(0.75, 0.9), between(0.7, 0.85)};
    case Piece::kCartons:
      return {between(0.5, 0.9), between(0.4, 0.5), between(0.7, 1.2)};
    case Piece::kDesk:
      return {between(1.1, 1.6), between(0.6, 0.75), between(0.7, 0.76)};
    case Piece::kPillar:
      return {between(0.2, 0.4), between(0.2, 0.4), 0.0};
  }
  return {1.0, 0.5, 1.0};
}

class FurnitureMaker {
 public:
  FurnitureMaker(Scene& scene, Decor& decor) : scene_(scene), decor_(decor) {}

  void make(Piece piece, const Placement& place, const Vec3<double>& size) {
    switch (piece) {
      case Piece::kCupboard:
        return cupboard(place, size);
      case Piece::kShelf:
        return shelf(place, size);
      case Piece::kTable:
        return table(place, size);
      case Piece::kSofa:
        return sofa(place, size);
      case Piece::kCartons:
        return cartons(place, size);
      case Piece::kDesk:
        return desk(place, size);
      case Piece::kPillar:
        box(place, {-0.5 * size.x(), 0.0, 0.0}, {0.5 * size.x(), size.y(), size.z()},
            decor_.plain(0.6f, 0.9f));
    }
  }

 private:
  static constexpr unsigned kStanding = Sides::kAll & ~Sides::kBottom;

  void box(const Placement& place, const Vec3<double>& low, const Vec3<double>& high, const Paint& paint,
           unsigned sides = kStanding) {
    add_box(scene_, place, low, high, decor_.shifted(paint), sides);
  }

  // Doors stand out from the body by 18 mm with gaps of 6 mm; each has a handle.
  void fronts(const Placement& place, const Vec3<double>& low, const Vec3<double>& high, int columns,
              int rows, const Paint& paint) {
    constexpr double kGap = 0.003, kOut = 0.018;
    const Paint handle = decor_.plain(0.1f, 0.4f);
    for (int i = 0; i < columns * rows; ++i) {
      const double w = (high.x() - low.x()) / columns, h = (high.z() - low.z()) / rows;
      const double x = low.x() + w * (i % columns), z = low.z() + h * (i / columns);
      const double y = low.y();
      box(place, {x + kGap, y, z + kGap}, {x + w - kGap, y + kOut, z + h - kGap}, paint, Sides::kAll);
      const bool tall = h > 0.5;
      const double hx =
          tall ? (i % columns == 0 && columns > 1 ? x + w - 0.06 : x + 0.05) : x + 0.5 * w - 0.06;
      const double hz = tall ? z + 0.5 * h : z + 0.7 * h;
      const Vec3<double> size = tall ? Vec3<double>(0.015, 0.03, 0.14) : Vec3<double>(0.12, 0.03, 0.015);
      const Vec3<double> corner(hx, y + kOut, hz);
      box(place, corner, corner + size, handle, Sides::kAll);
    }
  }

  void cupboard(const Placement& place, const Vec3<double>& size) {
    const double half = 0.5 * size.x(), depth = size.y() - 0.018;
    const Paint body = decor_.furniture();
    Paint front = decor_.random().below(2) == 0 ? body : decor_.furniture();
    front.colour *= 0.95f;
    box(place, {-half, 0.0, 0.0}, {half, depth, size.z()}, body);
    const int columns = size.x() > 1.2 ? 3 : 2;
    const double split = decor_.random().below(2) == 0 ? 0.08 : 0.6;
    if (split > 0.5) fronts(place, {-half, depth, 0.08}, {half, depth, split}, columns, 2, front);
    fronts(place, {-half, depth, split}, {half, depth, size.z()}, columns, 1, front);
  }

  void shelf(const Placement& place, const Vec3<double>& size) {
    constexpr double kBoard = 0.02;
    const double half = 0.5 * size.x();
    const Paint wood = decor_.furniture();
    box(place, {-half, 0.0, 0.0}, {-half + kBoard, size.y(), size.z()}, wood);
    box(place, {half - kBoard, 0.0, 0.0}, {half, size.y(), size.z()}, wood);
    box(place, {-half, 0.0, 0.0}, {half, 0.01, size.z()}, wood);
    const int boards = std::max(3, static_cast<int>(size.z() / 0.35));
    const bool filled = decor_.textured();
    for (int i = 0; i <= boards; ++i) {
      const double z = (size.z() - kBoard) * i / boards;
      box(place, {-half + kBoard, 0.0, z}, {half - kBoard, size.y(), z + kBoard}, wood, Sides::kAll);
      if (i < boards)
        fill(place, half - kBoard, size.y(), z + kBoard, (size.z() - kBoard) / boards - kBoard, filled);
    }
  }

  // Books, or a plain box or two, on one board.
  void fill(const Placement& place, double half, double depth, double z, double room, bool books) {
    Random& random = decor_.random();
    const double width = half * random.uniform(0.7, 1.9);
    if (books) {
      const double height = 0.8 * room;
      const Paint spines = decor_.books(static_cast<float>(width), static_cast<float>(height));
      add_box(scene_, place, {-half, 0.02, z}, {-half + width, 0.8 * depth, z + height}, spines,
              Sides::kFront);
      box(place, {-half, 0.02, z}, {-half + width, 0.8 * depth, z + height}, decor_.plain(0.3f, 0.7f),
          Sides::kTop | Sides::kLeft | Sides::kRight);
    } else if (random.below(3) != 0) {
      box(place, {-half + 0.1 * width, 0.05, z}, {-half + 0.5 * width, 0.75 * depth, z + 0.7 * room},
          decor_.furniture());
    }
  }

  void legs(const Placement& place, const Vec3<double>& size, const Paint& paint) {
    constexpr double kLeg = 0.05;
    const double half = 0.5 * size.x();
    for (const double x : {-half + 0.03, half - 0.03 - kLeg}) {
      for (const double y : {0.03, size.y() - 0.03 - kLeg}) {
        box(place, {x, y, 0.0}, {x + kLeg, y + kLeg, size.z() - 0.03}, paint);
      }
    }
    box(place, {-half, 0.0, size.z() - 0.03}, {half, size.y(), size.z()}, paint, Sides::kAll);
  }

  void table(const Placement& place, const Vec3<double>& size) {
    legs(place, size, decor_.furniture());
    clutter(place, size);
  }

  // A few boxes on top: books, a case.
  void clutter(const Placement& place, const Vec3<double>& size) {
    Random& random = decor_.random();
    const double half = 0.5 * size.x();
    for (int i = 0; i < 3; ++i) {
      const double x = -half + size.x() * (0.08 + 0.32 * i),
                   width = 0.2 * size.x() * random.uniform(0.6, 1.0);
      const double y = random.uniform(0.1, 0.35) * size.y(), z = size.z();
      const Paint paint = decor_.furniture();
      const double depth = random.uniform(0.12, 0.25), height = random.uniform(0.04, 0.35);
      box(place, {x, y, z}, {x + width, y + depth, z + height}, paint);
    }
  }

  void desk(const Placement& place, const Vec3<double>& size) {
    const double half = 0.5 * size.x();
    const Paint wood = decor_.furniture(), dark = decor_.plain(0.08f, 0.18f);
    legs(place, size, wood);
    box(place, {half - 0.5, 0.05, 0.0}, {half - 0.1, size.y() - 0.07, size.z() - 0.04}, wood);
    fronts(place, {half - 0.5, size.y() - 0.07, 0.04}, {half - 0.1, size.y() - 0.07, size.z() - 0.04}, 1, 3,
           wood);
    const double z = size.z();  // a monitor on its foot
    box(place, {-0.12, 0.14, z}, {0.12, 0.3, z + 0.015}, dark);
    box(place, {-0.03, 0.2, z}, {0.03, 0.23, z + 0.15}, dark);
    box(place, {-0.28, 0.23, z + 0.1}, {0.28, 0.26, z + 0.46}, dark, Sides::kAll);
    box(place, {-0.26, 0.26, z + 0.12}, {0.26, 0.262, z + 0.44}, decor_.plain(0.25f, 0.4f));
  }

  void sofa(const Placement& place, const Vec3<double>& size) {
    constexpr double kArm = 0.16;
    const double half = 0.5 * size.x(), seat = 0.42;
    const Paint cloth = decor_.furniture();
    Paint cushion = cloth;
    cushion.colour *= 0.93f;
    box(place, {-half, 0.0, 0.05}, {half, 0.2, size.z()}, cloth);
    box(place, {-half, 0.2, 0.05}, {-half + kArm, size.y(), 0.6}, cloth);
    box(place, {half - kArm, 0.2, 0.05}, {half, size.y(), 0.6}, cloth);
    box(place, {-half + kArm, 0.2, 0.05}, {half - kArm, size.y() - 0.04, seat - 0.12}, cloth);
    for (const double side : {-1.0, 1.0}) {
      const double inner = side < 0.0 ? -half + kArm + 0.004 : 0.004;
      box(place, {inner, 0.2, seat - 0.12}, {inner + half - kArm - 0.008, size.y() - 0.02, seat}, cushion);
    }
  }

  void cartons(const Placement& place, const Vec3<double>& size) {
    Random& random = decor_.random();
    double z = 0.0, half = 0.5 * size.x(), depth = size.y();
    while (z < size.z() - 0.15) {
      const double height = random.uniform(0.22, 0.4);
      const double shift = random.uniform(-0.5, 0.5) * (0.5 * size.x() - half);
      box(place, {shift - half, 0.02, z}, {shift + half, 0.02 + depth - 0.02, z + height},
          decor_.furniture());
      z += height;
      half *= random.uniform(0.75, 0.98);
      depth *= random.uniform(0.8, 0.98);
    }
  }

  Scene& scene_;
  Decor& decor_;
};

}  // namespace sslam::synth
