// SPDX-License-Identifier: BSD-3-Clause
// Which rooms of a large house a camera can see into: its own, and through open doorways those behind (cells
// and portals; Luebke, Georges, I3D 1995). What a frame costs depends on what is in view, not on the house.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "sslam/synth/face_view.hpp"
#include "sslam/synth/scene.hpp"

namespace sslam::synth {

// The cell in which a point lies, or whose doorway it stands in; -1 outside of the house.
[[nodiscard]] inline std::int32_t cell_at(const Scene& scene, const Vec3<double>& point) noexcept {
  const auto find = [&](auto beyond) {
    const auto at = std::find_if(scene.cells.begin(), scene.cells.end(),
                                 [&](const Cell& cell) { return cell.holds(point, beyond(cell)); });
    return at == scene.cells.end() ? -1 : static_cast<std::int32_t>(at - scene.cells.begin());
  };
  const std::int32_t within = find([](const Cell&) { return 0.0; });
  return within >= 0 ? within : find([](const Cell& cell) { return cell.sill; });
}

class CellsInView {
 public:
  // In the order of their numbers. All of them where the camera is in none.
  const std::vector<std::int32_t>& find(const Scene& scene, const View& view) {
    cells_.clear();
    const Vec3<double> camera = view.cam_from_world.inverse().translation;
    const std::int32_t own = cell_at(scene, camera);
    if (own >= 0) {
      visit(scene, view, camera, own, -1, {-1.0, -1.0, view.width * 1.0, view.height * 1.0});
      std::sort(cells_.begin(), cells_.end());
      cells_.erase(std::unique(cells_.begin(), cells_.end()), cells_.end());
    } else {
      for (std::size_t i = 0; i < scene.cells.size(); ++i) cells_.push_back(static_cast<std::int32_t>(i));
    }
    return cells_;
  }

 private:
  struct Window {
    double left, top, right, bottom;  // pixels

    [[nodiscard]] bool empty() const noexcept { return !(left < right && top < bottom); }
  };

  // Through a doorway nobody looks back through it: cells are convex.
  void visit(const Scene& scene, const View& view, const Vec3<double>& camera, std::int32_t cell,
             std::int32_t from, const Window& window) {
    cells_.push_back(cell);
    for (const Doorway& door : scene.cells[static_cast<std::size_t>(cell)].doorways) {
      if (door.into == from) continue;
      const Window seen = through(door, view, camera, window);
      if (!seen.empty()) visit(scene, view, camera, door.into, cell, seen);
    }
  }

  // What of the window the doorway leaves: the rectangle around its corners.
  [[nodiscard]] static Window through(const Doorway& door, const View& view, const Vec3<double>& camera,
                                      const Window& window) {
    constexpr double kNear = 0.05, kMargin = 2.0;  // metres, pixels
    const Vec3<double> across = (door.corners[1] - door.corners[0]).cross(door.corners[2] - door.corners[0]);
    // Standing in it, one sees all that is behind.
    if (std::abs(across.normalized().dot(camera - door.corners[0])) < kNear) return window;
    constexpr double kFar = std::numeric_limits<double>::max();
    Window box{kFar, kFar, -kFar, -kFar};
    const auto add = [&](const Vec3<double>& p) {
      const Vec2<double> at = view.pinhole.project(p);
      box = {std::min(box.left, at.x()), std::min(box.top, at.y()), std::max(box.right, at.x()),
             std::max(box.bottom, at.y())};
    };
    for (std::size_t i = 0; i < door.corners.size(); ++i) {
      const Vec3<double> a = view.cam_from_world * door.corners[i];
      const Vec3<double> b = view.cam_from_world * door.corners[(i + 1) % door.corners.size()];
      if (a.z() >= kNear) add(a);
      if ((a.z() < kNear) != (b.z() < kNear)) add(a + (kNear - a.z()) / (b.z() - a.z()) * (b - a));
    }
    return {std::max(window.left, box.left - kMargin), std::max(window.top, box.top - kMargin),
            std::min(window.right, box.right + kMargin), std::min(window.bottom, box.bottom + kMargin)};
  }

  std::vector<std::int32_t> cells_;
};

}  // namespace sslam::synth
