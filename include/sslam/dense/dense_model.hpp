// SPDX-License-Identifier: BSD-3-Clause
// A finished map and its keyframes' images as planes with extent.
#pragma once

#include <cmath>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "sslam/dense/creases.hpp"
#include "sslam/dense/plane_candidates.hpp"
#include "sslam/dense/triangulate.hpp"
#include "sslam/dense/view_costs.hpp"

namespace sslam::dense {

struct DenseOptions {
  CandidateOptions candidates;
  CostOptions cost;
  SmoothOptions smooth;
  CellOptions cells;
  CreaseOptions creases;
  double cell = 0.008;   // side of a cell, over the median scene depth
  double outline = 1.0;  // by how much polygons may leave the cells' outline, in cells
};

struct DenseModel {
  std::vector<DensePlane> planes;  // the largest first
  std::vector<LabelGrid> labels;   // by view: which candidate each block shows
  std::size_t candidates = 0;

  [[nodiscard]] double area() const {
    double sum = 0;
    for (const DensePlane& plane : planes) sum += plane.cells.area();
    return sum;
  }
};

class DenseBuilder {
 public:
  explicit DenseBuilder(const DenseOptions& options) : options_(options) {}

  // Empty where no plane has support. The same input gives the same model.
  [[nodiscard]] DenseModel build(const Map<double>& map, double median_depth,
                                 std::span<const DenseView> views) {
    DenseModel model;
    if (!(median_depth > 0) || views.empty()) return model;
    const std::vector<PlaneCandidate> candidates =
        CandidateFinder(map, median_depth, options_.candidates).find();
    model.candidates = candidates.size();
    if (candidates.empty()) return model;
    std::vector<BoundedPlane> planes;
    planes.reserve(candidates.size());
    for (const PlaneCandidate& candidate : candidates) planes.push_back(candidate.bounded);
    label(views, planes, median_depth, model.labels);
    const CellVoter voter(views, planes, model.labels, options_.cells);
    for (std::size_t p = 0; p < planes.size(); ++p) {
      DensePlane plane;
      plane.fit = candidates[p].fit;
      plane.axis = candidates[p].axis;
      plane.label = p;
      plane.cells = voter.vote(p, options_.cell * median_depth);
      clean(plane.cells, median_depth);
      if (plane.cells.count() == 0) continue;
      plane.seen_from = side(views, model.labels, plane);
      model.planes.push_back(std::move(plane));
    }
    bring_to_creases(median_depth, model.planes);
    std::stable_sort(model.planes.begin(), model.planes.end(), [](const DensePlane& a, const DensePlane& b) {
      return a.cells.area() > b.cells.area();
    });
    return model;
  }

 private:
  void label(std::span<const DenseView> views, std::span<const BoundedPlane> planes, double median_depth,
             std::vector<LabelGrid>& labels) const {
    ViewCosts costs(views, planes, median_depth, options_.cost);
    LabelSmoother smoother;
    smoother.options = options_.smooth;
    CostGrid grid;
    labels.resize(views.size());
    for (std::size_t v = 0; v < views.size(); ++v) {
      costs.fill(v, grid);
      smoother.smooth(grid, views[v].grey, options_.cost.block, labels[v]);
    }
  }

  [[nodiscard]] static int side(std::span<const DenseView> views, const std::vector<LabelGrid>& labels,
                                const DensePlane& plane) {
    std::ptrdiff_t sum = 0;
    for (std::size_t v = 0; v < views.size(); ++v) {
      const auto blocks =
          std::count(labels[v].plane.begin(), labels[v].plane.end(), static_cast<std::int16_t>(plane.label));
      sum += plane.fit.plane.offset(views[v].centre()) > 0 ? blocks : -blocks;
    }
    return sum < 0 ? -1 : 1;
  }

  void clean(PlaneCells& cells, double median_depth) const {
    const double square = median_depth * median_depth;
    clean_cells(cells, options_.cells.min_area * square, options_.cells.max_hole * square);
  }

  // All planes as they are at first decide what is cut off.
  void bring_to_creases(double median_depth, std::vector<DensePlane>& planes) const {
    const std::vector<DensePlane> before = planes;
    for (std::size_t p = 0; p < planes.size(); ++p) {
      cut_behind(creases_of(before, p), options_.creases, planes[p].cells);
      clean(planes[p].cells, median_depth);
    }
    std::erase_if(planes, [](const DensePlane& plane) { return plane.cells.count() == 0; });
    for (std::size_t p = 0; p < planes.size(); ++p) outline(creases_of(planes, p), planes[p]);
  }

  void outline(const std::vector<Crease>& creases, DensePlane& plane) const {
    const PlaneCells& cells = plane.cells;
    std::vector<Ring> rings =
        trace_cells(cells.columns, cells.rows, [&](int c, int r) { return cells.is_solid(c, r); });
    for (Ring& ring : rings) {
      for (Vec2<double>& corner : ring) corner = cells.origin + cells.cell * corner;
      snap(creases, options_.creases, cells, ring);
      ring = simplify(ring, options_.outline * cells.cell);
    }
    plane.polygons = nest(rings);
  }

  DenseOptions options_;
};

}  // namespace sslam::dense
