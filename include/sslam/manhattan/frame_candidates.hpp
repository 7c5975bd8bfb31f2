// SPDX-License-Identifier: BSD-3-Clause
// Candidates for a Manhattan frame anywhere in SO(3): from peaks of the normals and vanishing points of
// segment pairs.
#pragma once

#include <Eigen/Geometry>
#include <span>

#include "sslam/core/inline_vector.hpp"
#include "sslam/core/random.hpp"
#include "sslam/manhattan/cube.hpp"
#include "sslam/manhattan/frame_score.hpp"

namespace sslam {

// The frame whose first axis is `first` and whose second lies in the plane of both; false if they are
// parallel.
template <Scalar S>
[[nodiscard]] bool frame_from_two_axes(const Vec3<S>& first, const Vec3<S>& second, SO3<S>& frame) noexcept {
  const Vec3<S> third = first.cross(second);
  const S sine = third.norm();
  if (!(sine > S(0.05) * first.norm() * second.norm())) return false;
  Mat3<S> axes;
  axes.col(0) = first.normalized();
  axes.col(2) = third / sine;
  axes.col(1) = axes.col(2).cross(axes.col(0));
  frame = SO3<S>::from_matrix(axes);
  return true;
}

template <Scalar S>
[[nodiscard]] SO3<S> random_rotation(Random& random) noexcept {
  // Uniform on SO(3): Shoemake, Graphics Gems III, 1992.
  const S u = random.uniform(S(0), S(1));
  const S a = S(2) * std::numbers::pi_v<S> * random.uniform(S(0), S(1));
  const S b = S(2) * std::numbers::pi_v<S> * random.uniform(S(0), S(1));
  const S p = std::sqrt(S(1) - u);
  const S q = std::sqrt(u);
  return SO3<S>::from_quaternion(p * std::sin(a), p * std::cos(a), q * std::sin(b), q * std::cos(b));
}

// The best frames offered so far, no two of them equivalent.
template <Scalar S, std::size_t Capacity>
class CandidateList {
 public:
  struct Candidate {
    SO3<S> frame;
    S score = 0;
  };

  explicit CandidateList(S distinct) noexcept : distinct_(distinct) {}

  void offer(const SO3<S>& frame, S score) noexcept {
    if (items_.full() && !(score > items_[worst()].score)) return;
    for (Candidate& item : items_) {
      if (angle_between_frames(item.frame, frame) > distinct_) continue;
      if (score > item.score) item = {frame, score};
      return;
    }
    if (items_.full()) {
      items_[worst()] = {frame, score};
    } else {
      (void)items_.push_back({frame, score});
    }
  }

  [[nodiscard]] std::size_t size() const noexcept { return items_.size(); }
  [[nodiscard]] const Candidate& operator[](std::size_t i) const noexcept { return items_[i]; }

 private:
  [[nodiscard]] std::size_t worst() const noexcept {
    std::size_t at = 0;
    for (std::size_t i = 1; i < items_.size(); ++i) {
      if (items_[i].score < items_[at].score) at = i;
    }
    return at;
  }

  S distinct_;
  InlineVector<Candidate, Capacity> items_;
};

template <Scalar S>
using DirectionList = InlineVector<Vec3<S>, 8>;

// Peaks of the normals over the whole half sphere, strongest first, at least `apart` (radians) from each
// other.
template <Scalar S>
[[nodiscard]] DirectionList<S> find_peaks(const DirectionView<S>& normals, S width, S apart,
                                          Random& random) noexcept {
  constexpr std::size_t kFrames = 128;  // 384 directions: about 7 degrees from one to the next
  constexpr int kClimbs = 6;
  std::array<Vec3<S>, 3 * kFrames> directions;
  std::array<S, 3 * kFrames> mass;
  for (std::size_t f = 0; f < kFrames; ++f) {
    const Mat3<S> frame = random_rotation<S>(random).matrix();
    const FrameMoments<S> moments = frame_moments<S>(normals, frame, width);
    for (std::size_t k = 0; k < 3; ++k) {
      directions[3 * f + k] = frame.col(static_cast<int>(k));
      mass[3 * f + k] = moments[k].mass;
    }
  }
  const S chance = S(1.2) * width * width * total_weight<S>(normals);
  const S cosine = std::cos(apart);
  DirectionList<S> peaks;
  while (!peaks.full()) {
    const auto best = static_cast<std::size_t>(std::max_element(mass.begin(), mass.end()) - mass.begin());
    if (!(mass[best] > S(1.5) * chance)) break;
    Vec3<S> peak = directions[best];
    for (int climb = 0; climb < kClimbs; ++climb) {
      Mat3<S> frame;
      frame.col(0) = peak;
      frame.col(1) = peak.unitOrthogonal();
      frame.col(2) = peak.cross(frame.col(1));
      const AxisMoments<S> moments = frame_moments<S>(normals, frame, width)[0];
      peak = (peak + moments.mean.x() * frame.col(1) + moments.mean.y() * frame.col(2)).normalized();
    }
    bool fresh = true;
    for (const Vec3<S>& other : peaks) fresh = fresh && std::abs(other.dot(peak)) < cosine;
    if (fresh) (void)peaks.push_back(peak);
    for (std::size_t i = 0; i < mass.size(); ++i) {
      const S closest =
          std::max(std::abs(directions[i].dot(peak)), std::abs(directions[i].dot(directions[best])));
      if (closest > cosine) mass[i] = 0;
    }
  }
  return peaks;
}

// Calls propose(frame) for every pair of peaks at a right angle (within 15 degrees), every peak with a
// segment along a second axis, and random triples of segments: two that share an axis (their planes meet in
// it), one on another.
template <Scalar S, class Propose>
void propose_frames(const DirectionList<S>& peaks, std::span<const LineVote<S>> lines, int triples,
                    Random& random, Propose&& propose) noexcept {
  SO3<S> frame;
  for (std::size_t a = 0; a < peaks.size(); ++a) {
    for (std::size_t b = a + 1; b < peaks.size(); ++b) {
      if (std::abs(peaks[a].dot(peaks[b])) < S(0.26) && frame_from_two_axes(peaks[a], peaks[b], frame))
        propose(frame);
    }
    for (const LineVote<S>& line : lines) {
      if (frame_from_two_axes<S>(peaks[a], peaks[a].cross(line.plane_normal), frame)) propose(frame);
    }
  }
  const auto count = static_cast<std::uint32_t>(lines.size());
  if (count < 3) return;
  for (int i = 0; i < triples; ++i) {
    const LineVote<S>& first = lines[random.below(count)];
    const LineVote<S>& second = lines[random.below(count)];
    const Vec3<S> vanishing = first.plane_normal.cross(second.plane_normal);
    if (vanishing.norm() < S(0.05))
      continue;  // the same segment, or planes too close to meet in a sharp line
    const Vec3<S> across = vanishing.cross(lines[random.below(count)].plane_normal);
    if (frame_from_two_axes<S>(vanishing, across, frame)) propose(frame);
  }
}

}  // namespace sslam
