// SPDX-License-Identifier: BSD-3-Clause
// Where a plane is solid: a grid of cells in it, for which the views vote. A view votes for a cell that it
// has labelled with the plane, and against one through which it sees another plane farther away.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "sslam/dense/label_smoother.hpp"

namespace sslam::dense {

struct CellOptions {
  double margin = 0.03;     // by how much farther another plane is, as a part of the depth, to speak against
  double min_votes = 2;     // views that a cell needs
  double min_area = 0.01;   // of a connected part, over the median scene depth squared
  double max_hole = 0.003;  // that is filled where nobody sees through it, likewise
  std::size_t most_cells = 4000000;  // of a plane: beyond, it is refused
};

// Cells of a plane, row by row along its second tangent.
struct PlaneCells {
  Plane3<double> plane;
  Mat<double, 3, 2> basis = Mat<double, 3, 2>::Zero();  // world: of the two coordinates in the plane
  Vec2<double> origin = Vec2<double>::Zero();           // of the first cell's corner
  double cell = 0;                                      // side, units of the map
  int columns = 0, rows = 0;
  std::vector<std::uint8_t> solid;  // by cell
  std::vector<float> support, contradiction;

  [[nodiscard]] Vec3<double> place(const Vec2<double>& u) const {
    return plane.distance * plane.normal + basis * u;
  }
  [[nodiscard]] Vec2<double> corner(int column, int row) const {
    return origin + cell * Vec2<double>(column, row);
  }
  [[nodiscard]] Vec3<double> centre(int column, int row) const {
    return place(corner(column, row) + Vec2<double>::Constant(cell / 2));
  }
  [[nodiscard]] bool is_solid(int column, int row) const {
    return column >= 0 && row >= 0 && column < columns && row < rows &&
           solid[static_cast<std::size_t>(row * columns + column)] != 0;
  }
  [[nodiscard]] bool is_solid_at(const Vec2<double>& u) const {
    const Vec2<double> at = (u - origin) / cell;
    return is_solid(static_cast<int>(std::floor(at.x())), static_cast<int>(std::floor(at.y())));
  }
  [[nodiscard]] std::size_t count() const {
    return static_cast<std::size_t>(std::count(solid.begin(), solid.end(), std::uint8_t{1}));
  }
  [[nodiscard]] double area() const { return static_cast<double>(count()) * cell * cell; }
};

class CellVoter {
 public:
  // `labels` by view, of `planes`. All of it outlives the voter.
  CellVoter(std::span<const DenseView> views, std::span<const BoundedPlane> planes,
            std::span<const LabelGrid> labels, const CellOptions& options)
      : views_(views), planes_(planes), labels_(labels), options_(options) {
    for (const DenseView& view : views)
      for (const BoundedPlane& plane : planes)
        forms_.push_back(inverse_depth_form(view.pinhole, transform(view.cam_from_world, plane.plane)));
  }

  // The cells of one plane around all that is labelled with it; none where nothing is.
  [[nodiscard]] PlaneCells vote(std::size_t p, double cell) const {
    PlaneCells cells;
    cells.plane = planes_[p].plane;
    cells.basis = planes_[p].basis;
    cells.cell = cell;
    if (!bound(p, cells)) return cells;
    const auto count = static_cast<std::size_t>(cells.columns * cells.rows);
    cells.support.assign(count, 0);
    cells.contradiction.assign(count, 0);
    for (std::size_t v = 0; v < views_.size(); ++v) add_view(v, p, cells);
    cells.solid.resize(count);
    for (std::size_t i = 0; i < count; ++i)
      cells.solid[i] = cells.support[i] >= std::min<double>(options_.min_votes, views_.size()) &&
                       cells.support[i] > cells.contradiction[i];
    return cells;
  }

 private:
  [[nodiscard]] bool bound(std::size_t p, PlaneCells& cells) const {
    Vec2<double> low = Vec2<double>::Constant(1e300), high = -low;
    for (std::size_t v = 0; v < views_.size(); ++v) {
      const SE3<double> world_from_cam = views_[v].cam_from_world.inverse();
      const LabelGrid& grid = labels_[v];
      for (std::size_t b = 0; b < grid.plane.size(); ++b) {
        if (grid.plane[b] != static_cast<std::int16_t>(p)) continue;
        const int column = static_cast<int>(b) % grid.columns, row = static_cast<int>(b) / grid.columns;
        const Vec2<double> pixel((column + 0.5) * grid.block - 0.5, (row + 0.5) * grid.block - 0.5);
        const Vec3<double> ray = views_[v].pinhole.unproject(pixel);
        const Vec2<double> u =
            cells.basis.transpose() * (world_from_cam * Vec3<double>(ray / grid.inverse_depth[b]));
        low = low.cwiseMin(u);
        high = high.cwiseMax(u);
      }
    }
    if (!(low.array() <= high.array()).all()) return false;
    cells.origin =
        (low / cells.cell).array().floor().matrix() * cells.cell - Vec2<double>::Constant(cells.cell);
    const Vec2<double> size = (high - cells.origin) / cells.cell + Vec2<double>::Constant(2);
    if (!(size.x() * size.y() < static_cast<double>(options_.most_cells))) return false;
    cells.columns = static_cast<int>(size.x());
    cells.rows = static_cast<int>(size.y());
    return true;
  }

