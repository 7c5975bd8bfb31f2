// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/track/tracking_loss.hpp"

#include "support/catch.hpp"

namespace {

using namespace sslam;

// A frame whose pose is turned by so many degrees against what the Manhattan frame says.
TrackedFrame<double> tracked(double degrees, double sigma_degrees = 0.6) {
  TrackedFrame<double> frame;
  frame.cam_from_world.rotation = SO3<double>::exp({0.2, radians(degrees), -0.1});
  const double variance = radians(sigma_degrees) * radians(sigma_degrees);
  frame.manhattan = {SO3<double>::exp({0.2, 0, -0.1}), variance * Mat3<double>::Identity()};
  return frame;
}

Map<double> map_of(std::size_t keyframes) {
  Map<double> map;
  map.keyframes.resize(keyframes);
  return map;
}

void weigh(TrackingLoss<double>& loss, int frames, double degrees) {
  for (int i = 0; i < frames; ++i) loss.weigh(tracked(degrees));
}

}  // namespace

TEST_CASE("A pose contradicts the Manhattan frame by its angle and by how sure that is") {
  const TrackingLoss<double> loss;
  CHECK_FALSE(loss.contradicts(tracked(4)));
  CHECK(loss.contradicts(tracked(8)));
  CHECK_FALSE(loss.contradicts(tracked(8, 3)));
  TrackedFrame<double> unseen = tracked(8);
  unseen.manhattan.reset();
  CHECK_FALSE(loss.contradicts(unseen));
}

TEST_CASE("A map that is askew for longer than it was square is given up, however old") {
  const Map<double> map = map_of(40);
  TrackingLoss<double> loss;
  weigh(loss, 30, 1);
  weigh(loss, 29, 8);
  CHECK_FALSE(loss.refutes(map));
  weigh(loss, 1, 8);
  CHECK(loss.refutes(map));
}

TEST_CASE("A map is not given up for fewer askew frames than that, or for some here and there") {
  const Map<double> map = map_of(3);
  TrackingLoss<double> loss;
  for (int i = 0; i < 20; ++i) {
    weigh(loss, 14, 8);
    CHECK_FALSE(loss.refutes(map));
    weigh(loss, 1, 1);
  }
}

TEST_CASE("Where one map after the other is askew, each is given twice the time") {
  const Map<double> map = map_of(3);
  TrackingLoss<double> loss;
  for (const int patience : {15, 30, 60}) {
    weigh(loss, patience - 1, 8);
    CHECK_FALSE(loss.refutes(map));
    weigh(loss, 1, 8);
    REQUIRE(loss.refutes(map));
    loss.begin_again();
    CHECK_FALSE(loss.refutes(map));
  }
}

TEST_CASE("A map is undecided while it is young, or while what is seen of the Manhattan frame is little") {
  TrackingLoss<double> loss;
  CHECK(loss.undecided(map_of(2)));
  CHECK_FALSE(loss.undecided(map_of(10)));  // where nothing is seen of one
  weigh(loss, 14, 1);
  CHECK(loss.undecided(map_of(10)));
  weigh(loss, 1, 1);
  CHECK_FALSE(loss.undecided(map_of(10)));
}

TEST_CASE("A given map is never given up") {
  TrackingLoss<double> loss;
  loss.begin_in_given_map();
  weigh(loss, 100, 8);
  Frame<double> frame;
  frame.points.resize(100);
  for (int i = 0; i < 100; ++i) loss.add(frame);
  CHECK_FALSE(loss.refutes(map_of(2)));
}

TEST_CASE("A young map is given up when images that show enough do not fit it") {
  Frame<double> frame;
  TrackingLoss<double> loss;
  for (int i = 0; i < 50; ++i) loss.add(frame);  // a covered lens
  CHECK_FALSE(loss.refutes(map_of(2)));
  frame.points.resize(100);
  for (int i = 0; i < 15; ++i) loss.add(frame);
  CHECK(loss.refutes(map_of(2)));
  CHECK_FALSE(loss.refutes(map_of(10)));
  CHECK(loss.lasts());
  loss.end();
  CHECK_FALSE(loss.refutes(map_of(2)));
  CHECK_FALSE(loss.lasts());
}
