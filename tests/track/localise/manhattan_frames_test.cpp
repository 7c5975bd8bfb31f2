// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/track/localise/manhattan_frames.hpp"

#include "sslam/map/manhattan_axes.hpp"
#include "support/catch.hpp"

namespace {

using namespace sslam;

SO3<double> heading(double degrees) {
  return SO3<double>::exp(Vec3<double>(0, radians(degrees), 0));
}

// The first frame stands along the world's axes and has just been seen.
ManhattanFrames<double> one_frame() {
  ManhattanFrames<double> frames;
  frames.begin();
  frames.see(0, heading(0));
  return frames;
}

// Two frames, the second at 30 degrees about the vertical.
ManhattanFrames<double> two_frames() {
  ManhattanFrames<double> frames = one_frame();
  for (const double seen : {30.3, 29.8, 29.9}) {
    REQUIRE_FALSE(frames.which(heading(seen)));
    frames.see_unknown(heading(seen));
  }
  REQUIRE(frames.world_from_manhattan().size() == 2);
  return frames;
}

}  // namespace

TEST_CASE("Manhattan frames: another one is remembered after enough sightings, as their mean") {
  const ManhattanFrames<double> frames = two_frames();
  CHECK(angle_between(frames.world_from_manhattan()[1], heading(30.0)) < radians(1e-6));
}

TEST_CASE("Manhattan frames: sightings that disagree, or are not in a row, make none") {
  ManhattanFrames<double> frames = one_frame();
  for (const double seen : {30.0, 35.0, 30.0, 25.0, 30.0, 35.0})
    CHECK_FALSE(frames.see_unknown(heading(seen)));
  for (int i = 0; i < 6; ++i) {
    CHECK_FALSE(frames.see_unknown(heading(30)));
    if (i % 2 == 1) frames.see_nothing();
  }
  CHECK(frames.world_from_manhattan().size() == 1);
}

TEST_CASE("Manhattan frames: each is known again, whatever its axes are called") {
  const ManhattanFrames<double> frames = two_frames();
  CHECK(frames.which(heading(2)) == std::size_t{0});
  CHECK(frames.which(heading(92)) == std::size_t{0});
  CHECK(frames.which(heading(27)) == std::size_t{1});
  CHECK(frames.which(heading(-63)) == std::size_t{1});
  CHECK_FALSE(frames.which(heading(60)));
}

TEST_CASE("Manhattan frames: one that turns slowly stays what it is, one that jumps does not") {
  ManhattanFrames<double> frames = one_frame();
  for (double turned = 0; turned < 25; turned += 1) {
    REQUIRE(frames.which(heading(turned)) == std::size_t{0});
    frames.see(0, heading(turned));
  }
  CHECK(frames.which(heading(24.5)) == std::size_t{0});
  frames.see_nothing();
  CHECK(frames.which(heading(28)) == std::size_t{0});  // the poses have turned, not the room
}

TEST_CASE("Manhattan frames: a shared axis has one number") {
  const std::vector<SO3<double>> frames = two_frames().world_from_manhattan();
  for (std::int8_t axis = 0; axis < 3; ++axis) CHECK(axis_number(frames, 0, axis) == axis);
  CHECK(axis_number(frames, 1, 0) == 3);
  CHECK(axis_number(frames, 1, 1) == 1);  // the vertical
  CHECK(axis_number(frames, 1, 2) == 5);
  CHECK(axis_number(frames, 1, kNone) == kNone);
}

TEST_CASE("Manhattan frames: no more than wanted are remembered, and of one all are the first") {
  ManhattanFrames<double> frames = one_frame();
  frames.most = 2;
  for (const double direction : {30.0, 60.0})
    for (int i = 0; i < 3; ++i) frames.see_unknown(heading(direction));
  CHECK(frames.world_from_manhattan().size() == 2);
  ManhattanFrames<double> one = one_frame();
  one.most = 1;
  CHECK(one.which(heading(45)) == std::size_t{0});
}