  // The columns of a row of cells, at base + c * across in the camera's frame, that may be in the picture:
  // from the first to before the second.
  [[nodiscard]] static std::pair<int, int> columns_in_view(const Pinhole<double>& k, const LabelGrid& grid,
                                                           const Vec3<double>& base,
                                                           const Vec3<double>& across, int columns) {
    constexpr double kMargin = 1.5;  // half a pixel, and one for rounding
    const double wide = grid.columns * grid.block - 1 + kMargin, high = grid.rows * grid.block - 1 + kMargin;
    const Vec3<double> inside[] = {{0, 0, 1},  // positive in front of the camera, and within each border
                                   {k.fx, 0, k.cx + kMargin},
                                   {-k.fx, 0, wide - k.cx},
                                   {0, k.fy, k.cy + kMargin},
                                   {0, -k.fy, high - k.cy}};
    double from = 0, to = columns;
    for (const Vec3<double>& form : inside) {
      const double value = form.dot(base), slope = form.dot(across);
      if (slope > 0) from = std::max(from, -value / slope);
      if (slope < 0) to = std::min(to, -value / slope);
      if (slope == 0 && !(value > 0)) return {0, 0};
    }
    if (!(from <= to)) return {0, 0};
    return {static_cast<int>(from), std::min(columns, static_cast<int>(to) + 1)};
  }

  void add_view(std::size_t v, std::size_t p, PlaneCells& cells) const {
    const DenseView& view = views_[v];
    const LabelGrid& grid = labels_[v];
    const Vec3<double> first = view.cam_from_world * cells.centre(0, 0);
    const Vec3<double> across = view.cam_from_world.rotation * Vec3<double>(cells.cell * cells.basis.col(0)),
                       down = view.cam_from_world.rotation * Vec3<double>(cells.cell * cells.basis.col(1));
    for (int r = 0; r < cells.rows; ++r) {
      const auto [from, to] = columns_in_view(view.pinhole, grid, first + r * down, across, cells.columns);
      for (int c = from; c < to; ++c) {
        const Vec3<double> x = first + c * across + r * down;
        if (!(x.z() > 1e-9)) continue;
        const Vec2<double> pixel = view.pinhole.project(x);
        const int b = grid.block_at(pixel);
        if (b < 0) continue;
        const std::int16_t label = grid.plane[static_cast<std::size_t>(b)];
        const auto i = static_cast<std::size_t>(r * cells.columns + c);
        if (label == static_cast<std::int16_t>(p)) {
          cells.support[i] += 1;
        } else if (label != kNoPlane) {
          const Vec3<double>& form = forms_[v * planes_.size() + static_cast<std::size_t>(label)];
          const double other = form.dot(Vec3<double>(pixel.x(), pixel.y(), 1));
          if (other < (1 - options_.margin) / x.z()) cells.contradiction[i] += 1;
        }
      }
    }
  }

  std::span<const DenseView> views_;
  std::span<const BoundedPlane> planes_;
  std::span<const LabelGrid> labels_;
  CellOptions options_;
  std::vector<Vec3<double>> forms_;  // by view and plane
};

namespace detail {

// Of the connected parts of cells that are `kind`, turns those that `flips(part, at_border)` says. Four
// neighbours.
template <class Flips>
void flip_parts(PlaneCells& cells, std::uint8_t kind, const Flips& flips) {
  std::vector<std::uint8_t> done(cells.solid.size(), 0);
  std::vector<std::size_t> part;
  for (std::size_t seed = 0; seed < cells.solid.size(); ++seed) {
    if (done[seed] != 0 || cells.solid[seed] != kind) continue;
    part.assign(1, seed);
    done[seed] = 1;
    bool at_border = false;
    for (std::size_t k = 0; k < part.size(); ++k) {
      const int c = static_cast<int>(part[k]) % cells.columns, r = static_cast<int>(part[k]) / cells.columns;
      for (const auto& [dc, dr] : {std::pair{1, 0}, std::pair{-1, 0}, std::pair{0, 1}, std::pair{0, -1}}) {
        const int nc = c + dc, nr = r + dr;
        if (nc < 0 || nr < 0 || nc >= cells.columns || nr >= cells.rows) {
          at_border = true;
          continue;
        }
        const auto n = static_cast<std::size_t>(nr * cells.columns + nc);
        if (done[n] != 0 || cells.solid[n] != kind) continue;
        done[n] = 1;
        part.push_back(n);
      }
    }
    if (flips(part, at_border))
      for (const std::size_t i : part) cells.solid[i] = kind == 0;
  }
}

}  // namespace detail

// Drops connected parts below min_area, and fills holes up to max_hole that no view sees through; both in
// units of the map, squared.
inline void clean_cells(PlaneCells& cells, double min_area, double max_hole) {
  const double area = cells.cell * cells.cell;
  detail::flip_parts(cells, 1, [&](const std::vector<std::size_t>& part, bool) {
    return static_cast<double>(part.size()) * area < min_area;
  });
  detail::flip_parts(cells, 0, [&](const std::vector<std::size_t>& part, bool at_border) {
    const auto seen_through = [&](std::size_t i) { return cells.contradiction[i] > cells.support[i]; };
    return !at_border && static_cast<double>(part.size()) * area <= max_hole &&
           std::none_of(part.begin(), part.end(), seen_through);
  });
}

}  // namespace sslam::dense
