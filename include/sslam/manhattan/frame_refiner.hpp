// SPDX-License-Identifier: BSD-3-Clause
// Refinement of the Manhattan rotation. Normals give a start close enough to converge, and name the axes;
// segments determine the last degrees.
#pragma once

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <span>

#include "sslam/geometry/spread.hpp"
#include "sslam/manhattan/line_circles.hpp"
#include "sslam/manhattan/normal_modes.hpp"
#include "sslam/solver/least_squares/positive_inverse.hpp"

namespace sslam {

namespace detail {

// All costs of the rotation, linearised about one frame. Unknown: psi, a turn in the frame of the axes (R <-
// R Exp(psi) = Exp(R psi) R), which moves axis k by d_i = psi_j, d_j = -psi_i.
template <Scalar S>
struct FramePull {
  Mat3<S> H = Mat3<S>::Zero();
  Vec3<S> g = Vec3<S>::Zero();

  void add(const AxisSystem<S>& axis, int k) noexcept {
    const int i = (k + 1) % 3;
    const int j = (k + 2) % 3;
    H(j, j) += axis.H(0, 0);
    H(i, i) += axis.H(1, 1);
    H(i, j) -= axis.H(0, 1);
    H(j, i) -= axis.H(0, 1);
    g[j] += axis.g[0];
    g[i] -= axis.g[1];
  }
};

// A mode as an observation of its axis. The Cauchy weight (scale 2 sigma) reduces the effect of a plane that
// is not quite Manhattan, or of biased normals, if segments agree with each other.
template <Scalar S>
[[nodiscard]] AxisSystem<S> mode_system(const NormalMode<S>& mode, const Mat3<S>& cam_from_axes, int k,
                                        Vec2<S>& offset) noexcept {
  const Vec3<S> seen = cam_from_axes.transpose() * mode.direction;
  offset = Vec2<S>(seen[(k + 1) % 3], seen[(k + 2) % 3]) / std::max(seen[k], S(0.1));
  const S information = S(1) / (mode.sigma * mode.sigma);
  const S weight = information / (S(1) + S(0.25) * information * offset.squaredNorm());
  AxisSystem<S> system;
  system.H = Mat2<S>::Identity() * weight;
  system.g = -weight * offset;
  return system;
}

// Smallest eigenvalue of a symmetric 2 x 2 matrix.
template <Scalar S>
[[nodiscard]] S weakest(const Mat2<S>& m) noexcept {
  const S half = S(0.5) * (m(0, 0) - m(1, 1));
  return S(0.5) * (m(0, 0) + m(1, 1)) - std::sqrt(half * half + m(0, 1) * m(0, 1));
}

// The refinement on SO(3): iteratively re-weighted least squares over modes, segments and prior.
template <Scalar S>
class FrameRefiner {
 public:
  FrameRefiner(const NormalModes<S>& modes, std::span<const LineVote<S>> lines,
               const ManhattanPrior<S>& prior, const Mat3<S>& prior_information,
               const ManhattanOptions<S>& options) noexcept
      : modes_(modes),
        lines_(lines),
        prior_(prior),
        prior_information_(prior_information),
        options_(options) {}

  // Writes the final shares of the segments to `shares`.
  [[nodiscard]] ManhattanEstimate<S> run(LineShares<S>& shares) noexcept {
    constexpr int kMostRounds = 16;
    constexpr S kStill = S(2e-5);
    rotation_ = modes_.cam_from_axes;
    S gate = lines_.empty() ? S(0) : options_.widest_line_gate;
    for (int round = 0; round < kMostRounds; ++round) {
      const Vec3<S> psi = step(gate);
      if (!psi.allFinite()) break;
      rotation_ = rotation_ * SO3<S>::exp(psi);
      if (gate == S(0) && psi.norm() < kStill) break;
      gate = gate > S(0.3) * options_.line_floor ? gate / S(2) : S(0);
    }
    (void)step(S(0));
    shares = shares_;
    return describe();
  }

