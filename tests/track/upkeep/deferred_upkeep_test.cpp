// SPDX-License-Identifier: BSD-3-Clause
// The exchange between a tracker and a map that is kept elsewhere, in every order in which it can go.
#include "sslam/track/upkeep/deferred_upkeep.hpp"

#include <functional>
#include <vector>

#include "sslam/map/map_deformation.hpp"
#include "support/catch.hpp"
#include "track/upkeep/step_channel.hpp"

namespace {

using namespace sslam;
using namespace sslam::testing;

constexpr std::size_t kFeatures = 6;

SE3<double> at(double x) {
  return {SO3<double>(), Vec3<double>(-x, 0, 0)};
}

double place(const SE3<double>& cam_from_world) {
  return cam_from_world.inverse().translation.x();
}

TrackedFrame<double> frame_at(double x) {
  TrackedFrame<double> frame;
  frame.frame.points.resize(kFeatures);
  frame.forget_matches();
  frame.cam_from_world = at(x);
  return frame;
}

// Two keyframes, at 0 and 1, that see landmarks 0 to 3 as their features 0 to 3.
Map<double> first_map() {
  Map<double> map;
  map.add_keyframe(frame_at(0).to_keyframe());
  map.add_keyframe(frame_at(1).to_keyframe());
  for (std::size_t i = 0; i < 4; ++i) {
    const LandmarkId id = map.add_point({double(i), 0, 5}, 1);
    for (const KeyframeId k : {0, 1}) map.observe_point(id, k, i);
  }
  return map;
}

// Takes the frame in, and does what the test says.
struct ScriptedMapping {
  std::function<void(Map<double>&, KeyframeId)> then = [](Map<double>&, KeyframeId) {};
  double depth = 0;

  KeyframeId insert(Map<double>& map, TrackedFrame<double>& frame, double median_depth) {
    depth = median_depth;
    const KeyframeId id = map.add_keyframe(frame.to_keyframe());
    then(map, id);
    return id;
  }
  void begin(Map<double>&, TrackedFrame<double>&, double) {}
};

// Makes the world around the keyframes from `first` on larger, when the test says so.
struct ScriptedLoops {
  double scale = 1;  // of the next loop; 1: none is found
  KeyframeId first = 1;
  std::vector<Sim3<double>> new_from_old;

  LoopAnswer<double> close(Map<double>& map, KeyframeId) {
    if (scale == 1) return {};
    new_from_old.assign(map.keyframes.size(), {});
    for (std::size_t k = map.index(first); k < new_from_old.size(); ++k) new_from_old[k].scale = scale;
    scale = 1;
    deform<double>(map, new_from_old);
    return {true, new_from_old};
  }
};

struct Exchange {
  Map<double> map = first_map();  // the tracker's
  ScriptedMapping mapping;
  ScriptedLoops loops;
  DeferredUpkeep<double, StepChannel> upkeep;

  KeyframeId insert(TrackedFrame<double>& frame, KeyframeId reference, double depth = 5) {
    return upkeep.insert(map, frame, reference, depth, mapping, loops);
  }
  bool step() { return upkeep.channel.step(); }
  const MapChange<double>& renew() {
    const MapChange<double>* change = upkeep.renew(map);
    REQUIRE(change != nullptr);
    return *change;
  }
};

}  // namespace

TEST_CASE("A posted keyframe stands in the tracker's map at once and in the kept one later") {
  Exchange x;
  TrackedFrame<double> frame = frame_at(2);
  frame.point_landmarks[0] = 3;
  REQUIRE(x.insert(frame, 1) == 2);
  REQUIRE(x.map.keyframes.size() == 3);
  REQUIRE(x.map.points[3].observations.size() == 3);
  REQUIRE(x.upkeep.renew(x.map) == nullptr);  // nobody has worked yet
  x.mapping.then = [](Map<double>& map, KeyframeId id) {
    map.observe_point(map.add_point({9, 0, 5}, id), id, 5);
  };
  REQUIRE(x.step());
  const MapChange<double>& change = x.renew();
  REQUIRE_FALSE(change.loop_closed);
  REQUIRE(x.map.keyframes.size() == 3);
  REQUIRE(x.map.keyframes[2].point_landmarks == std::vector<LandmarkId>{3, kNone, kNone, kNone, kNone, 4});
  REQUIRE(x.upkeep.renew(x.map) == nullptr);  // it has been taken
}

