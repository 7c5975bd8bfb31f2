// SPDX-License-Identifier: BSD-3-Clause
// The Manhattan rotation as evidence. Its covariance is that of the votes; walls that are not square, lenses
// and shutters add errors that grow with it. How much is learned from the turn between two frames, which the
// map knows far better than structure does.
#pragma once

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>

#include "sslam/core/median.hpp"
#include "sslam/core/parameter.hpp"
#include "sslam/geometry/spread.hpp"
#include "sslam/map/keyframe.hpp"
#include "sslam/solver/pose/rotation_prior.hpp"

namespace sslam {

template <Scalar S>
struct RotationEvidenceOptions {
  // By what standard deviations are multiplied before anything is known of the camera and the building.
  S first_factor = 3;
  S most = 20;
  // Errors of consecutive frames are alike in part, and that part does not show between them: on recordings
  // with a truth the whole error was 1.5 to 1.9 times what shows.
  S hidden = S(1.7);
  S max_rigid =
      radians(S(0.3));  // standard deviation up to which a rotation is held while the translation is solved
  S gate = S(11.345);   // chi-square of three degrees of freedom at 99 %

  template <class Self, class Visit>
  static void parameters(Self& self, Visit&& visit) {
    visit("first_factor", self.first_factor, Unit::kNumber, 1, 1000,
          "by which standard deviations are multiplied before the first frames have been tracked");
    visit("most", self.most, Unit::kNumber, 1, 1000, "the factor's upper bound");
    visit("hidden", self.hidden, Unit::kNumber, 1, 100,
          "the whole error over the part of it that differs between two consecutive frames");
    visit("max_rigid", self.max_rigid, Unit::kDegrees, 0, 45,
          "standard deviation up to which a Manhattan rotation is held while the translation is solved");
    visit("gate", self.gate, Unit::kNumber, 0, 1000,
          "chi-square up to which a pose agrees with the Manhattan rotation");
  }
};
static_assert(Described<RotationEvidenceOptions<double>>);

template <Scalar S>
class RotationEvidence {
 public:
  RotationEvidenceOptions<S> options;

  template <class Self, class Visit>
  static void parameters(Self& self, Visit&& visit) {
    visit_within("", self.options, visit);
  }

  // By what the standard deviations of the votes are multiplied now.
  [[nodiscard]] S factor() const {
    std::array<S, kMemory> sorted = chi_squares_;
    const S first = options.first_factor / options.hidden;
    for (std::size_t i = count_; i < kMemory; ++i) sorted[i] = kMedianOfThree * first * first;
    const S shown = std::sqrt(median<S>(sorted) / kMedianOfThree);
    return std::clamp(options.hidden * shown, S(1), options.most);
  }

  // The rotation with the covariance that it has in fact; `votes` has that of its votes.
  [[nodiscard]] RotationObservation<S> weigh(const RotationObservation<S>& votes) const {
    const S f = factor();
    return {votes.cam_from_world, f * f * votes.covariance};
  }

  [[nodiscard]] static RotationPrior<S> prior(const RotationObservation<S>& seen) {
    return {seen.cam_from_world, seen.covariance.inverse()};
  }

  // Whether the rotation is so exact that it may be held while the translation is solved.
  [[nodiscard]] bool rigid(const RotationObservation<S>& seen) const {
    return largest_sigma<S>(seen.covariance) < options.max_rigid;
  }

  // Whether a solved rotation has kept to the evidence: a frame where it has is held by structure.
  [[nodiscard]] bool holds(const RotationPrior<S>& prior, const SO3<S>& cam_from_world) const {
    const Vec3<S> off = (cam_from_world * prior.cam_from_world.inverse()).log();
    return off.dot(prior.information * off) <= options.gate;
  }

  // A frame of the dataset has been tracked. What its Manhattan rotation, by the votes, and its solved one
  // say of the turn since the frame before: e = Log(M1 M0^-1 (R1 R0^-1)^-1), of covariance C1 + (R1 R0^-1) C0
  // (R1 R0^-1)^T.
  void learn(std::int64_t index, std::size_t manhattan_frame, const RotationObservation<S>& votes,
             const SO3<S>& solved) {
    if (last_ && last_->index + 1 == index && last_->manhattan_frame == manhattan_frame) {
      const SO3<S> turn = solved * last_->solved.inverse();
      const SO3<S> by_votes = votes.cam_from_world * last_->votes.cam_from_world.inverse();
      const Vec3<S> e = (by_votes * turn.inverse()).log();
      const Mat3<S> turned = turn.matrix();
      const Mat3<S> covariance = votes.covariance + turned * last_->votes.covariance * turned.transpose();
      const S chi_square = e.dot(covariance.llt().solve(e));
      if (std::isfinite(chi_square)) chi_squares_[count_++ % kMemory] = chi_square;
    }
    last_ = Last{index, manhattan_frame, votes, solved};
  }

  // The world has moved, or is another one; the camera and its building are the same.
  void begin_again() noexcept { last_.reset(); }

 private:
  static constexpr std::size_t kMemory = 31;     // frames
  static constexpr S kMedianOfThree = S(2.366);  // of a chi-square with three degrees of freedom

  struct Last {
    std::int64_t index;
    std::size_t manhattan_frame;
    RotationObservation<S> votes;
    SO3<S> solved;
  };
  std::optional<Last> last_;
  std::array<S, kMemory> chi_squares_{};  // a ring
  std::size_t count_ = 0;
};

}  // namespace sslam
