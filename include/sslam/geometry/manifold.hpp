// SPDX-License-Identifier: BSD-3-Clause
// The interface of a state for solvers and numeric derivatives: a tangent space and a retraction. Also the
// flat state, a vector.
#pragma once

#include <concepts>

#include "sslam/core/types.hpp"

namespace sslam {

template <class X>
using ScalarOf = typename X::ScalarType;

// A state with a retraction for tangent vectors of kDof entries.
template <class X>
concept Manifold = Scalar<ScalarOf<X>> && requires(const X x, const Vec<ScalarOf<X>, X::kDof>& delta) {
  { x.retract(delta) } -> std::convertible_to<X>;
};

// A vector as a state; its retraction is addition.
template <Scalar S, int N>
struct Euclidean {
  using ScalarType = S;
  static constexpr int kDof = N;

  Vec<S, N> value = Vec<S, N>::Zero();

  [[nodiscard]] Euclidean retract(const Vec<S, N>& delta) const noexcept { return {value + delta}; }
};
static_assert(Manifold<Euclidean<float, 2>> && Manifold<Euclidean<double, 3>>);

}  // namespace sslam
