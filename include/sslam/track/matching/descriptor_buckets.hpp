// SPDX-License-Identifier: BSD-3-Clause
// Which features may look like a descriptor: those that share a sixteenth of its bits at the same place
// (locality-sensitive hashing by bit sampling; Indyk, Motwani, STOC 1998).
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "sslam/core/descriptor.hpp"
#include "sslam/map/landmark.hpp"

namespace sslam {

// A feature that differs in 25 of 256 bits is found in 97 % of cases, in 40 bits in 71 %, in 60 bits in 28 %.
class DescriptorBuckets {
 public:
  template <class Features>
  void build(const Features& features) {
    heads_.resize(kPieces << kPieceBits, kNone);
    for (const std::size_t used : used_) heads_[used] = kNone;
    used_.clear();
    next_.assign(features.size() * kPieces, kNone);
    for (std::size_t f = 0; f < features.size(); ++f)
      for (std::size_t p = 0; p < kPieces; ++p) {
        const std::size_t bucket = bucket_of(features[f].descriptor, p);
        next_[f * kPieces + p] = heads_[bucket];
        heads_[bucket] = static_cast<std::int32_t>(f);
        used_.push_back(bucket);
      }
  }

  // Calls visit(feature), more than once for one that shares several pieces.
  template <class Visit>
  void near(const Descriptor& descriptor, Visit visit) const {
    for (std::size_t p = 0; p < kPieces; ++p)
      for (std::int32_t f = heads_[bucket_of(descriptor, p)]; f != kNone;
           f = next_[static_cast<std::size_t>(f) * kPieces + p])
        visit(f);
  }

 private:
  static constexpr std::size_t kPieces = 16, kPieceBits = 16;

  [[nodiscard]] static std::size_t bucket_of(const Descriptor& descriptor, std::size_t piece) noexcept {
    return piece << kPieceBits | (descriptor.words[piece / 4] >> (kPieceBits * (piece % 4)) & 0xFFFFU);
  }

  std::vector<std::int32_t> heads_;  // first feature of each bucket
  std::vector<std::int32_t> next_;   // of each feature and piece
  std::vector<std::size_t> used_;    // buckets that are not empty
};

}  // namespace sslam
