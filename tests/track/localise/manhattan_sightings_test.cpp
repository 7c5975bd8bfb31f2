// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/track/localise/manhattan_sightings.hpp"

#include <optional>
#include <vector>

#include "sslam/map/manhattan_axes.hpp"
#include "support/catch.hpp"

namespace {

using namespace sslam;

SO3<double> heading(double degrees) {
  return SO3<double>::exp(Vec3<double>(0, radians(degrees), 0));
}

// The frames of a world, and what has been seen of them.
struct KnownFrames {
  std::vector<SO3<double>> known;
  ManhattanSightings<double> sightings;

  [[nodiscard]] std::optional<std::size_t> which(double seen) const {
    return sightings.which(known, heading(seen));
  }
  void see(std::size_t index, double seen) { sightings.see(index, known[index], heading(seen)); }
  // True if that makes it known.
  bool see_unknown(double seen) {
    const auto found = sightings.see_unknown(known.size(), heading(seen));
    if (found) known.push_back(*found);
    return found.has_value();
  }
};

// The first frame stands along the world's axes and has just been seen.
KnownFrames one_frame() {
  KnownFrames frames{{SO3<double>()}, {}};
  frames.see(0, 0);
  return frames;
}

// Two frames, the second at 30 degrees about the vertical.
KnownFrames two_frames() {
  KnownFrames frames = one_frame();
  for (const double seen : {30.3, 29.8, 29.9}) {
    REQUIRE_FALSE(frames.which(seen));
    frames.see_unknown(seen);
  }
  REQUIRE(frames.known.size() == 2);
  return frames;
}

}  // namespace

TEST_CASE("Manhattan frames: another one is remembered after enough sightings, as their mean") {
  const KnownFrames frames = two_frames();
  CHECK(angle_between(frames.known[1], heading(30.0)) < radians(1e-6));
}

TEST_CASE("Manhattan frames: sightings that disagree, or are not in a row, make none") {
  KnownFrames frames = one_frame();
  for (const double seen : {30.0, 35.0, 30.0, 25.0, 30.0, 35.0}) CHECK_FALSE(frames.see_unknown(seen));
  for (int i = 0; i < 6; ++i) {
    CHECK_FALSE(frames.see_unknown(30));
    if (i % 2 == 1) frames.sightings.see_nothing();
  }
  CHECK(frames.known.size() == 1);
}

TEST_CASE("Manhattan frames: each is known again, whatever its axes are called") {
  const KnownFrames frames = two_frames();
  CHECK(frames.which(2) == std::size_t{0});
  CHECK(frames.which(92) == std::size_t{0});
  CHECK(frames.which(27) == std::size_t{1});
  CHECK(frames.which(-63) == std::size_t{1});
  CHECK_FALSE(frames.which(60));
}

TEST_CASE("Manhattan frames: one that turns slowly stays what it is, one that jumps does not") {
  KnownFrames frames = one_frame();
  for (double turned = 0; turned < 25; turned += 1) {
    REQUIRE(frames.which(turned) == std::size_t{0});
    frames.see(0, turned);
  }
  CHECK(frames.which(24.5) == std::size_t{0});
  frames.sightings.see_nothing();
  CHECK(frames.which(28) == std::size_t{0});  // the poses have turned, not the room
}

TEST_CASE("Manhattan frames: a shared axis has one number") {
  const std::vector<SO3<double>> known = two_frames().known;
  for (std::int8_t axis = 0; axis < 3; ++axis) CHECK(axis_number(known, 0, axis) == axis);
  CHECK(axis_number(known, 1, 0) == 3);
  CHECK(axis_number(known, 1, 1) == 1);  // the vertical
  CHECK(axis_number(known, 1, 2) == 5);
  CHECK(axis_number(known, 1, kNone) == kNone);
}

TEST_CASE("Manhattan frames: no more than wanted are remembered, and of one all are the first") {
  KnownFrames frames = one_frame();
  frames.sightings.options.most = 2;
  for (const double direction : {30.0, 60.0})
    for (int i = 0; i < 3; ++i) frames.see_unknown(direction);
  CHECK(frames.known.size() == 2);
  KnownFrames one = one_frame();
  one.sightings.options.most = 1;
  CHECK(one.which(45) == std::size_t{0});
}
