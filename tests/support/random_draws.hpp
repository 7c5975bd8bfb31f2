// SPDX-License-Identifier: BSD-3-Clause
// Draws for random scenes. Vectors are filled in order: the arguments of a constructor, and the operands of a
// sum, are evaluated in an order that compilers choose, so two draws there give other scenes on each.
#pragma once

#include <cmath>
#include <numbers>

#include "sslam/core/random.hpp"
#include "sslam/core/types.hpp"

namespace sslam::testing {

// Standard normal (Box and Muller).
[[nodiscard]] inline double gaussian(Random& random) {
  const double radius = std::sqrt(-2 * std::log(1 - random.uniform(0.0, 1.0)));
  return radius * std::cos(random.uniform(0.0, 2 * std::numbers::pi));
}

template <int N>
[[nodiscard]] Vec<double, N> gaussian_vector(Random& random) {
  Vec<double, N> v;
  for (int i = 0; i < N; ++i) v[i] = gaussian(random);
  return v;
}

template <Scalar S, int N>
[[nodiscard]] Vec<S, N> uniform_vector(Random& random, S low, S high) {
  Vec<S, N> v;
  for (int i = 0; i < N; ++i) v[i] = random.uniform(low, high);
  return v;
}

}  // namespace sslam::testing
