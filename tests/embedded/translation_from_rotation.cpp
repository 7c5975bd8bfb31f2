// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/solver/two_view/translation.hpp"

namespace sslam::embedded {

void run_translation_from_rotation(std::span<const BearingMatch<float>> matches, const SO3<float>& R_10,
                                   const TranslationOptions<float>& options, std::uint64_t seed,
                                   std::span<std::uint8_t> inliers,
                                   TranslationEstimate<float>& out) noexcept {
  out = translation_from_rotation(matches, R_10, options, seed, inliers);
}

}  // namespace sslam::embedded
