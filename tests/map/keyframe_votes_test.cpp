// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/map/keyframe_votes.hpp"

#include <span>
#include <vector>

#include "support/catch.hpp"

using namespace sslam;

namespace {

using Ids = std::vector<KeyframeId>;

Ids ids(std::span<const KeyframeId> ranked) {
  return {ranked.begin(), ranked.end()};
}

// What of a landmark votes.
struct Seen {
  std::vector<Observation> observations;
};

}  // namespace

TEST_CASE("Keyframes are ranked by their votes, and ties as asked") {
  KeyframeVotes votes;
  votes.begin(6);
  for (const KeyframeId k : {2, 5, 1, 4, 5, 1, 5}) votes.add(k);
  CHECK(ids(votes.ranked(VoteTies::kNewerFirst)) == Ids{5, 1, 4, 2});
  CHECK(ids(votes.ranked(VoteTies::kOlderFirst)) == Ids{5, 1, 2, 4});
  CHECK(votes.of(5) == 3);
  CHECK(votes.of(2) == 1);
  CHECK(votes.of(0) == 0);
}

TEST_CASE("Each landmark of a list votes for the keyframes that observe it") {
  const std::vector<Seen> landmarks{{{{0, 7}, {2, 7}}}, {{{1, 0}}}, {{{2, 3}}}};
  const std::vector<LandmarkId> seen{2, kNone, 0};
  KeyframeVotes votes;
  votes.begin(3);
  votes.add(seen, landmarks);
  CHECK(ids(votes.ranked(VoteTies::kOlderFirst)) == Ids{2, 0});
  votes.add(landmarks[1].observations);
  CHECK(ids(votes.ranked(VoteTies::kOlderFirst)) == Ids{2, 0, 1});
}

TEST_CASE("A new count knows nothing of the one before, though its map was larger") {
  KeyframeVotes votes;
  votes.begin(4);
  votes.add(3);
  votes.add(0);
  votes.begin(2);
  CHECK(votes.ranked(VoteTies::kNewerFirst).empty());
  CHECK(votes.of(0) == 0);
  votes.add(1);
  votes.begin(4);
  votes.add(3);
  CHECK(ids(votes.ranked(VoteTies::kNewerFirst)) == Ids{3});
  CHECK(votes.of(3) == 1);
}
