// SPDX-License-Identifier: BSD-3-Clause
// How far normals are off in fact. Their source promises some error; what they show of the axes is compared
// with the axes as the solved poses have them, and where the map contradicts them they lose weight by it.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "sslam/core/median.hpp"
#include "sslam/geometry/so3.hpp"
#include "sslam/map/keyframe.hpp"
#include "sslam/track/contract/rotation_answer.hpp"

namespace sslam {

template <Scalar S>
class NormalTrust {
 public:
  // What the normals of one plane get wrong together, radians per component: as their source promises, or as
  // it was measured, if that is more.
  [[nodiscard]] S plane_sigma(S promised) const {
    const std::size_t known = std::min(count_, kMemory);
    if (known < kFew) return promised;
    std::array<S, kMemory> sorted = squares_;
    const S typical = median<S>(std::span<S>(sorted.data(), known));
    return std::max(promised, std::sqrt(typical / kMedianOfTwo));
  }

  // A frame has its pose. The squared angle between each axis that its normals showed and that axis by the
  // pose is, over sigma^2, a chi-square of two degrees of freedom.
  void learn(const NormalAxes<S>& seen, const SO3<S>& cam_from_manhattan) {
    for (int k = 0; k < 3; ++k) {
      const auto& direction = seen[static_cast<std::size_t>(k)];
      if (!direction) continue;
      const S square = direction->cross(cam_from_manhattan.matrix().col(k)).squaredNorm();
      if (std::isfinite(square)) squares_[count_++ % kMemory] = square;
    }
  }

 private:
  static constexpr std::size_t kMemory = 31;     // axes
  static constexpr std::size_t kFew = 7;         // below, nothing is said
  static constexpr S kMedianOfTwo = S(1.38629);  // of a chi-square with two degrees of freedom

  std::array<S, kMemory> squares_{};  // a ring
  std::size_t count_ = 0;
};

}  // namespace sslam
