// SPDX-License-Identifier: BSD-3-Clause
// From a network's dense normals to the votes of a NormalField, and whether they are evidence of planes at
// all.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <opencv2/core.hpp>

#include "sslam/core/parameter.hpp"
#include "sslam/geometry/camera.hpp"
#include "sslam/image/normal_grid.hpp"
#include "sslam/map/frame.hpp"

namespace sslam {

// All on one grid; normals are unit vectors in the camera frame, or zero where there is none.
struct DenseNormals {
  cv::Mat_<cv::Vec3f> normal;
  cv::Mat_<float> planar;      // probability of lying on a plane; empty: the model has no mask
  cv::Mat_<float> confidence;  // of the normal; empty: none
  Pinhole<double> pinhole;     // of the grid's pixels

  [[nodiscard]] float weight(int v, int u) const {
    return (planar.empty() ? 1.0F : planar(v, u)) * (confidence.empty() ? 1.0F : confidence(v, u));
  }
};

struct NormalEvidenceOptions {
  double min_planar = 0.5;         // probability from which on a pixel counts as planar
  double min_planar_share = 0.03;  // of the grid: below, the frame has no Manhattan evidence
  double min_agreement = 0.3;  // of neighbouring planar normals, share within agree_angle: below, none either
  double agree_angle = radians(15.0);
  int max_columns = 64;    // of the grid of normals that are used: finer output is subsampled
  PlanarMaskOptions mask;  // for models without a mask: neighbours must agree

  template <class Self, class Visit>
  static void parameters(Self& self, Visit&& visit) {
    visit("min_planar", self.min_planar, Unit::kShare, 0, 1,
          "probability from which on a pixel counts as planar");
    visit("min_planar_share", self.min_planar_share, Unit::kShare, 0, 1,
          "of the grid: below, the frame has no Manhattan evidence");
    visit("min_agreement", self.min_agreement, Unit::kShare, 0, 1,
          "of neighbouring planar normals: below, none either");
    visit("agree_angle", self.agree_angle, Unit::kDegrees, 0, 180, "up to which two neighbours agree");
    visit("max_columns", self.max_columns, Unit::kCount, 1, 1e6, "of the grid of normals that are used");
    visit_within("mask.", self.mask, visit);
  }
};
static_assert(Described<NormalEvidenceOptions>);

struct NormalEvidence {
  bool enough = false;      // false: "no Manhattan evidence", the field is left empty
  double planar_share = 0;  // of the grid
  double agreement = 0;     // of neighbouring planar normals
};

// The planar ones among every n-th normal, at most `max_columns` across.
[[nodiscard]] inline NormalGrid sample_normals(const DenseNormals& dense, double min_planar,
                                               int max_columns) {
  NormalGrid grid;
  const int step = std::max(1, (dense.normal.cols + max_columns - 1) / std::max(max_columns, 1));
  const int first = step / 2;
  grid.reset((dense.normal.cols - first + step - 1) / step, (dense.normal.rows - first + step - 1) / step);
  for (int r = 0; r < grid.rows; ++r) {
    for (int c = 0; c < grid.columns; ++c) {
      const int v = first + r * step, u = first + c * step;
      const cv::Vec3f& n = dense.normal(v, u);
      const auto i = static_cast<std::size_t>(r * grid.columns + c);
      if (n == cv::Vec3f() || (!dense.planar.empty() && dense.planar(v, u) < min_planar)) continue;
      grid.normal[i] = {n[0], n[1], n[2]};
      grid.weight[i] = dense.weight(v, u);
    }
  }
  return grid;
}

// The pinhole of sample_normals' grid.
[[nodiscard]] inline Pinhole<double> sampled_pinhole(const DenseNormals& dense, int max_columns) {
  const int step = std::max(1, (dense.normal.cols + max_columns - 1) / std::max(max_columns, 1));
  const Pinhole<double>& k = dense.pinhole;
  return {k.fx / step, k.fy / step, (k.cx - step / 2) / step, (k.cy - step / 2) / step};
}

namespace normal_evidence_detail {

inline NormalEvidence judge(const NormalGrid& grid, const NormalEvidenceOptions& options) {
  const auto min_cosine = static_cast<float>(std::cos(options.agree_angle));
  std::size_t planar = 0, pairs = 0, agreeing = 0;
  for (int r = 0; r < grid.rows; ++r) {
    for (int c = 0; c < grid.columns; ++c) {
      const auto i = static_cast<std::size_t>(r * grid.columns + c);
      if (grid.weight[i] <= 0) continue;
      ++planar;
      for (const auto& [dr, dc] : {std::pair{0, 1}, std::pair{1, 0}}) {
        if (r + dr >= grid.rows || c + dc >= grid.columns) continue;
        const auto j = static_cast<std::size_t>((r + dr) * grid.columns + c + dc);
        if (grid.weight[j] <= 0) continue;
        ++pairs;
        agreeing += grid.normal[i].dot(grid.normal[j]) >= min_cosine ? 1U : 0U;
      }
    }
  }
  NormalEvidence evidence;
  evidence.planar_share = static_cast<double>(planar) / std::max<std::size_t>(grid.weight.size(), 1);
  evidence.agreement = pairs > 0 ? static_cast<double>(agreeing) / static_cast<double>(pairs) : 0;
  evidence.enough =
      evidence.planar_share >= options.min_planar_share && evidence.agreement >= options.min_agreement;
  return evidence;
}

}  // namespace normal_evidence_detail

// Replaces `field` with the planar normals, weighted by mask and confidence; leaves it empty without
// evidence.
inline NormalEvidence select_normals(const DenseNormals& dense, const NormalEvidenceOptions& options,
                                     NormalField& field) {
  field.clear();
  const NormalGrid grid = sample_normals(dense, options.min_planar, options.max_columns);
  const NormalEvidence evidence = normal_evidence_detail::judge(grid, options);
  if (!evidence.enough) return evidence;
  if (dense.planar.empty()) {
    keep_planar(grid, options.mask, field);
    return evidence;
  }
  for (std::size_t i = 0; i < grid.weight.size(); ++i) {
    if (grid.weight[i] <= 0) continue;
    const auto& n = grid.normal[i];
    field.push_back(n.x(), n.y(), n.z(), grid.weight[i]);
  }
  return evidence;
}

}  // namespace sslam
