// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/track/worlds/map_trial.hpp"

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

constexpr double kStep = 1.0 / 30;  // seconds between frames

void weigh(MapTrial<double>& trial, int frames, double degrees, bool held = true, int held_by = 100) {
  for (int i = 0; i < frames; ++i) trial.weigh(tracked(degrees), held, held_by, kStep);
}

}  // namespace

TEST_CASE("A pose contradicts the Manhattan frame by its angle and by how sure that is") {
  const MapTrial<double> trial;
  CHECK_FALSE(trial.contradicts(tracked(4)));
  CHECK(trial.contradicts(tracked(8)));
  CHECK_FALSE(trial.contradicts(tracked(8, 3)));
  TrackedFrame<double> unseen = tracked(8);
  unseen.manhattan.reset();
  CHECK_FALSE(trial.contradicts(unseen));
}

TEST_CASE("A map that is inconsistent for longer than it was square is given up, however old") {
  const Map<double> map = map_of(40);
  MapTrial<double> trial;
  weigh(trial, 30, 1);
  weigh(trial, 29, 8);
  CHECK_FALSE(trial.refutes(map));
  weigh(trial, 1, 8);
  CHECK(trial.refutes(map));
}

TEST_CASE("A map is not given up for fewer inconsistent frames than that, or for some here and there") {
  const Map<double> map = map_of(3);
  MapTrial<double> trial;
  for (int i = 0; i < 20; ++i) {
    weigh(trial, 14, 8);
    CHECK_FALSE(trial.refutes(map));
    weigh(trial, 1, 1);
  }
}

TEST_CASE("A young map that most frames show loose from the Manhattan frame is given up") {
  MapTrial<double> trial;
  weigh(trial, 14, 2, false);
  CHECK_FALSE(trial.refutes(map_of(3)));
  weigh(trial, 1, 2, false);
  CHECK(trial.refutes(map_of(3)));
  CHECK_FALSE(trial.refutes(map_of(10)));  // it has stood the test of time
  trial.begin_again();
  weigh(trial, 29, 2, false);
  CHECK_FALSE(trial.refutes(map_of(3)));
  weigh(trial, 1, 2, false);
  CHECK(trial.refutes(map_of(3)));
}

TEST_CASE("A young map of whose frames a third and more are held by the Manhattan frame stays") {
  const Map<double> map = map_of(3);
  MapTrial<double> trial;
  for (int i = 0; i < 20; ++i) {
    weigh(trial, 8, 2, true);
    weigh(trial, 14, 2, false);
    CHECK_FALSE(trial.refutes(map));
  }
}

TEST_CASE("Where one map after the other is inconsistent, each is given twice the time") {
  const Map<double> map = map_of(3);
  MapTrial<double> trial;
  for (const int patience : {15, 30, 60}) {
    weigh(trial, patience - 1, 8);
    CHECK_FALSE(trial.refutes(map));
    weigh(trial, 1, 8);
    REQUIRE(trial.refutes(map));
    trial.begin_again();
    CHECK_FALSE(trial.refutes(map));
  }
}

TEST_CASE("A map is undecided while it is young, or while what is seen of the Manhattan frame is little") {
  MapTrial<double> trial;
  CHECK(trial.undecided(map_of(2)));
  CHECK_FALSE(trial.undecided(map_of(10)));  // where nothing is seen of one
  weigh(trial, 14, 1);
  CHECK(trial.undecided(map_of(10)));
  weigh(trial, 1, 1);
  CHECK_FALSE(trial.undecided(map_of(10)));
}

TEST_CASE("A given map is never given up") {
  MapTrial<double> trial;
  trial.begin_in_given_map();
  weigh(trial, 100, 8);
  Frame<double> frame;
  frame.points.resize(100);
  for (int i = 0; i < 100; ++i) trial.add_lost(frame, kStep);
  CHECK_FALSE(trial.refutes(map_of(2)));
}

TEST_CASE("A young map is given up when images that show enough do not fit it") {
  Frame<double> frame;
  MapTrial<double> trial;
  for (int i = 0; i < 50; ++i) trial.add_lost(frame, kStep);  // a covered lens
  CHECK_FALSE(trial.refutes(map_of(2)));
  frame.points.resize(100);
  for (int i = 0; i < 15; ++i) trial.add_lost(frame, kStep);
  CHECK(trial.refutes(map_of(2)));
  CHECK_FALSE(trial.refutes(map_of(10)));
  CHECK_FALSE(trial.leaves());
  CHECK(trial.lost());
  trial.end_loss();
  CHECK_FALSE(trial.refutes(map_of(2)));
  CHECK_FALSE(trial.lost());
}

TEST_CASE("Patience is in seconds, whatever the rate of the camera") {
  Frame<double> frame;
  frame.points.resize(100);
  for (const int rate : {5, 10, 30, 60}) {
    MapTrial<double> trial;
    for (int i = 1; i < rate; ++i) trial.add_lost(frame, 1.0 / rate);
    CHECK_FALSE(trial.leaves());
    trial.add_lost(frame, 1.0 / rate);
    CHECK(trial.leaves());
  }
}

TEST_CASE("Poses that hang on little and contradict the Manhattan frame of a square world have drifted") {
  MapTrial<double> trial;
  weigh(trial, 60, 1);
  trial.weigh(tracked(3), true, 20, kStep);  // agrees: what drifts does so after it
  weigh(trial, 7, 8, false, 60);
  CHECK(trial.believes(tracked(8)));
  weigh(trial, 10, 8, false, 60);
  CHECK(trial.believes(tracked(8)));  // 60 landmarks hold each: the walls stand at another angle here
  weigh(trial, 1, 8, false, 40);
  CHECK_FALSE(trial.believes(tracked(8)));
  TrackedFrame<double> unseen = tracked(1);
  unseen.manhattan.reset();
  CHECK_FALSE(trial.believes(unseen));
  CHECK_FALSE(trial.believes(tracked(1, 5)));
  CHECK(trial.believes(tracked(1)));
  trial.drift.end();  // recognised elsewhere
  CHECK(trial.believes(unseen));
}

TEST_CASE("Where the world has not been square for long, or is not, a contradiction says nothing of drift") {
  MapTrial<double> young, oblique;
  weigh(young, 29, 1);
  weigh(young, 10, 8, false, 20);
  CHECK(young.believes(tracked(8)));
  for (int i = 0; i < 20; ++i) {
    weigh(oblique, 9, 1);
    weigh(oblique, 1, 8);
  }
  weigh(oblique, 10, 8, false, 20);
  CHECK(oblique.believes(tracked(8)));
}
