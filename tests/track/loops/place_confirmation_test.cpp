// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/track/loops/place_confirmation.hpp"

#include "support/catch.hpp"
#include "support/map_scene.hpp"

namespace {

using namespace sslam;
using namespace sslam::testing;

const Sim3<double> kThereFromHere{SO3<double>::exp({0.1, 1.2, -0.3}), {4, 1, -2}, 0.5};

// A map and a keyframe of another world, in which this one stands as kThereFromHere says.
struct Encounter {
  MapScene scene{{}, sweep(4)};
  Map<double> there = scene.make_map();
  Keyframe<double> keyframe = there.keyframes[1];

  Encounter() { keyframe.cam_from_world = carried(kThereFromHere.inverse(), keyframe.cam_from_world); }

  // What lies between two columns of the image is matched, by a keyframe that is found where the similarity
  // says.
  [[nodiscard]] Loop<double> loop(double left, double right, const Sim3<double>& there_from_here) const {
    const SE3<double>& here = keyframe.cam_from_world;
    Loop<double> loop;
    loop.cam_from_world = Sim3<double>{here.rotation, here.translation, 1} * there_from_here.inverse();
    const auto within = [&](double x) { return x > left && x < right; };
    for (std::size_t i = 0; i < keyframe.frame.points.size(); ++i)
      loop.point_landmarks.push_back(within(keyframe.frame.points[i].pixel.x()) ? keyframe.point_landmarks[i]
                                                                                : kNone);
    for (std::size_t i = 0; i < keyframe.frame.lines.size(); ++i)
      loop.line_landmarks.push_back(
          within(keyframe.frame.lines[i].segment.midpoint().x()) ? keyframe.line_landmarks[i] : kNone);
    return loop;
  }
};

}  // namespace

TEST_CASE("One thing that two maps show is no place, however often it is seen") {
  const Encounter at;
  const PlaceConfirmation<double> check;
  std::optional<PlaceMatch<double>> first;
  for (int i = 0; i < 5; ++i)
    CHECK_FALSE(check.confirmed(at.keyframe, at.there, at.loop(0, 200, kThereFromHere), first));
  CHECK(first.has_value());
}

TEST_CASE("A second thing makes it one if it stands where the first one says") {
  const Encounter at;
  const PlaceConfirmation<double> check;
  const Sim3<double> elsewhere = Sim3<double>{SO3<double>(), {1, 0, 0}, 1} * kThereFromHere;
  for (const bool same : {true, false}) {
    std::optional<PlaceMatch<double>> first;
    CHECK_FALSE(
        check.confirmed(at.keyframe, at.there, at.loop(0, 200, same ? kThereFromHere : elsewhere), first));
    CHECK(check.confirmed(at.keyframe, at.there, at.loop(150, 500, kThereFromHere), first) == same);
    // What contradicts the first place match is a first one itself.
    if (!same) CHECK(check.confirmed(at.keyframe, at.there, at.loop(0, 200, kThereFromHere), first));
  }
}

TEST_CASE("What stands right beside the first thing is part of it") {
  const Encounter at;
  const PlaceConfirmation<double> check;
  std::optional<PlaceMatch<double>> first;
  CHECK_FALSE(check.confirmed(at.keyframe, at.there, at.loop(0, 200, kThereFromHere), first));
  CHECK_FALSE(check.confirmed(at.keyframe, at.there, at.loop(0, 250, kThereFromHere), first));
}
