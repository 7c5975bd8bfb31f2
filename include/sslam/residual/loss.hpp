// SPDX-License-Identifier: BSD-3-Clause
// Robust losses: rho(s) of a squared, noise-weighted error s, and weight(s) = rho'(s) for reweighted least
// squares.
#pragma once

#include <cmath>
#include <concepts>

#include "sslam/core/types.hpp"

namespace sslam {

template <class L, class S>
concept Loss = requires(const L loss, S squared_error) {
  { loss.rho(squared_error) } -> std::same_as<S>;
  { loss.weight(squared_error) } -> std::same_as<S>;
};

template <Scalar S>
struct TrivialLoss {
  [[nodiscard]] S rho(S s) const noexcept { return s; }
  [[nodiscard]] S weight(S) const noexcept { return 1; }
};

// Quadratic up to `width` standard deviations, linear beyond (Huber 1964).
template <Scalar S>
struct HuberLoss {
  S width = 1;
  [[nodiscard]] S rho(S s) const noexcept {
    return s <= width * width ? s : 2 * width * std::sqrt(s) - width * width;
  }
  [[nodiscard]] S weight(S s) const noexcept { return s <= width * width ? S(1) : width / std::sqrt(s); }
};

// Logarithmic: far errors hardly pull, but are never quite let go.
template <Scalar S>
struct CauchyLoss {
  S width = 1;
  [[nodiscard]] S rho(S s) const noexcept { return width * width * std::log1p(s / (width * width)); }
  [[nodiscard]] S weight(S s) const noexcept { return 1 / (1 + s / (width * width)); }
};

// Errors beyond `width` standard deviations do not pull at all (Tukey's biweight).
template <Scalar S>
struct TukeyLoss {
  S width = 3;
  [[nodiscard]] S rho(S s) const noexcept {
    const S left = 1 - s / (width * width);
    return left > 0 ? width * width / 3 * (1 - left * left * left) : width * width / 3;
  }
  [[nodiscard]] S weight(S s) const noexcept {
    const S left = 1 - s / (width * width);
    return left > 0 ? left * left : S(0);
  }
};

static_assert(Loss<TrivialLoss<float>, float> && Loss<HuberLoss<double>, double>);
static_assert(Loss<CauchyLoss<float>, float> && Loss<TukeyLoss<double>, double>);

}  // namespace sslam
