// SPDX-License-Identifier: BSD-3-Clause
// What is left of a map when its landmarks are taken out: poses, and the motions measured between them.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "sslam/geometry/sim3.hpp"
#include "sslam/solver/bundle/bundle_graph.hpp"

namespace sslam {

template <Scalar S>
struct PoseGraphNode {
  Sim3<S> cam_from_world;  // its scale is the camera's unit of length over the world's
  bool held = false;
  std::optional<RotationTie<S>> rotation;  // from structure: it does not drift along the edges
};

template <Scalar S>
struct PoseGraphEdge {
  std::int32_t from = 0, to = 0;  // nodes
  Sim3<S> to_from;
  Vec<S, 7> inverse_sigma = Vec<S, 7>::Ones();  // of the tangent (phi, rho, log s)
};

template <Scalar S>
struct PoseGraph {
  std::vector<PoseGraphNode<S>> nodes;
  std::vector<PoseGraphEdge<S>> edges;

  void clear() noexcept {
    nodes.clear();
    edges.clear();
  }
};

}  // namespace sslam
