// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/track/loops/loop_evidence.hpp"

#include <vector>

#include "support/catch.hpp"
#include "support/map_scene.hpp"

namespace {

using namespace sslam;
using namespace sslam::testing;

}  // namespace

TEST_CASE("What a view shows of some places lies in a box, widened by the margin") {
  Frame<double> frame;
  frame.pinhole = {500, 500, 320, 240};
  const std::vector<Vec3<double>> places{{0, 0, 2}, {0.4, -0.2, 2}, {0, 0, -1}};
  const auto box = box_around<double>(places, frame, SE3<double>{}, 10);
  CHECK(box.min().isApprox(Vec2<double>(310, 180), 1e-9));
  CHECK(box.max().isApprox(Vec2<double>(430, 250), 1e-9));
  const std::vector<Vec3<double>> behind{{0, 0, -1}};
  CHECK(box_around<double>(behind, frame, SE3<double>{}, 10).isEmpty());
}

TEST_CASE("Points that both sides share count where they stand apart from what closed the loop") {
  MapScene scene{{}, sweep(4)};
  const Map<double> map = scene.make_map();
  const std::vector<KeyframeId> here{3}, there{0};
  const Keyframe<double>& keyframe = map.keyframes[3];
  std::vector<Sighting> known{{3, {}}};
  int shared = 0, left = 0;
  const double middle = keyframe.frame.width / 2.0;
  for (std::size_t i = 0; i < keyframe.point_landmarks.size(); ++i) {
    const LandmarkId id = keyframe.point_landmarks[i];
    const bool both = id != kNone && map.points[map.index(id)].seen_by(0);
    const bool is_left = keyframe.frame.points[i].pixel.x() < middle;
    if (both && is_left) known[0].features.push_back(i);
    shared += both;
    left += both && is_left;
  }
  REQUIRE(left > 10);
  REQUIRE(shared - left > 10);
  const int beside = shared_beside<double>(map, known, here, there, 0.02);  // features are some pixels off
  CHECK(beside > 0);
  CHECK(beside <= shared - left);
  CHECK(shared_beside<double>(map, known, here, there, 1) == 0);  // all lies next to it
  known[0].features.clear();
  CHECK(shared_beside<double>(map, known, here, there, 0) == shared);
}

TEST_CASE("The way between two keyframes goes through all that are left between them") {
  MapScene scene{{}, sweep(5)};
  Map<double> map = scene.make_map();
  const auto centre = [&](std::size_t k) { return map.keyframes[k].cam_from_world.inverse().translation; };
  const double way =
      (centre(2) - centre(1)).norm() + (centre(3) - centre(2)).norm() + (centre(4) - centre(3)).norm();
  CHECK(way_between<double>(map, 1, 4) == Approx(way).epsilon(1e-12));
  CHECK(way_between<double>(map, 4, 1) == way_between<double>(map, 1, 4));
  CHECK(way_between<double>(map, 2, 2) == 0);
}
