// SPDX-License-Identifier: BSD-3-Clause
// Which landmarks of a map may look like a descriptor: those that share a sixteenth of its bits at the same
// place (locality-sensitive hashing by bit sampling; Indyk, Motwani, STOC 1998). It follows the map as that
// changes, so that a place is looked for among what looks alike and not among all.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "sslam/core/descriptor.hpp"
#include "sslam/core/hamming_block.hpp"
#include "sslam/map/bucket_lists.hpp"
#include "sslam/map/landmark.hpp"

namespace sslam {

// Bits of a descriptor depend on each other, so a bucket holds more than chance would put there. Measured on
// a walk with 13,000 landmarks: of those that differ in at most 40 bits 99 % are found, in 41 to 50 bits 94
// %, in 51 to 62 bits 82 %, and 23 % of all landmarks are visited.
class LookIndex {
 public:
  LookIndex() = default;
  ~LookIndex() = default;
  LookIndex(LookIndex&&) noexcept = default;
  LookIndex& operator=(LookIndex&&) noexcept = default;
  // A copy is made anew when it is first asked: most are never asked.
  LookIndex(const LookIndex&) noexcept {}
  LookIndex& operator=(const LookIndex&) noexcept {
    forget();
    return *this;
  }

  // The landmarks are others: they are taken in by the next make().
  void forget() noexcept {
    buckets_.clear();
    looks_.clear();
    slots_.clear();
  }
  [[nodiscard]] bool made() const noexcept { return !buckets_.empty(); }

  template <class Landmarks>
  void make(const Landmarks& landmarks) {
    forget();
    buckets_.assign(kPieces << kPieceBits);
    for (std::size_t i = 0; i < landmarks.size(); ++i)
      if (landmarks[i].alive) set(static_cast<LandmarkId>(i), landmarks[i].descriptor);
  }

  // The landmark looks like this from now on.
  void set(LandmarkId id, const Descriptor& descriptor) {
    if (!made()) return;
    const std::size_t at = index(id);
    if (slots_.size() <= at) {
      slots_.resize(at + 1, kNowhere);
      looks_.resize(at + 1);
    }
    for (std::size_t p = 0; p < kPieces; ++p) {
      const std::size_t bucket = bucket_of(descriptor, p);
      if (slots_[at][p] != kNone) {
        if (bucket == bucket_of(looks_[at], p)) continue;
        leave(at, p);
      }
      slots_[at][p] = buckets_.insert(bucket, id);
    }
    looks_[at] = descriptor;
  }

  void remove(LandmarkId id) {
    const std::size_t at = index(id);
    if (at >= slots_.size() || slots_[at] == kNowhere) return;
    for (std::size_t p = 0; p < kPieces; ++p) leave(at, p);
    slots_[at] = kNowhere;
  }

  // Calls visit(id, in how many bits it differs) once for each landmark that shares a piece and differs in at
  // most `most` bits. After make().
  template <class Visit>
  void near(const Descriptor& descriptor, int most, Visit visit) const {
    HammingBlock<BucketLists::kChunk> bits;
    for (std::size_t p = kPieces; p-- > 0;)  // the fullest buckets are those of the last pieces
      buckets_.visit(bucket_of(descriptor, p), [&](const BucketLists::Ids& ids, std::size_t count) {
        hamming_block(descriptor, looks_, ids, count, bits);
        for (std::size_t i = 0; i < count; ++i)
          if (bits[i] <= most && !share_after(descriptor, looks_[index(ids[i])], p)) visit(ids[i], bits[i]);
      });
  }

 private:
  static constexpr std::size_t kPieces = 16, kPieceBits = 16;
  using Slots = std::array<std::int32_t, kPieces>;
  static constexpr Slots kNowhere = [] {
    Slots slots{};
    slots.fill(kNone);
    return slots;
  }();

  [[nodiscard]] static std::size_t index(LandmarkId id) noexcept { return static_cast<std::size_t>(id); }

  void leave(std::size_t at, std::size_t piece) {
    const LandmarkId moved = buckets_.erase(bucket_of(looks_[at], piece), slots_[at][piece]);
    if (moved != kNone) slots_[index(moved)][piece] = slots_[at][piece];
  }

  [[nodiscard]] static std::size_t piece_of(const Descriptor& descriptor, std::size_t piece) noexcept {
    return descriptor.words[piece / 4] >> (kPieceBits * (piece % 4)) & 0xFFFFU;
  }
  [[nodiscard]] static std::size_t bucket_of(const Descriptor& descriptor, std::size_t piece) noexcept {
    return piece << kPieceBits | piece_of(descriptor, piece);
  }

  // Whether a piece after that one is the same: all bits of a lane of their difference are zero.
  [[nodiscard]] static bool share_after(const Descriptor& a, const Descriptor& b,
                                        std::size_t piece) noexcept {
    constexpr std::uint64_t kAllButTop = 0x7FFF7FFF7FFF7FFF;
    const std::size_t first = piece / 4;
    for (std::size_t w = a.words.size() - 1; w + 1 > first; --w) {
      std::uint64_t differ = a.words[w] ^ b.words[w];
      if (w == first) differ |= ~std::uint64_t{0} >> (kPieceBits * (3 - piece % 4));
      if (~(((differ & kAllButTop) + kAllButTop) | differ | kAllButTop) != 0) return true;
    }
    return false;
  }

  BucketLists buckets_;            // of each piece, by its bits; empty: not made
  std::vector<Slots> slots_;       // in the bucket of each piece, by landmark; kNowhere: not in
  std::vector<Descriptor> looks_;  // by landmark
};

}  // namespace sslam
