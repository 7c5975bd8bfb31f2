// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/map/plane_ties.hpp"

#include <cmath>
#include <vector>

#include "sslam/map/map_adjustment.hpp"
#include "sslam/map/map_deformation.hpp"
#include "support/catch.hpp"
#include "support/map_errors.hpp"

namespace {

using namespace sslam;
using namespace sslam::testing;

MapScene make_scene() {
  return MapScene({.points = 1200, .lines = 200}, sweep(12, 0.25));
}

// Root mean square distance of the members from the planes that they truly lie on.
double flatness(const MapScene& scene, const Map<double>& map) {
  double sum = 0;
  int count = 0;
  for (std::size_t i = 0; i < map.points.size(); ++i) {
    if (!map.points[i].alive || map.points[i].plane == kNone) continue;
    const PlaneLandmark<double>& plane = map.planes[map.index(map.points[i].plane)];
    sum += std::pow(map.points[i].position[plane.axis] - scene.points[i][plane.axis], 2);
    ++count;
  }
  return std::sqrt(sum / count);
}

}  // namespace

TEST_CASE("Ties to planes make a map more accurate and bring shifted planes back") {
  MapScene scene = make_scene();
  Map<double> tied = scene.make_map();
  scene.add_planes(tied);
  perturb(scene, tied, 3, radians(0.2), 0.01);
  Map<double> free = tied;
  for (auto& plane : tied.planes) plane.plane = plane.plane.retract({0.01, -0.01, 0.02});
  MapAdjustment<double> adjustment;
  adjustment.solver.options.max_iterations = 30;
  REQUIRE(improved(adjustment.optimise_all(tied)));
  adjustment.window_options.planes = false;
  REQUIRE(improved(adjustment.optimise_all(free)));
  const MapErrors with = measure(scene, tied), without = measure(scene, free);
  INFO("centre " << without.centre << " to " << with.centre << ", point " << without.point << " to "
                 << with.point << ", flatness " << flatness(scene, free) << " to " << flatness(scene, tied));
  CHECK(with.point < 0.9 * without.point);
  CHECK(with.centre < without.centre);
  CHECK(flatness(scene, tied) < 0.5 * flatness(scene, free));
  for (const auto& plane : tied.planes) {
    if (plane.axis == 1) continue;  // floor and ceiling are hardly seen
    CHECK(std::abs(std::abs(plane.plane.distance) - (plane.axis == 0 ? 4 : 3)) < 0.05);
  }
}

TEST_CASE("A landmark that does not lie on its plane is let go and does not bend it") {
  MapScene scene = make_scene();
  for (std::size_t i = 0; i < scene.points.size(); i += 5)
    if (scene.points[i].z() == 3) scene.points[i].z() = 2.7;  // in front of the wall
  Map<double> map = scene.make_map();
  scene.add_planes(map);
  const LandmarkId wall = 4;
  REQUIRE(map.planes[4].plane.distance == 3);
  int wrong = 0, kept_wrong = 0, right = 0, kept = 0;
  for (std::size_t i = 0; i < map.points.size(); ++i)
    if (map.points[i].alive && scene.points[i].z() == 2.7) map.points[i].plane = wall;
  MapAdjustment<double> adjustment;
  adjustment.solver.options.max_iterations = 30;
  REQUIRE(improved(adjustment.optimise_all(map)));
  for (std::size_t i = 0; i < map.points.size(); ++i) {
    if (!map.points[i].alive) continue;
    wrong += scene.points[i].z() == 2.7;
    right += scene.points[i].z() == 3;
    (scene.points[i].z() == 2.7 ? kept_wrong : kept) += map.points[i].plane == wall;
  }
  INFO(kept_wrong << " of " << wrong << " wrong ones kept, " << kept << " of " << right << " right ones");
  CHECK(wrong > 10);
  CHECK(kept_wrong * 10 < wrong);
  CHECK(kept > 0.9 * right);
  CHECK(std::abs(map.planes[4].plane.distance - 3) < 0.03);
}

TEST_CASE("Members outside the window hold a plane where it is") {
  MapScene scene = make_scene();
  Map<double> map = scene.make_map();
  scene.add_planes(map);
  BundleWindow<double> window;
  BundleWindowOptions<double> options;
  options.max_free = 2;
  window.gather_local(map, 11, options);
  REQUIRE_FALSE(window.graph.planes.empty());
  REQUIRE(window.ties.planes.size() == window.graph.planes.size());
  for (std::size_t p = 0; p < window.graph.planes.size(); ++p) {
    int inside = 0, places = 0;
    for (const auto& point : window.graph.points) inside += point.plane == static_cast<std::int32_t>(p);
    for (const auto& point : map.points) places += point.alive && point.plane == window.ties.planes[p];
    for (const auto& line : map.lines) places += line.alive && line.plane == window.ties.planes[p] ? 2 : 0;
    for (const auto& line : window.graph.lines) inside += line.plane == static_cast<std::int32_t>(p) ? 2 : 0;
    CHECK(window.graph.planes[p].held(3, 3) == Approx(places - inside));
  }
  options.planes = false;
  window.gather_local(map, 11, options);
  CHECK(window.graph.planes.empty());
}

TEST_CASE("Planes move with the map when it is bent, and die with their members") {
  MapScene scene = make_scene();
  Map<double> map = scene.make_map();
  scene.add_planes(map);
  Vec<double, 7> xi;
  xi << 0.2, -0.1, 0.3, 1, 2, -0.5, 0.4;
  const auto moved = Sim3<double>::exp(xi);
  std::vector<Sim3<double>> moves(map.keyframes.size(), moved);
  const Plane3<double> before = map.planes[4].plane;
  deform<double>(map, moves);
  const Plane3<double> expected = transform(moved, before);
  CHECK((map.planes[4].plane.normal - expected.normal).norm() < 1e-9);
  CHECK(map.planes[4].plane.distance == Approx(expected.distance));
  map.erase_plane(4);
  for (const auto& point : map.points) CHECK(point.plane != 4);
  CHECK(map.add_plane(before, 2) == 4);
}
