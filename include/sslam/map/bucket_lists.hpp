// SPDX-License-Identifier: BSD-3-Clause
// Lists of ids, one a bucket, in chunks of seven: whoever goes through a long list waits for memory once a
// chunk, and a short list takes half a cache line (unrolled linked lists).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "sslam/map/free_ids.hpp"

namespace sslam {

class BucketLists {
 public:
  static constexpr std::size_t kChunk = 7;
  using Ids = std::array<LandmarkId, kChunk>;

  // So many empty buckets.
  void assign(std::size_t buckets) {
    clear();
    heads_.assign(buckets, kNone);
  }
  void clear() noexcept {
    heads_.clear();
    chunks_.clear();
    free_ = {};
  }
  [[nodiscard]] bool empty() const noexcept { return heads_.empty(); }

  // Puts the id into the bucket. Returns its slot, by which erase() finds it.
  std::int32_t insert(std::size_t bucket, LandmarkId id) {
    std::int32_t& head = heads_[bucket];
    if (head == kNone || filled(chunk(head)) == kChunk) head = free_.settle(chunks_, Chunk{head});
    const std::size_t lane = filled(chunk(head));
    chunk(head).ids[lane] = id;
    return slot(head, lane);
  }

  // Takes the id in that slot out of its bucket. Another id of the bucket may move into the slot: it is
  // returned, else kNone.
  LandmarkId erase(std::size_t bucket, std::int32_t at) {
    const std::int32_t head = heads_[bucket];
    const std::size_t last = filled(chunk(head)) - 1;  // a chunk that gets empty is freed below
    const LandmarkId moved = chunk(head).ids[last];
    chunk(at / kLanes).ids[static_cast<std::size_t>(at % kLanes)] = moved;
    chunk(head).ids[last] = kNone;
    if (last == 0) {
      heads_[bucket] = chunk(head).next;
      free_.add(head);
    }
    return at == slot(head, last) ? kNone : moved;
  }

  // Calls visit(ids, count) for each chunk of the bucket; the first `count` of the ids are in it.
  template <class Visit>
  void visit(std::size_t bucket, Visit&& visit) const {
    for (std::int32_t c = heads_[bucket]; c != kNone;) {
      const Chunk& chunk = chunks_[static_cast<std::size_t>(c)];
      visit(chunk.ids, filled(chunk));
      c = chunk.next;
    }
  }

 private:
  static constexpr std::int32_t kLanes = 8;
  struct alignas(32) Chunk {
    std::int32_t next = kNone;
    Ids ids = {kNone, kNone, kNone, kNone, kNone, kNone, kNone};  // filled from the front
  };

  [[nodiscard]] static std::size_t filled(const Chunk& chunk) noexcept {
    std::size_t count = kChunk;
    while (count > 0 && chunk.ids[count - 1] == kNone) --count;
    return count;
  }
  [[nodiscard]] static std::int32_t slot(std::int32_t chunk, std::size_t lane) noexcept {
    return chunk * kLanes + static_cast<std::int32_t>(lane);
  }
  [[nodiscard]] Chunk& chunk(std::int32_t at) noexcept { return chunks_[static_cast<std::size_t>(at)]; }

  std::vector<std::int32_t> heads_;  // first chunk of each bucket; only that one may be partly filled
  std::vector<Chunk> chunks_;
  FreeIds free_;  // of chunks
};

}  // namespace sslam