 private:
  // Segments show an axis if they are likelier with it than by chance, and if their planes meet in it. Pieces
  // of one image line do not: they lie in one plane, and a free axis can always be turned into it.
  [[nodiscard]] bool by_lines(std::size_t k) const noexcept {
    constexpr S kMeeting = radians(S(5));  // standard deviation of the direction in which the planes meet
    return round_.gain[k] >= options_.min_line_gain &&
           (modes_.modes[k].seen || weakest(round_.systems[k].H) * kMeeting * kMeeting >= S(1));
  }

  // Linearises about rotation_ and returns the turn psi. While the gate is open, every axis takes part; which
  // ones have enough support is known only at the end.
  [[nodiscard]] Vec3<S> step(S gate) noexcept {
    const Mat3<S> axes = rotation_.matrix();
    const S floor = std::sqrt(options_.line_floor * options_.line_floor + gate * gate);
    round_ = weigh_lines(lines_, axes, shares_, floor);
    shares_ = update_shares(round_, lines_.size());
    votes_ = FramePull<S>{};
    for (int k = 0; k < 3; ++k) {
      const auto at = static_cast<std::size_t>(k);
      own_[at] = AxisSystem<S>{};
      if (modes_.modes[at].seen) own_[at] = mode_system(modes_.modes[at], axes, k, offsets_[at]);
      if (gate > S(0) || by_lines(at)) {
        own_[at].H += round_.systems[at].H;
        own_[at].g += round_.systems[at].g;
      }
      votes_.add(own_[at], k);
    }
    const Vec3<S> to_prior = axes.transpose() * (prior_.cam_from_manhattan * rotation_.inverse()).log();
    posterior_ = votes_.H + axes.transpose() * prior_information_ * axes;
    const Vec3<S> g = votes_.g - axes.transpose() * (prior_information_ * (axes * to_prior));
    return -posterior_.ldlt().solve(g);
  }

  [[nodiscard]] ManhattanEstimate<S> describe() const noexcept {
    ManhattanEstimate<S> estimate;
    estimate.cam_from_manhattan = rotation_;
    const Mat3<S> axes = rotation_.matrix();
    Mat3<S> covariance = Mat3<S>::Zero();
    const bool certain = inverse_of<S, 3>(posterior_, covariance);
    estimate.covariance = axes * covariance * axes.transpose();
    S squared = 0;
    S count = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      AxisSupport<S>& axis = estimate.axes[k];
      axis.normal_share = modes_.modes[k].share;
      axis.normal_scatter = modes_.modes[k].scatter;
      axis.by_normals = modes_.modes[k].seen;
      if (axis.by_normals) axis.mode = offsets_[k];
      axis.mode_sigma = modes_.modes[k].sigma;
      axis.by_lines = by_lines(k);
      axis.lines = round_.count[k];
      axis.line_gain = round_.gain[k];
      axis.seen = axis.by_normals || axis.by_lines;
      estimate.axes_seen += axis.seen ? 1 : 0;
      if (!axis.by_lines) continue;
      squared += round_.squared[k];
      count += round_.count[k];
    }
    if (count > S(0)) estimate.line_rms = std::sqrt(squared / count);
    const S least = std::max(symmetric_eigenvalues<S>(votes_.H).x(), S(0));
    estimate.deviation = S(1) / std::sqrt(std::max(least, S(0.1)));
    estimate.log_likelihood = round_.log_likelihood;
    estimate.status = !certain || estimate.axes_seen == 0                              ? Status::kNoConsensus
                      : least * options_.max_deviation * options_.max_deviation < S(1) ? Status::kDegenerate
                                                                                       : Status::kOk;
    return estimate;
  }

  const NormalModes<S>& modes_;
  std::span<const LineVote<S>> lines_;
  const ManhattanPrior<S>& prior_;
  const Mat3<S>& prior_information_;
  const ManhattanOptions<S>& options_;
  SO3<S> rotation_;
  LineShares<S> shares_;
  LineRound<S> round_;
  std::array<AxisSystem<S>, 3> own_{};  // normals and segments of each axis
  std::array<Vec2<S>, 3> offsets_{};
  FramePull<S> votes_;
  Mat3<S> posterior_ = Mat3<S>::Identity();
};

}  // namespace detail

}  // namespace sslam