TEST_CASE("Keyframes that a snapshot does not have yet may see the same landmark") {
  Exchange x;
  for (const KeyframeId id : {2, 3, 4}) {
    TrackedFrame<double> frame = frame_at(id);
    frame.point_landmarks[0] = 0;
    REQUIRE(x.insert(frame, id - 1) == id);
  }
  REQUIRE(x.step());  // the snapshot has one of the three
  (void)x.renew();
  REQUIRE(x.map.keyframes.size() == 5);
  for (const KeyframeId id : {2, 3, 4}) {
    const auto& neighbours = x.map.keyframes[x.map.index(id)].neighbours;
    REQUIRE(neighbours.size() == 4);
    for (const Neighbour& n : neighbours) REQUIRE((n.keyframe != id && n.keyframe >= 0 && n.keyframe < 5));
  }
}

TEST_CASE("Keyframes that a snapshot does not have yet are added to it and stand by their references") {
  Exchange x;
  TrackedFrame<double> second = frame_at(2), third = frame_at(3), in_hand = frame_at(3.5);
  REQUIRE(x.insert(second, 1) == 2);
  REQUIRE(x.insert(third, 2) == 3);
  // Adjustment moves keyframe 2 by 0.25 when it comes in; what hangs on it follows.
  x.mapping.then = [](Map<double>& map, KeyframeId id) {
    map.keyframes[map.index(id)].cam_from_world = at(2.25);
  };
  REQUIRE(x.step());
  const MapChange<double>& change = x.renew();
  REQUIRE(x.map.keyframes.size() == 4);
  REQUIRE(place(x.map.pose(2)) == Approx(2.25));
  REQUIRE(place(x.map.pose(3)) == Approx(3.25));
  change.carry(3, in_hand);
  REQUIRE(place(in_hand.cam_from_world) == Approx(3.75));
  // The post of keyframe 3 was written before that, and arrives where it belongs.
  x.mapping.then = [](Map<double>&, KeyframeId) {};
  REQUIRE(x.step());
  x.renew();
  REQUIRE(x.map.keyframes.size() == 4);
  REQUIRE(place(x.map.pose(3)) == Approx(3.25));
}

TEST_CASE("An id that was given to another landmark is nobody's match any more") {
  Exchange x;
  TrackedFrame<double> second = frame_at(2), third = frame_at(3), in_hand = frame_at(3.5);
  for (TrackedFrame<double>* frame : {&second, &third, &in_hand}) {
    frame->point_landmarks[0] = 0;
    frame->point_landmarks[1] = 1;
    frame->point_landmarks[2] = 2;
  }
  // Landmark 0 is erased and its id given away; landmark 1 is erased.
  x.mapping.then = [](Map<double>& map, KeyframeId id) {
    map.erase_point(0);
    map.observe_point(map.add_point({7, 0, 5}, id), id, 5);
    map.erase_point(1);
  };
  REQUIRE(x.insert(second, 1) == 2);
  REQUIRE(x.insert(third, 2) == 3);
  ++x.map.points[0].visible;
  ++x.map.points[2].visible;
  REQUIRE(x.step());
  x.mapping.then = [](Map<double>&, KeyframeId) {};
  const std::vector<LandmarkId> left{kNone, kNone, 2, kNone, kNone, kNone};
  x.renew().carry(3, in_hand);
  REQUIRE(x.map.points[0].alive);
  REQUIRE(x.map.points[0].position.x() == 7);
  REQUIRE(in_hand.point_landmarks == left);
  REQUIRE(x.map.keyframes[3].point_landmarks == left);
  REQUIRE(x.map.points[0].visible == 0);  // the sighting was the old landmark's
  REQUIRE(x.map.points[2].visible == 1);
  // The post that was under way loses them too.
  REQUIRE(x.step());
  x.renew();
  REQUIRE(x.map.keyframes[3].point_landmarks == left);
  REQUIRE(x.map.points[0].observations.size() == 1);
  REQUIRE(x.map.points[2].observations.size() == 4);
}

