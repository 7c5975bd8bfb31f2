// SPDX-License-Identifier: BSD-3-Clause
// Lists of ids, one a bucket, in chunks of seven: whoever goes through a long list waits for memory once a
// chunk, and a short list takes half a cache line (unrolled linked lists).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace sslam {

class BucketLists {
 public:
  static constexpr std::int32_t kNothing = -1;
  static constexpr std::size_t kChunk = 7;
  using Ids = std::array<std::int32_t, kChunk>;

  // So many empty buckets.
  void assign(std::size_t buckets) {
    clear();
    heads_.assign(buckets, kNothing);
  }
  void clear() noexcept {
    heads_.clear();
    chunks_.clear();
    free_ = kNothing;
  }
  [[nodiscard]] bool empty() const noexcept { return heads_.empty(); }

  // Puts the id into the bucket. Returns its slot, by which erase() finds it.
  std::int32_t insert(std::size_t bucket, std::int32_t id) {
    std::int32_t& head = heads_[bucket];
    if (head == kNothing || filled(chunk(head)) == kChunk) head = new_chunk(head);
    const std::size_t lane = filled(chunk(head));
    chunk(head).ids[lane] = id;
    return slot(head, lane);
  }

  // Takes the id in that slot out of its bucket. Another id of the bucket may move into the slot: it is
  // returned, else kNothing.
  std::int32_t erase(std::size_t bucket, std::int32_t at) {
    const std::int32_t head = heads_[bucket];
    const std::size_t last = filled(chunk(head)) - 1;  // a chunk that gets empty is freed below
    const std::int32_t moved = chunk(head).ids[last];
    chunk(at / kLanes).ids[static_cast<std::size_t>(at % kLanes)] = moved;
    chunk(head).ids[last] = kNothing;
    if (last == 0) {
      heads_[bucket] = chunk(head).next;
      chunk(head).next = free_;
      free_ = head;
    }
    return at == slot(head, last) ? kNothing : moved;
  }

  // Calls visit(ids, count) for each chunk of the bucket; the first `count` of the ids are in it.
  template <class Visit>
  void visit(std::size_t bucket, Visit&& visit) const {
    for (std::int32_t c = heads_[bucket]; c != kNothing;) {
      const Chunk& chunk = chunks_[static_cast<std::size_t>(c)];
      visit(chunk.ids, filled(chunk));
      c = chunk.next;
    }
  }

 private:
  static constexpr std::int32_t kLanes = 8;
  struct alignas(32) Chunk {
    std::int32_t next = kNothing;
    Ids ids = {kNothing, kNothing, kNothing, kNothing,
               kNothing, kNothing, kNothing};  // filled from the front
  };

  [[nodiscard]] static std::size_t filled(const Chunk& chunk) noexcept {
    std::size_t count = kChunk;
    while (count > 0 && chunk.ids[count - 1] == kNothing) --count;
    return count;
  }
  [[nodiscard]] static std::int32_t slot(std::int32_t chunk, std::size_t lane) noexcept {
    return chunk * kLanes + static_cast<std::int32_t>(lane);
  }
  [[nodiscard]] Chunk& chunk(std::int32_t at) noexcept { return chunks_[static_cast<std::size_t>(at)]; }

  std::int32_t new_chunk(std::int32_t next) {
    std::int32_t at = free_;
    if (at != kNothing) {
      free_ = chunk(at).next;
    } else {
      at = static_cast<std::int32_t>(chunks_.size());
      chunks_.emplace_back();
    }
    chunk(at).next = next;
    return at;
  }

  std::vector<std::int32_t> heads_;  // first chunk of each bucket; only that one may be partly filled
  std::vector<Chunk> chunks_;
  std::int32_t free_ = kNothing;  // first of the free chunks
};

}  // namespace sslam
