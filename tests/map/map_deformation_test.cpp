// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/map/map_deformation.hpp"

#include "sslam/map/bundle_window.hpp"
#include "sslam/solver/bundle/bundle_solver.hpp"
#include "support/catch.hpp"
#include "support/map_scene.hpp"

namespace {

using namespace sslam;
using namespace sslam::testing;

double cost_of(const Map<double>& map) {
  BundleWindow<double> window;
  BundleWindowOptions<double> options;
  options.manhattan = false;
  window.gather_all(map, options);
  return BundleSolver<double>().solve(window.graph).initial_cost;
}

Sim3<double> some_similarity() {
  Vec<double, 7> xi;
  xi << 0.2, -0.1, 0.3, 1, 2, -0.5, 0.4;
  return Sim3<double>::exp(xi);
}

}  // namespace

TEST_CASE("A map that moves as a whole looks the same from its keyframes") {
  MapScene scene({.points = 400, .lines = 100}, sweep(8));
  Map<double> map = scene.make_map();
  const double before = cost_of(map);
  const double extent = map.points[0].extent;
  std::vector<Sim3<double>> moves(map.keyframes.size(), some_similarity());
  deform<double>(map, moves);
  CHECK(cost_of(map) == Approx(before).epsilon(1e-9));
  CHECK(map.points[0].extent == Approx(extent * some_similarity().scale));
  for (const auto& line : map.lines)
    if (line.alive) CHECK((line.line.point_closest_to(line.start) - line.start).norm() < 1e-9);
  const Vec3<double> centre = scene.poses[3].inverse().translation;
  CHECK((map.keyframes[3].cam_from_world.inverse().translation - some_similarity() * centre).norm() < 1e-9);
}

TEST_CASE("Where a removed keyframe stood moves with its parent, distances to scale") {
  MapScene scene({.points = 400, .lines = 100}, sweep(8));
  Map<double> map = scene.make_map();
  map.erase_keyframe(4, 5);
  map.erase_keyframe(5, 6);
  const SE3<double> before = map.pose(4).inverse();
  std::vector<Sim3<double>> moves(map.keyframes.size());
  moves[6] = some_similarity();
  deform<double>(map, moves);
  CHECK((map.pose(4).inverse().translation - some_similarity() * before.translation).norm() < 1e-9);
  CHECK(moves[4].scale == some_similarity().scale);
  CHECK((map.pose(3).inverse().translation - scene.poses[3].inverse().translation).norm() < 1e-12);
}
