// SPDX-License-Identifier: BSD-3-Clause
// What two poses of a pose graph disagree by with the motion that was measured between them, scale included
// (Strasdat, Montiel, Davison, Scale Drift-Aware Large Scale Monocular SLAM, RSS 2010).
#pragma once

#include "sslam/geometry/sim3.hpp"

namespace sslam {

template <Scalar S>
struct SimilarityEdge {
  Vec<S, 7> error;       // Log(to_from * from * to^-1), tangent (phi, rho, log s)
  Mat<S, 7, 7> by_from;  // derivative by the left perturbation of `from`
  Mat<S, 7, 7> by_to;
};

// `from` and `to` take the world into their cameras.
template <Scalar S>
[[nodiscard]] SimilarityEdge<S> similarity_edge(const Sim3<S>& to_from, const Sim3<S>& from,
                                                const Sim3<S>& to) noexcept {
  SimilarityEdge<S> edge;
  edge.error = (to_from * from * to.inverse()).log();
  edge.by_from = Sim3<S>::left_jacobian_inverse(edge.error) * to_from.adjoint();
  edge.by_to = -Sim3<S>::left_jacobian_inverse(-edge.error);
  return edge;
}

}  // namespace sslam
