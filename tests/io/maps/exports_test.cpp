// SPDX-License-Identifier: BSD-3-Clause
// What other programs read: KITTI's rows, and COLMAP's model of a small map with gaps in its ids.
#include <string>
#include <vector>

#include "sslam/io/maps/colmap_writer.hpp"
#include "sslam/io/trajectories/kitti.hpp"
#include "support/catch.hpp"
#include "support/colmap_model.hpp"
#include "support/scratch_folder.hpp"

using namespace sslam;
using namespace sslam::testing;

namespace {

const Vec3<double> kPlaces[] = {{0.2, -0.1, 3}, {-0.4, 0.3, 4}, {0.1, 0.2, 5}, {0.3, 0.3, 4}};

// Sees all places, where `wide` says with a camera of another focal length.
Keyframe<double> keyframe_at(const Vec3<double>& centre, const Vec3<double>& turn, bool wide) {
  Keyframe<double> keyframe;
  keyframe.frame.pinhole = {wide ? 300.0 : 500.0, 500, 319.5, 239.5};
  keyframe.frame.width = 640;
  keyframe.frame.height = 480;
  const SO3<double> rotation = SO3<double>::exp(turn);
  keyframe.cam_from_world = {rotation, -(rotation * centre)};
  for (const auto& place : kPlaces) {
    PointFeature<double> feature;
    feature.pixel = keyframe.frame.pinhole.project(keyframe.cam_from_world * place);
    keyframe.frame.points.push_back(feature);
  }
  return std::move(keyframe).seeing(std::vector<LandmarkId>(std::size(kPlaces), kNone), {});
}

Map<double> small_map() {
  Map<double> map;
  map.add_keyframe(keyframe_at({0, 0, 0}, {0, 0, 0}, false));
  map.add_keyframe(keyframe_at({0.1, 0, 0}, {0, 0.1, 0}, false));
  map.add_keyframe(keyframe_at({0.2, 0.1, -0.1}, {0.05, -0.1, 0.2}, true));
  for (std::size_t i = 0; i < 4; ++i) {
    const LandmarkId id = map.add_point(kPlaces[i], 0);
    map.observe_point(id, 0, i);
    if (i == 3) continue;  // a single view: nothing for COLMAP
    map.observe_point(id, 1, i);
    map.observe_point(id, 2, i);
  }
  map.erase_point(0);
  map.erase_keyframe(1, 0);
  return map;
}

}  // namespace

TEST_CASE("a COLMAP model has what is alive, and its points project to its features") {
  const ScratchFolder scratch;
  const std::vector<std::string> names{"a.png", "b.png", "c.png"};
  const Map<double> map = small_map();
  const io::ColmapCounts counts = io::write_colmap_model(scratch.path(), map, {names});
  CHECK(counts.cameras == 2);
  CHECK(counts.images == 2);
  CHECK(counts.points == 2);
  CHECK(counts.observations == 4);
  const ColmapModel model = read_model(scratch.path());
  REQUIRE(model.cameras.size() == 2);
  REQUIRE(model.images.size() == 2);
  REQUIRE(model.points.size() == 2);
  CHECK(model.images.at(1).name == "a.png");
  CHECK(model.images.at(3).name == "c.png");
  CHECK(model.images.at(1).camera != model.images.at(3).camera);
  CHECK(model.cameras.at(model.images.at(1).camera)[2] == 320);
  CHECK(model.images.at(1).points.at(0).id == -1);  // its point is gone
  CHECK(model.images.at(1).points.at(3).id == -1);  // its point has one view
  for (const auto& [id, point] : model.points) {
    CHECK(point.error < 1e-3);
    REQUIRE(point.track.size() == 2);
    for (const auto& [image, feature] : point.track)
      CHECK(reprojection_error(model, model.images.at(image), point, feature) < 1e-3);
  }
}

TEST_CASE("a COLMAP model of nothing is a model, and one that cannot be written an error") {
  const ScratchFolder scratch;
  CHECK(io::write_colmap_model(scratch.path(), {}, {}).images == 0);
  CHECK(read_model(scratch.path()).images.empty());
  CHECK_THROWS_AS(io::write_colmap_model(scratch.path() / "nowhere", {}, {}), Error);
}

TEST_CASE("KITTI's rows are the upper rows of camera to world") {
  const ScratchFolder scratch;
  const io::StampedPose pose{1341836537.655662,
                             {SO3<double>::exp({0, 0, std::acos(0.0)}), Vec3<double>(1.5, -2, 1e-7)}};
  const io::Trajectory poses{pose, pose};
  io::write_kitti_poses(scratch.path() / "poses.txt", poses);
  io::write_stamps(scratch.path() / "times.txt", io::stamps_of(poses));
  const auto rows = lines_of(scratch.path() / "poses.txt");
  REQUIRE(rows.size() == 2);
  const std::vector<double> wanted{0, -1, 0, 1.5, 1, 0, 0, -2, 0, 0, 1, 1e-7}, got = numbers_of(rows[1]);
  REQUIRE(got.size() == wanted.size());
  for (std::size_t i = 0; i < wanted.size(); ++i) CHECK(got[i] == Approx(wanted[i]).margin(1e-12));
  CHECK(text_of(scratch.path() / "times.txt") == "1341836537.655662\n1341836537.655662\n");
}
