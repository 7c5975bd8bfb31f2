// SPDX-License-Identifier: BSD-3-Clause
// The modes of the surface normals near three orthogonal axes: annealed mean shift, joined by the nearest
// rotation.
#pragma once

#include <array>
#include <cmath>

#include "sslam/geometry/nearest_rotation.hpp"
#include "sslam/geometry/so3.hpp"
#include "sslam/manhattan/estimate.hpp"
#include "sslam/manhattan/votes.hpp"

namespace sslam {

// A plane direction found among the normals. Errors of one plane's normals are correlated, so the mean of N
// of them with scatter s has the variance s^2 (1/N + rho) (Kish's design effect for clusters). So sigma does
// not fall below s sqrt(rho), however many normals a plane has, and ten thousand normals do not outweigh a
// long segment.
template <Scalar S>
struct NormalMode {
  bool seen = false;
  Vec3<S> direction = Vec3<S>::Zero();  // unit, camera frame
  S share = 0;                          // of all normals
  S scatter = 0;                        // per component, radians
  S sigma = 0;                          // of the direction, per component, radians
};

template <Scalar S>
struct NormalModes {
  SO3<S> cam_from_axes;  // the rotation that fits the modes; the start if none is seen
  std::array<NormalMode<S>, 3> modes{};
  S width = 0;  // last kernel width, radians
};

namespace detail {

// Whether a peak stands out of the clutter: its spread is finite under the kernel; that of flat clutter is
// not.
template <Scalar S>
[[nodiscard]] bool is_peak(const AxisMoments<S>& axis, S width, S total) noexcept {
  constexpr S kMostGain = 12;                       // scatter at most 3.3 kernel widths
  constexpr S kDensityRatio = 2;                    // over directions that are spread evenly on the sphere
  const S chance = S(1.2) * width * width * total;  // the kernel's integral over that of a half sphere
  return axis.mass > kDensityRatio * chance && kernel_gain(axis.variance, width) < kMostGain;
}

// The rotation that moves the axes to their modes, in the frame of the axes. Axes without a peak stay at the
// prior.
template <Scalar S>
[[nodiscard]] bool joint_step(const FrameMoments<S>& moments, S width, S total,
                              const Mat3<S>& axes_from_prior, SO3<S>& step) noexcept {
  constexpr S kPriorShare = S(0.005);
  Mat3<S> sum = kPriorShare * axes_from_prior;
  for (int k = 0; k < 3; ++k) {
    const AxisMoments<S>& axis = moments[static_cast<std::size_t>(k)];
    if (!is_peak(axis, width, total)) continue;
    const Vec2<S> shift = std::min(kernel_gain(axis.variance, width), S(3)) * axis.mean;
    Vec3<S> mode;
    mode[k] = 1;
    mode[(k + 1) % 3] = shift.x();
    mode[(k + 2) % 3] = shift.y();
    sum.col(k) += axis.mass / total * mode.normalized();
  }
  return usable(nearest_rotation(sum, step));
}

template <Scalar S>
[[nodiscard]] S next_width(const FrameMoments<S>& moments, S width, S total,
                           const ManhattanOptions<S>& options) noexcept {
  S mass = 0;
  S squares = 0;
  for (const AxisMoments<S>& axis : moments) {
    if (!is_peak(axis, width, total)) continue;
    mass += axis.mass;
    squares += axis.mass * axis.variance * kernel_gain(axis.variance, width);
  }
  if (!(mass > S(0))) return width;
  constexpr S kSlowest = S(0.6);  // a faster narrowing could lose a mode before the axis has reached it
  const S wanted = options.kernel_per_scatter * std::sqrt(squares / mass);
  return std::min(width, std::max({wanted, options.narrowest_kernel, kSlowest * width}));
}

template <Scalar S>
void describe_modes(const FrameMoments<S>& moments, S total, const ManhattanOptions<S>& options,
                    NormalModes<S>& found) noexcept {
  const Mat3<S> axes = found.cam_from_axes.matrix();
  for (int k = 0; k < 3; ++k) {
    const AxisMoments<S>& axis = moments[static_cast<std::size_t>(k)];
    NormalMode<S>& mode = found.modes[static_cast<std::size_t>(k)];
    const S gain = kernel_gain(axis.variance, found.width);
    mode.share = std::min(S(1), axis.mass * gain / total);
    mode.scatter = std::sqrt(axis.variance * gain);
    const S votes = std::max(S(1), mode.share * total);
    mode.sigma = std::sqrt(mode.scatter * mode.scatter * (S(1) / votes + options.normal_correlation) +
                           options.normal_floor * options.normal_floor);
    mode.seen = is_peak(axis, found.width, total) && mode.share >= options.min_normal_share &&
                mode.sigma < options.max_deviation;
    const Vec2<S> shift = std::min(gain, S(3)) * axis.mean;
    mode.direction =
        (axes.col(k) + shift.x() * axes.col((k + 1) % 3) + shift.y() * axes.col((k + 2) % 3)).normalized();
  }
}

}  // namespace detail

// Climbs from `start` to the modes of the normals. `total` is total_weight(normals), positive and finite.
template <Scalar S, Scalar V>
[[nodiscard]] NormalModes<S> find_normal_modes(const NormalView<V>& normals, S total, const SO3<S>& start,
                                               const ManhattanOptions<S>& options) noexcept {
  constexpr int kCoarseRounds = 10;
  constexpr int kFineRounds = 2;
  NormalModes<S> found;
  found.cam_from_axes = start;
  found.width = options.widest_kernel;
  const bool sparse = normals.size > 32 * detail::kDirectionBlock;
  const std::size_t every = sparse ? std::max<std::size_t>(options.coarse_every, 1) : 1;
  const S coarse_total = every == 1 ? total : total_weight<S>(normals, every);
  FrameMoments<S> moments{};
  for (int round = 0; round < kCoarseRounds + kFineRounds; ++round) {
    const bool fine = round >= kCoarseRounds;
    const S weight = fine ? total : coarse_total;
    moments = frame_moments<S>(normals, found.cam_from_axes.matrix(), found.width, fine ? 1 : every);
    if (round + 1 == kCoarseRounds + kFineRounds) break;
    const Mat3<S> axes_from_prior = (found.cam_from_axes.inverse() * start).matrix();
    SO3<S> step;
    if (!detail::joint_step(moments, found.width, weight, axes_from_prior, step)) break;
    found.cam_from_axes = found.cam_from_axes * step;
    if (fine) continue;
    const S narrower = detail::next_width(moments, found.width, weight, options);
    const bool settled = narrower > S(0.97) * found.width && step.log().norm() < S(0.02) * found.width;
    found.width = narrower;
    if (settled) round = kCoarseRounds - 1;
  }
  detail::describe_modes(moments, total, options, found);
  return found;
}

}  // namespace sslam
