// SPDX-License-Identifier: BSD-3-Clause
// Two images matched by descriptor alone: the pairs of features that are each other's best match.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "sslam/track/matching/match_points.hpp"

namespace sslam {

// Keeps its buffer from one pair of images to the next.
class MutualMatcher {
 public:
  // Replaces `pairs`. candidates(i, visit) calls visit(j) for the features of b that feature i of a may
  // match. The options say in how many bits the two may differ, and how much better than the second best
  // the best must be.
  template <class Feature, class Options, class Candidates>
  void match(const std::vector<Feature>& a, const std::vector<Feature>& b, const Options& options,
             Candidates candidates, std::vector<IndexPair>& pairs) {
    holders_.assign(b.size(), Holder{});
    for (std::size_t i = 0; i < a.size(); ++i) {
      const auto feature = static_cast<std::int32_t>(i);
      BestTwo two;
      candidates(feature, [&](std::int32_t j) {
        two.offer(hamming(a[i].descriptor, b[static_cast<std::size_t>(j)].descriptor), j);
      });
      if (!two.accepted(options.max_distance, options.max_ratio)) continue;
      Holder& held = holders_[static_cast<std::size_t>(two.index)];
      if (two.best < held.distance) held = {two.best, feature};
    }
    pairs.clear();
    for (std::size_t j = 0; j < holders_.size(); ++j)
      if (holders_[j].feature != kNone) pairs.push_back({holders_[j].feature, static_cast<std::int32_t>(j)});
  }

 private:
  // The feature of a that looks most like one of b.
  struct Holder {
    int distance = std::numeric_limits<int>::max();
    std::int32_t feature = kNone;
  };
  std::vector<Holder> holders_;  // for each feature of b
};

}  // namespace sslam
