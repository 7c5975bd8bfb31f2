// SPDX-License-Identifier: BSD-3-Clause
// Finds room for furniture along the walls: clear of the path, of openings, of other pieces.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "sslam/synth/floor_space.hpp"
#include "sslam/synth/furniture.hpp"
#include "sslam/synth/off_square.hpp"
#include "sslam/synth/outline.hpp"

namespace sslam::synth {

// Of a table or a desk.
struct TableTop {
  FloorArea area;
  double height;
  std::size_t first_face, last_face;   // of the piece with what it came with; last exclusive
  std::vector<FloorArea> things = {};  // put there since
};

class FurniturePlacer {
 public:
  // turned: pieces stand at any heading, not along their wall; off: by how much those along it miss it.
  FurniturePlacer(Scene& scene, Decor& decor, FloorSpace& space, bool turned, OffSquare off)
      : scene_(scene),
        maker_(scene, decor),
        random_(decor.random().next()),
        space_(space),
        turned_(turned),
        off_(off) {}

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

  [[nodiscard]] const std::vector<TableTop>& tops() const noexcept { return tops_; }

 private:
  bool place(Piece piece, const Vec3<double>& size, const Wall& wall, double x,
             const std::vector<Wall>& walls) {
    const double turn = piece == Piece::kPillar ? 0.0 : turned_ ? random_turn() : off_.angle();
    const double gap = turn == 0.0 ? 0.02 : 0.02 + 0.5 * size.x() * std::sin(std::abs(turn));
    for (const Opening& o : wall.openings) {
      const bool low_enough = o.kind == Opening::kWindow && size.z() < o.bottom - 0.08 && size.z() > 0.0;
      if (!low_enough && x + 0.5 * size.x() > o.left - 0.12 && x - 0.5 * size.x() < o.right + 0.12)
        return false;
    }
    const Vec3<double> at = wall.place.point(x, gap, 0.0);
    const FloorArea area{
        {at.head<2>(), wall.place.yaw + turn}, {-0.5 * size.x(), 0.0}, {0.5 * size.x(), size.y()}};
    if (!space_.free(area)) return false;
    for (const Wall& other : walls) {
      if (&other != &wall && pierces(area, other)) return false;
    }
    space_.take(area);
    const std::size_t first = scene_.faces.size();
    maker_.make(piece, area.place, size);
    if (piece == Piece::kTable || piece == Piece::kDesk)
      tops_.push_back({area, size.z(), first, scene_.faces.size()});
    return true;
  }

  double random_turn() noexcept {
    const double angle = random_.uniform(0.2, 0.8);
    return random_.below(2) == 0 ? angle : -angle;
  }

  Scene& scene_;
  FurnitureMaker maker_;
  Random random_;
  FloorSpace& space_;
  bool turned_;
  OffSquare off_;
  std::vector<TableTop> tops_;
};

}  // namespace sslam::synth
