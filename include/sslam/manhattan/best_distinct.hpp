// SPDX-License-Identifier: BSD-3-Clause
// The best few of many scored items; a predicate decides which items count as the same.
#pragma once

#include <algorithm>
#include <cstddef>

#include "sslam/core/inline_vector.hpp"
#include "sslam/core/types.hpp"

namespace sslam {

template <class Item, Scalar S, std::size_t Capacity, class Same>
class BestDistinct {
 public:
  struct Entry {
    Item item;
    S score = 0;
  };

  // same(a, b): true if the two count as one item.
  explicit BestDistinct(Same same) noexcept : same_(same) {}

  void offer(const Item& item, S score) noexcept {
    if (entries_.full() && !(score > entries_[worst()].score)) return;
    for (Entry& entry : entries_) {
      if (!same_(entry.item, item)) continue;
      if (score > entry.score) entry = {item, score};
      return;
    }
    if (entries_.full())
      entries_[worst()] = {item, score};
    else
      (void)entries_.push_back({item, score});
  }

  [[nodiscard]] std::size_t size() const noexcept { return entries_.size(); }
  [[nodiscard]] const Entry& operator[](std::size_t i) const noexcept { return entries_[i]; }

  // Index of the best one; the list must not be empty.
  [[nodiscard]] std::size_t best() const noexcept {
    std::size_t at = 0;
    for (std::size_t i = 1; i < entries_.size(); ++i) {
      if (entries_[i].score > entries_[at].score) at = i;
    }
    return at;
  }

  // 0 if there is no second one, or its score is negative.
  [[nodiscard]] S second_best_score() const noexcept {
    S second = 0;
    for (std::size_t i = 0; i < entries_.size(); ++i) {
      if (i != best()) second = std::max(second, entries_[i].score);
    }
    return second;
  }

 private:
  [[nodiscard]] std::size_t worst() const noexcept {
    std::size_t at = 0;
    for (std::size_t i = 1; i < entries_.size(); ++i) {
      if (entries_[i].score < entries_[at].score) at = i;
    }
    return at;
  }

  Same same_;
  InlineVector<Entry, Capacity> entries_;
};

}  // namespace sslam
