// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/track/meeting.hpp"

#include <algorithm>

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

  // Its landmarks from `first` up to `last` are matched, by a keyframe that is found where the similarity
  // says.
  [[nodiscard]] Loop<double> loop(std::size_t first, std::size_t last,
                                  const Sim3<double>& there_from_here) const {
    const SE3<double>& here = keyframe.cam_from_world;
    Loop<double> loop;
    loop.cam_from_world = Sim3<double>{here.rotation, here.translation, 1} * there_from_here.inverse();
    const auto pick = [&](const std::vector<LandmarkId>& all) {
      std::vector<LandmarkId> some(all.size(), kNone);
      std::copy(all.begin() + static_cast<std::ptrdiff_t>(std::min(first, all.size())),
                all.begin() + static_cast<std::ptrdiff_t>(std::min(last, all.size())),
                some.begin() + static_cast<std::ptrdiff_t>(std::min(first, all.size())));
      return some;
    };
    loop.point_landmarks = pick(keyframe.point_landmarks);
    loop.line_landmarks = pick(keyframe.line_landmarks);
    return loop;
  }
};

}  // namespace

TEST_CASE("One thing that two maps show is no place, however often it is seen") {
  const Encounter at;
  const MeetingCheck<double> check;
  std::optional<Meeting<double>> first;
  for (int i = 0; i < 5; ++i)
    CHECK_FALSE(check.confirmed(at.keyframe, at.there, at.loop(0, 30, kThereFromHere), first));
  CHECK(first.has_value());
}

TEST_CASE("A second thing makes it one if it stands where the first one says") {
  const Encounter at;
  const MeetingCheck<double> check;
  REQUIRE(at.keyframe.point_landmarks.size() > 60);
  const Sim3<double> elsewhere = Sim3<double>{SO3<double>(), {1, 0, 0}, 1} * kThereFromHere;
  for (const bool same : {true, false}) {
    std::optional<Meeting<double>> first;
    CHECK_FALSE(
        check.confirmed(at.keyframe, at.there, at.loop(0, 30, same ? kThereFromHere : elsewhere), first));
    CHECK(check.confirmed(at.keyframe, at.there, at.loop(20, 60, kThereFromHere), first) == same);
    // What contradicts the first meeting is a first one itself.
    if (!same) CHECK(check.confirmed(at.keyframe, at.there, at.loop(0, 30, kThereFromHere), first));
  }
}

TEST_CASE("A few landmarks more do not make a second thing") {
  const Encounter at;
  const MeetingCheck<double> check;
  std::optional<Meeting<double>> first;
  CHECK_FALSE(check.confirmed(at.keyframe, at.there, at.loop(0, 30, kThereFromHere), first));
  CHECK_FALSE(check.confirmed(at.keyframe, at.there, at.loop(3, 33, kThereFromHere), first));
}
