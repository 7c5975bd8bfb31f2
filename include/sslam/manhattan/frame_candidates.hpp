// SPDX-License-Identifier: BSD-3-Clause
// Candidates for a Manhattan frame anywhere in SO(3): from peaks of the normals and vanishing points of
// segment pairs.
#pragma once

#include <Eigen/Geometry>
#include <span>

#include "sslam/core/inline_vector.hpp"
#include "sslam/core/random.hpp"
#include "sslam/geometry/so3.hpp"
#include "sslam/manhattan/best_distinct.hpp"
#include "sslam/manhattan/frame_score.hpp"

namespace sslam {

// The frame whose first axis is `first` and whose second axis lies in the plane of `first` and `second`;
// false if they are parallel.
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

// Capacity for the peaks of the normals and as many vanishing points.
inline constexpr std::size_t kMostDirections = 8;
template <Scalar S>
using DirectionList = InlineVector<Vec3<S>, 2 * kMostDirections>;

// Adds the peaks of the normals over the whole half sphere, at least `apart` (radians) from each other.
template <Scalar S>
void find_peaks(const DirectionView<S>& normals, S width, S apart, Random& random,
                DirectionList<S>& peaks) noexcept {
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
  while (peaks.size() < kMostDirections) {
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
}

// Adds vanishing points: intersections of random pairs of segments in which most segments meet. These are
// directions that many great circles share, at least `apart` (radians) from each other. `floor` (radians) is
// added to each segment's sigma.
template <Scalar S>
void find_vanishing_points(std::span<const LineVote<S>> lines, int pairs, S floor, S apart, Random& random,
                           DirectionList<S>& directions) noexcept {
  const auto count = static_cast<std::uint32_t>(lines.size());
  if (count < 2) return;
  const S cosine = std::cos(apart);
  const auto same = [cosine](const Vec3<S>& a, const Vec3<S>& b) { return std::abs(a.dot(b)) > cosine; };
  BestDistinct<Vec3<S>, S, kMostDirections, decltype(same)> points(same);
  for (int i = 0; i < pairs; ++i) {
    const LineVote<S>& first = lines[random.below(count)];
    const LineVote<S>& second = lines[random.below(count)];
    const Vec3<S> meeting = first.plane_normal.cross(second.plane_normal);
    const S sine = meeting.norm();
    if (!(sine > S(0.05))) continue;  // the same segment, or planes too close to meet in a sharp line
    const Vec3<S> point = meeting / sine;
    points.offer(point, score_direction(lines, point, floor));
  }
  for (std::size_t i = 0; i < points.size(); ++i) (void)directions.push_back(points[i].item);
}

// Calls propose(frame) for every pair of directions at a right angle (within 15 degrees), and for every
// direction with a segment along a second axis.
template <Scalar S, class Propose>
void propose_frames(const DirectionList<S>& directions, std::span<const LineVote<S>> lines,
                    Propose&& propose) noexcept {
  SO3<S> frame;
  for (std::size_t a = 0; a < directions.size(); ++a) {
    for (std::size_t b = a + 1; b < directions.size(); ++b) {
      const bool square = std::abs(directions[a].dot(directions[b])) < S(0.26);
      if (square && frame_from_two_axes(directions[a], directions[b], frame)) propose(frame);
    }
    for (const LineVote<S>& line : lines) {
      if (frame_from_two_axes<S>(directions[a], directions[a].cross(line.plane_normal), frame))
        propose(frame);
    }
  }
}

}  // namespace sslam
