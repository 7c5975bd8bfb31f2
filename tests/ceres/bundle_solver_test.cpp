// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/ceres/bundle_solver.hpp"

#include <cmath>
#include <limits>
#include <vector>

#include "sslam/ceres/global_bundle_adjustment.hpp"
#include "sslam/ceres/local_bundle_adjustment.hpp"
#include "support/catch.hpp"
#include "support/map_errors.hpp"

namespace {

using namespace sslam;
using namespace sslam::testing;

// A graph with every kind of term; whole: of a whole map, else of a window with held keyframes around it.
Map<double> make_map(MapScene& scene, bool whole, bool manhattan, bool planes) {
  Map<double> map = scene.make_map();
  if (planes) scene.add_planes(map);
  perturb(scene, map, whole ? 0 : 5, radians(0.2), 0.01);
  if (!manhattan)
    for (auto& kf : map.keyframes) kf.manhattan.reset();
  return map;
}

}  // namespace

TEST_CASE("Ceres and the core's own solver come to the same optimum") {
  const bool whole = GENERATE(false, true);
  const bool manhattan = GENERATE(false, true);
  MapScene scene({.points = 1200, .lines = 300}, sweep(12, 0.25));
  const bool planes = GENERATE(true, false);
  const Map<double> map = make_map(scene, whole, manhattan, planes);
  BundleWindow<double> window;
  BundleWindowOptions<double> options;
  options.manhattan = manhattan;
  if (whole)
    window.gather_all(map, options);
  else
    window.gather_local(map, 11, options);
  BundleGraph<double> by_ceres = window.graph, by_core = window.graph;
  CeresBundleSolver ceres_solver;
  ceres_solver.options.max_iterations = 100;
  ceres_solver.options.function_tolerance = 1e-12;
  ceres_solver.options.sparse = GENERATE(false, true);
  BundleSolver<double> core_solver;
  core_solver.options.max_iterations = 100;
  core_solver.options.min_decrease = 1e-12;
  REQUIRE(window.graph.planes.empty() != planes);
  const BundleSummary a = ceres_solver.solve(by_ceres), b = core_solver.solve(by_core);
  REQUIRE(improved(a));
  REQUIRE(improved(b));
  INFO("Ceres " << a.initial_cost << " to " << a.final_cost << " in " << a.iterations << ", core "
                << b.initial_cost << " to " << b.final_cost << " in " << b.iterations);
  REQUIRE(within(a.initial_cost, b.initial_cost, 1e-9));
  REQUIRE(within(a.final_cost, b.final_cost, 1e-4));
  for (std::size_t v = 0; v < by_core.views.size(); ++v) {
    const SE3<double>&p = by_ceres.views[v].cam_from_world, &q = by_core.views[v].cam_from_world;
    REQUIRE(angle_between(p.rotation, q.rotation) < radians(0.01));
    REQUIRE((p.inverse().translation - q.inverse().translation).norm() < 1e-3);
  }
  for (std::size_t p = 0; p < by_core.planes.size(); ++p) {
    REQUIRE((by_ceres.planes[p].plane.normal - by_core.planes[p].plane.normal).norm() < 1e-4);
    REQUIRE(std::abs(by_ceres.planes[p].plane.distance - by_core.planes[p].plane.distance) < 1e-3);
  }
}

TEST_CASE("Local and global adjustment with Ceres bring a perturbed map back") {
  MapScene scene({.points = 1200, .lines = 200}, sweep(12, 0.25));
  Map<double> map = scene.make_map();
  Map<double> local = map;
  perturb(scene, local, 5, radians(0.3), 0.02);
  REQUIRE(improved(LocalBundleAdjustment().optimise(local, 11)));
  REQUIRE(measure(scene, local).rotation < 0.1);
  perturb(scene, map, 1, radians(0.3), 0.02);
  const MapErrors before = measure(scene, map);
  GlobalBundleAdjustment global;
  REQUIRE(improved(global.optimise(map)));
  const MapErrors after = measure(scene, map);
  INFO("rotation " << before.rotation << " to " << after.rotation << ", centre " << before.centre << " to "
                   << after.centre);
  REQUIRE(after.rotation < 0.4 * before.rotation);
}

// Ceres orders its blocks by their addresses, so the last digits depend on where they lie: for the same bits
// there is the core's own solver.
TEST_CASE("Ceres gives the same answer again but for rounding") {
  MapScene scene({.points = 600, .lines = 150}, sweep(12, 0.25));
  const Map<double> map = make_map(scene, false, true, true);
  const int threads = GENERATE(1, 2);
  LocalBundleAdjustment used;
  used.solver.options.num_threads = threads;
  Map<double> first = map, second = map, other = map;
  used.optimise(other, 6);
  used.optimise(first, 11);
  LocalBundleAdjustment fresh;
  fresh.solver.options.num_threads = threads;
  fresh.optimise(second, 11);
  const std::vector<double> a = state_of(first), b = state_of(second);
  REQUIRE(a.size() == b.size());
  for (std::size_t i = 0; i < a.size(); ++i) REQUIRE(std::abs(a[i] - b[i]) < 1e-6 * (1 + std::abs(a[i])));
}

TEST_CASE("What Ceres cannot solve leaves the map as it was") {
  MapScene scene({.points = 600, .lines = 100}, sweep(8, 0.25));
  Map<double> map = scene.make_map();
  SECTION("a pose that is not finite") {
    map.keyframes[5].cam_from_world.translation.x() = std::numeric_limits<double>::quiet_NaN();
  }
  SECTION("landmarks that are not finite") {
    for (auto& p : map.points) p.position.y() = std::numeric_limits<double>::quiet_NaN();
    for (auto& l : map.lines) l.line.moment.z() = std::numeric_limits<double>::infinity();
  }
  SECTION("no landmark") {
    for (std::size_t i = 0; i < map.points.size(); ++i) map.erase_point(static_cast<LandmarkId>(i));
    for (std::size_t i = 0; i < map.lines.size(); ++i) map.erase_line(static_cast<LandmarkId>(i));
  }
  SECTION("everything behind the cameras") {
    for (std::size_t i = 0; i < map.lines.size(); ++i) map.erase_line(static_cast<LandmarkId>(i));
    for (auto& p : map.points) p.position.z() -= 20;
  }
  const auto before = state_of(map);
  REQUIRE_FALSE(improved(LocalBundleAdjustment().optimise(map, 7)));
  REQUIRE(same_bits(state_of(map), before));
  REQUIRE_FALSE(improved(GlobalBundleAdjustment().optimise(map)));
  REQUIRE(same_bits(state_of(map), before));
}
