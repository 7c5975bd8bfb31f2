// SPDX-License-Identifier: BSD-3-Clause
// The unknowns of a bundle adjustment as Ceres' parameter blocks.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "sslam/ceres/manifolds.hpp"
#include "sslam/solver/bundle/bundle_graph.hpp"

namespace sslam {

// One block for each entry of the graph's lists.
struct BundleBlocks {
  std::vector<PoseBlock> poses;
  std::vector<PointBlock> points;
  std::vector<LineBlock> lines;
  std::vector<PlaneBlock> planes;

  void load(const BundleGraph<double>& graph) {
    poses.resize(graph.views.size());
    points.resize(graph.points.size());
    lines.resize(graph.lines.size());
    planes.resize(graph.planes.size());
    for (std::size_t i = 0; i < poses.size(); ++i) store_pose(graph.views[i].cam_from_world, poses[i].data());
    for (std::size_t i = 0; i < points.size(); ++i)
      Eigen::Map<Vec3<double>>(points[i].data()) = graph.points[i].position;
    for (std::size_t i = 0; i < lines.size(); ++i) store_line(graph.lines[i].line, lines[i].data());
    for (std::size_t i = 0; i < planes.size(); ++i) store_plane(graph.planes[i].plane, planes[i].data());
  }

  void store(BundleGraph<double>& graph) const {
    for (std::size_t i = 0; i < poses.size(); ++i)
      if (graph.views[i].hold != Hold::kPose) graph.views[i].cam_from_world = load_pose(poses[i].data());
    for (std::size_t i = 0; i < points.size(); ++i)
      graph.points[i].position = Eigen::Map<const Vec3<double>>(points[i].data());
    for (std::size_t i = 0; i < lines.size(); ++i) graph.lines[i].line = load_line(lines[i].data());
    for (std::size_t i = 0; i < planes.size(); ++i) graph.planes[i].plane = load_plane(planes[i].data());
  }

  [[nodiscard]] bool finite() const {
    const auto all = [](const auto& blocks) {
      return std::all_of(blocks.begin(), blocks.end(), [](const auto& block) {
        return std::all_of(block.begin(), block.end(), [](double x) { return std::isfinite(x); });
      });
    };
    return all(poses) && all(points) && all(lines) && all(planes);
  }
};

}  // namespace sslam
