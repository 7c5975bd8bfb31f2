// SPDX-License-Identifier: BSD-3-Clause
// Which landmarks of a map may look like a descriptor: those that share a sixteenth of its bits at the same
// place (locality-sensitive hashing by bit sampling; Indyk, Motwani, STOC 1998). It follows the map as that
// changes, so that a place is looked for among what looks alike and not among all.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "sslam/core/descriptor.hpp"
#include "sslam/map/landmark.hpp"

namespace sslam {

// A landmark that differs in 25 of 256 bits is found in 97 % of cases, in 40 bits in 71 %, in 60 bits in 28
// %.
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
    nodes_.clear();
  }
  [[nodiscard]] bool made() const noexcept { return !heads_.empty(); }

  template <class Landmarks>
  void make(const Landmarks& landmarks) {
    heads_.assign(kPieces << kPieceBits, kNone);
    nodes_.clear();
    for (std::size_t i = 0; i < landmarks.size(); ++i)
      if (landmarks[i].alive) set(static_cast<LandmarkId>(i), landmarks[i].descriptor);
  }

  // The landmark looks like this from now on.
  void set(LandmarkId id, const Descriptor& descriptor) {
    if (!made()) return;
    const auto at = static_cast<std::size_t>(id);
    if (nodes_.size() <= at) nodes_.resize(at + 1);
    Node& node = nodes_[at];
    for (std::size_t p = 0; p < kPieces; ++p) {
      const std::size_t bucket = bucket_of(descriptor, p);
      if (node.known && bucket == bucket_of(node.descriptor, p)) continue;
      if (node.known) leave(node, p);
      std::int32_t& head = heads_[bucket];
      if (head != kNone) nodes_[static_cast<std::size_t>(head)].before[p] = id;
      node.before[p] = kNone;
      node.after[p] = head;
      head = id;
    }
    node.descriptor = descriptor;
    node.known = true;
  }

  void remove(LandmarkId id) {
    const auto at = static_cast<std::size_t>(id);
    if (at >= nodes_.size() || !nodes_[at].known) return;
    for (std::size_t p = 0; p < kPieces; ++p) leave(nodes_[at], p);
    nodes_[at].known = false;
  }

  // Calls visit(id, how many bits differ), more than once for one that shares several pieces. After make().
  template <class Visit>
  void near(const Descriptor& descriptor, Visit visit) const {
    for (std::size_t p = 0; p < kPieces; ++p)
      for (LandmarkId id = heads_[bucket_of(descriptor, p)]; id != kNone;) {
        const Node& node = nodes_[static_cast<std::size_t>(id)];
        visit(id, hamming(descriptor, node.descriptor));
        id = node.after[p];
      }
  }

 private:
  static constexpr std::size_t kPieces = 16, kPieceBits = 16;

  // In the list of each piece's bucket.
  struct Node {
    std::array<LandmarkId, kPieces> after, before;
    Descriptor descriptor;
    bool known = false;
  };

  void leave(const Node& node, std::size_t piece) {
    const LandmarkId before = node.before[piece], after = node.after[piece];
    if (after != kNone) nodes_[static_cast<std::size_t>(after)].before[piece] = before;
    if (before != kNone)
      nodes_[static_cast<std::size_t>(before)].after[piece] = after;
    else
      heads_[bucket_of(node.descriptor, piece)] = after;
  }

  [[nodiscard]] static std::size_t bucket_of(const Descriptor& descriptor, std::size_t piece) noexcept {
    return piece << kPieceBits | (descriptor.words[piece / 4] >> (kPieceBits * (piece % 4)) & 0xFFFFU);
  }

  std::vector<LandmarkId> heads_;  // first landmark of each bucket; empty: not made
  std::vector<Node> nodes_;        // by landmark
};

}  // namespace sslam
