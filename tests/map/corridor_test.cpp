// SPDX-License-Identifier: BSD-3-Clause
// A walk down a corridor, mapped keyframe by keyframe: how much of the drift do the structural terms take
// away?
#include "sslam/map/map_adjustment.hpp"
#include "support/catch.hpp"
#include "support/map_errors.hpp"

namespace {

using namespace sslam;
using namespace sslam::testing;

struct Walk {
  MapErrors errors;
  double last_rotation = 0;  // of the last keyframe, degrees
};

// Every keyframe starts from the one before it with some error, and landmarks from the keyframe that first
// sees them.
Walk walk(bool manhattan, std::uint64_t seed) {
  MapSceneOptions options;
  options.seed = seed;
  options.half = {1.2, 1.3, 16};
  options.points = 700;
  options.lines = 250;
  options.farthest = 5;
  options.rotation_noise = radians(0.3);
  std::vector<SE3<double>> path;
  for (int k = 0; k < 60; ++k)
    path.push_back(
        look({0.1 * std::sin(0.4 * k), 0.03 * std::cos(0.9 * k), -14 + 0.4 * k}, 0.15 * std::sin(0.3 * k)));
  MapScene scene(options, path);
  Map<double> map = scene.make_landmarks();
  std::vector<bool> known_points(map.points.size(), false), known_lines(map.lines.size(), false);
  MapAdjustment<double> adjustment;
  adjustment.window_options.manhattan = manhattan;
  for (std::size_t k = 0; k < path.size(); ++k) {
    SE3<double> believed = path[k];
    if (k > 0) {
      Vec6<double> xi;
      xi << gaussian_vector<3>(scene.random()) * radians(0.1), gaussian_vector<3>(scene.random()) * 0.005;
      believed = SE3<double>::exp(xi) * path[k] * path[k - 1].inverse() * map.keyframes[k - 1].cam_from_world;
    }
    const Keyframe<double> kf = scene.make_keyframe(k, believed);
    const SE3<double> world_from_truth = believed.inverse() * path[k];
    for (const LandmarkId id : kf.point_landmarks)
      if (const auto i = map.index(id); !known_points[i]) {
        const Vec3<double> in_camera = path[k] * scene.points[i] * (1 + 0.03 * gaussian(scene.random()));
        map.points[i].position = believed.inverse() * in_camera;
        known_points[i] = true;
      }
    for (const LandmarkId id : kf.line_landmarks)
      if (const auto i = map.index(id); !known_lines[i]) {
        map.lines[i].line = transform(world_from_truth, map.lines[i].line);
        map.lines[i].start = world_from_truth * map.lines[i].start;
        map.lines[i].end = world_from_truth * map.lines[i].end;
        known_lines[i] = true;
      }
    const KeyframeId id = map.add_keyframe(kf);
    if (k > 0) adjustment.optimise(map, id);
  }
  Walk out;
  out.errors = measure(scene, map);
  const SE3<double>& last = map.keyframes.back().cam_from_world;
  out.last_rotation = degrees(angle_between(last.rotation, path.back().rotation));
  return out;
}

}  // namespace

TEST_CASE("Structural terms take the drift out of the rotation") {
  double drift[2] = {0, 0};  // without and with structure: the mean over the walks, degrees
  constexpr int kWalks = 4;
  for (std::uint64_t seed = 1; seed <= kWalks; ++seed) {
    const Walk without = walk(false, seed), with = walk(true, seed);
    INFO("seed " << seed << ": rotation " << without.errors.rotation << " and with structure "
                 << with.errors.rotation << " deg, last " << without.last_rotation << " and "
                 << with.last_rotation);
    CHECK(with.errors.rotation < 0.25);
    CHECK(with.last_rotation < 0.4);
    drift[0] += without.last_rotation / kWalks;
    drift[1] += with.last_rotation / kWalks;
  }
  CHECK(drift[1] < 0.5 * drift[0]);
}