TEST_CASE("Sightings are told once each and the last map has them all") {
  Exchange x;
  x.map.points[2].visible = 10;
  x.map.points[2].found = 8;
  TrackedFrame<double> second = frame_at(2), third = frame_at(3);
  REQUIRE(x.insert(second, 1) == 2);
  x.map.points[2].visible += 3;
  x.map.points[2].found += 2;
  REQUIRE(x.insert(third, 2) == 3);
  x.map.points[2].visible += 1;
  REQUIRE(x.step());
  x.renew();
  x.map.points[2].visible += 1;
  REQUIRE(x.upkeep.finish(x.map) != nullptr);
  REQUIRE(x.map.points[2].visible == 15);
  REQUIRE(x.map.points[2].found == 10);
  REQUIRE(x.map.keyframes.size() == 4);
  REQUIRE(x.upkeep.finish(x.map) == nullptr);
}

TEST_CASE("No keyframe is made where there is no room for it") {
  Exchange x;
  x.upkeep.channel.max_waiting = 1;
  TrackedFrame<double> frame = frame_at(2);
  REQUIRE(x.insert(frame, 1) == 2);
  REQUIRE(x.insert(frame, 2) == kNone);
  REQUIRE(x.map.keyframes.size() == 3);
  REQUIRE(x.upkeep.refused() == 1);
  REQUIRE(x.step());
  REQUIRE(x.insert(frame, 2) == 3);
}

TEST_CASE("A loop that closes between a post and its arrival scales what hangs on the world that moved") {
  Exchange x;
  TrackedFrame<double> second = frame_at(2), third = frame_at(3), in_hand = frame_at(4);
  REQUIRE(x.insert(second, 1) == 2);
  REQUIRE(x.insert(third, 2, 5) == 3);
  x.loops.scale = 2;  // as keyframe 2 comes in: 1 and 2 go to 2 and 4
  REQUIRE(x.step());
  const MapChange<double>& change = x.renew();
  REQUIRE(change.loop_closed);
  REQUIRE(change.scale_at(0) == 1);
  REQUIRE(change.scale_at(1) == 2);
  REQUIRE(change.scale_at(3) == 2);
  REQUIRE(place(x.map.pose(2)) == Approx(4));
  REQUIRE(place(x.map.pose(3)) == Approx(6));
  change.carry(3, in_hand);
  REQUIRE(place(in_hand.cam_from_world) == Approx(8));
  // A keyframe in the new lengths waits behind one in the old ones, and another loop closes between them.
  TrackedFrame<double> fourth = frame_at(8);
  REQUIRE(x.insert(fourth, 3, 10) == 4);
  x.loops.scale = 0.5;
  REQUIRE(x.step());
  REQUIRE(x.mapping.depth == Approx(10));  // 5 of the first lengths
  REQUIRE(x.step());
  REQUIRE(x.mapping.depth == Approx(5));
  const MapChange<double>& second_change = x.renew();
  REQUIRE(second_change.scale_at(3) == 0.5);
  REQUIRE(second_change.scale_at(4) == 0.5);
  REQUIRE(place(x.map.pose(3)) == Approx(3));
  REQUIRE(place(x.map.pose(4)) == Approx(4));
}

TEST_CASE("What hangs on a keyframe that was removed stays where it is") {
  Exchange x;
  TrackedFrame<double> second = frame_at(2), third = frame_at(3), in_hand = frame_at(2.5);
  REQUIRE(x.insert(second, 1) == 2);
  REQUIRE(x.insert(third, 2) == 3);
  x.mapping.then = [](Map<double>& map, KeyframeId id) { map.erase_keyframe(id, 1); };
  REQUIRE(x.step());
  x.renew().carry(2, in_hand);
  REQUIRE(x.map.surviving(2) == 1);
  REQUIRE(place(in_hand.cam_from_world) == Approx(2.5));
  REQUIRE(place(x.map.pose(3)) == Approx(3));
}

TEST_CASE("A map that was given up leaves nothing to the next one") {
  Exchange x;
  TrackedFrame<double> frame = frame_at(2);
  REQUIRE(x.insert(frame, 1) == 2);
  REQUIRE(x.step());
  x.upkeep.forget();
  x.map = first_map();
  REQUIRE(x.upkeep.renew(x.map) == nullptr);
  REQUIRE(x.insert(frame, 1) == 2);
  REQUIRE(x.upkeep.renew(x.map) == nullptr);
  REQUIRE(x.step());
  x.renew();
  REQUIRE(x.map.keyframes.size() == 3);
}
