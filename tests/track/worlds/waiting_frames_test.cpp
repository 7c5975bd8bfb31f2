// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/track/worlds/waiting_frames.hpp"

#include "support/catch.hpp"

using namespace sslam;

namespace {

void add(WaitingFrames<double>& waiting, int index, std::size_t most) {
  TrackedFrame<double> frame;
  frame.frame.index = index;
  frame.frame.points.resize(static_cast<std::size_t>(index));
  waiting.add(frame, index % 2 == 0, most);
}

std::vector<std::int64_t> indices(WaitingFrames<double>& waiting) {
  std::vector<std::int64_t> found;
  for (std::ptrdiff_t i = 0; i < waiting.size(); ++i) {
    found.push_back(waiting[i].frame.frame.index);
    CHECK(waiting[i].frame.frame.points.size() == static_cast<std::size_t>(found.back()));
    CHECK(waiting[i].placed == (found.back() % 2 == 0));
  }
  return found;
}

}  // namespace

TEST_CASE("The last frames wait in the order in which they came") {
  WaitingFrames<double> waiting;
  CHECK(waiting.size() == 0);
  for (int i = 1; i <= 7; ++i) add(waiting, i, 4);
  CHECK(indices(waiting) == std::vector<std::int64_t>{4, 5, 6, 7});
}

TEST_CASE("More or fewer may wait later") {
  WaitingFrames<double> waiting;
  for (int i = 1; i <= 5; ++i) add(waiting, i, 3);
  for (int i = 6; i <= 7; ++i) add(waiting, i, 5);
  CHECK(indices(waiting) == std::vector<std::int64_t>{3, 4, 5, 6, 7});
  add(waiting, 8, 2);
  CHECK(indices(waiting) == std::vector<std::int64_t>{7, 8});
}

TEST_CASE("Cleared frames leave their buffers to those that come after") {
  WaitingFrames<double> waiting;
  add(waiting, 100, 2);
  const auto* buffer = waiting[0].frame.frame.points.data();
  waiting.clear();
  CHECK(waiting.size() == 0);
  add(waiting, 50, 2);
  CHECK(indices(waiting) == std::vector<std::int64_t>{50});
  CHECK(waiting[0].frame.frame.points.data() == buffer);
}
