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
    heads_.clear();
    looks_.clear();
    known_.clear();
    for (auto& links : after_) links.clear();
    for (auto& links : before_) links.clear();
  }
  [[nodiscard]] bool made() const noexcept { return !heads_.empty(); }

  template <class Landmarks>
  void make(const Landmarks& landmarks) {
    forget();
    heads_.assign(kPieces << kPieceBits, kNone);
    for (std::size_t i = 0; i < landmarks.size(); ++i)
      if (landmarks[i].alive) set(static_cast<LandmarkId>(i), landmarks[i].descriptor);
  }

  // The landmark looks like this from now on.
  void set(LandmarkId id, const Descriptor& descriptor) {
    if (!made()) return;
    const std::size_t at = index(id);
    if (known_.size() <= at) grow(at + 1);
    for (std::size_t p = 0; p < kPieces; ++p) {
      const std::size_t bucket = bucket_of(descriptor, p);
      if (known_[at] != 0 && bucket == bucket_of(looks_[at], p)) continue;
      if (known_[at] != 0) leave(at, p);
      LandmarkId& head = heads_[bucket];
      if (head != kNone) before_[p][index(head)] = id;
      before_[p][at] = kNone;
      after_[p][at] = head;
      head = id;
    }
    looks_[at] = descriptor;
    known_[at] = 1;
  }

  void remove(LandmarkId id) {
    const std::size_t at = index(id);
    if (at >= known_.size() || known_[at] == 0) return;
    for (std::size_t p = 0; p < kPieces; ++p) leave(at, p);
    known_[at] = 0;
  }

  // Calls visit(id, how many bits differ), more than once for one that shares several pieces. After make().
  template <class Visit>
  void near(const Descriptor& descriptor, Visit visit) const {
    for (std::size_t p = 0; p < kPieces; ++p)
      for (LandmarkId id = heads_[bucket_of(descriptor, p)]; id != kNone; id = after_[p][index(id)])
        visit(id, hamming(descriptor, looks_[index(id)]));
  }

 private:
  static constexpr std::size_t kPieces = 16, kPieceBits = 16;

  [[nodiscard]] static std::size_t index(LandmarkId id) noexcept { return static_cast<std::size_t>(id); }

  void grow(std::size_t size) {
    for (auto& links : after_) links.resize(size, kNone);
    for (auto& links : before_) links.resize(size, kNone);
    looks_.resize(size);
    known_.resize(size, 0);
  }

  void leave(std::size_t at, std::size_t piece) {
    const LandmarkId before = before_[piece][at], after = after_[piece][at];
    if (after != kNone) before_[piece][index(after)] = before;
    if (before != kNone)
      after_[piece][index(before)] = after;
    else
      heads_[bucket_of(looks_[at], piece)] = after;
  }

  [[nodiscard]] static std::size_t bucket_of(const Descriptor& descriptor, std::size_t piece) noexcept {
    return piece << kPieceBits | (descriptor.words[piece / 4] >> (kPieceBits * (piece % 4)) & 0xFFFFU);
  }

  std::vector<LandmarkId> heads_;  // first landmark of each bucket; empty: not made
  std::array<std::vector<LandmarkId>, kPieces> after_, before_;  // in its bucket of each piece, by landmark
  std::vector<Descriptor> looks_;                                // by landmark
  std::vector<std::uint8_t> known_;                              // by landmark: whether it is in
};

}  // namespace sslam
