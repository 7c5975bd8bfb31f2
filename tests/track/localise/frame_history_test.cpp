// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/track/localise/frame_history.hpp"

#include "support/catch.hpp"

using namespace sslam;

namespace {

void begin(FrameHistory<double>& history, std::int64_t index) {
  Frame<double> frame;
  frame.index = index;
  history.begin(frame);
}

}  // namespace

TEST_CASE("The history holds the frame in hand and the two before it") {
  FrameHistory<double> history;
  for (std::int64_t i = 0; i < 5; ++i) begin(history, i);
  CHECK(history.current().frame.index == 4);
  CHECK(history.last().frame.index == 3);
  CHECK(history.before_last().frame.index == 2);
}

TEST_CASE("A lost frame stands where the last one stood and gives its place to the next") {
  FrameHistory<double> history;
  for (std::int64_t i = 0; i < 3; ++i) begin(history, i);
  history.last().cam_from_world.translation.x() = 7;
  history.lose();
  CHECK(history.current().frame.index == 2);
  CHECK(history.current().cam_from_world.translation.x() == 7);
  begin(history, 3);
  CHECK(history.current().frame.index == 3);
  CHECK(history.last().frame.index == 1);
  CHECK(history.before_last().frame.index == 0);
}

TEST_CASE("A frame leaves the buffers of an older one behind") {
  FrameHistory<double> history;
  Frame<double> frame;
  frame.points.resize(100);
  const auto* const buffer = frame.points.data();
  history.begin(frame);
  for (std::int64_t i = 1; i < 3; ++i) begin(history, i);
  history.begin(frame);
  CHECK(frame.points.data() == buffer);
}
