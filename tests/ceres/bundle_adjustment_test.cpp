// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <limits>
#include <vector>

#include "sslam/ceres/global_bundle_adjustment.hpp"
#include "sslam/ceres/local_bundle_adjustment.hpp"
#include "support/catch.hpp"
#include "support/map_scene.hpp"

namespace {

using namespace sslam;
using sslam::testing::look;
using sslam::testing::MapScene;
using sslam::testing::MapSceneOptions;
using sslam::testing::sweep;

// Moves keyframes from `first` on, and every landmark, off their true places.
void perturb(MapScene& scene, Map<double>& map, std::size_t first, double rotation, double distance) {
  for (std::size_t k = first; k < map.keyframes.size(); ++k) {
    Vec6<double> xi;
    xi << scene.gauss3() * rotation, scene.gauss3() * distance;
    map.keyframes[k].cam_from_world = map.keyframes[k].cam_from_world.retract(xi);
  }
  for (auto& p : map.points) p.position += scene.gauss3() * distance;
  for (auto& l : map.lines) {
    const Vec3<double> a = l.start + scene.gauss3() * distance, b = l.end + scene.gauss3() * distance;
    l.line = Line3<double>::from_points(a, b);
    l.start = a;
    l.end = b;
  }
}

struct Errors {
  double rotation = 0, centre = 0;  // largest over the keyframes, radians and metres
  double point = 0, line = 0;       // median distance from the truth, metres
};

double median(std::vector<double> values) {
  if (values.empty()) return 0;
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2),
                   values.end());
  return values[values.size() / 2];
}

Errors measure(const MapScene& scene, const Map<double>& map) {
  Errors e;
  for (std::size_t k = 0; k < map.keyframes.size(); ++k) {
    const SE3<double>& pose = map.keyframes[k].cam_from_world;
    e.rotation = std::max(e.rotation, angle_between(pose.rotation, scene.poses[k].rotation));
    e.centre = std::max(e.centre, (pose.inverse().translation - scene.poses[k].inverse().translation).norm());
  }
  std::vector<double> points, lines;
  for (std::size_t i = 0; i < map.points.size(); ++i)
    if (map.points[i].alive) points.push_back((map.points[i].position - scene.points[i]).norm());
  for (std::size_t i = 0; i < map.lines.size(); ++i)
    if (map.lines[i].alive) {
      const Vec3<double> middle = (scene.lines[i].start + scene.lines[i].end) / 2;
      lines.push_back((map.lines[i].line.point_closest_to(middle) - middle).norm());
    }
  e.point = median(points);
  e.line = median(lines);
  return e;
}

std::vector<double> state_of(const Map<double>& map) {
  std::vector<double> out;
  const auto put = [&out](const auto& v) { out.insert(out.end(), v.data(), v.data() + v.size()); };
  for (const auto& kf : map.keyframes) {
    put(kf.cam_from_world.translation);
    put(kf.cam_from_world.rotation.quaternion().coeffs());
  }
  for (const auto& p : map.points) {
    put(p.position);
    put(p.viewing_direction);
    out.push_back(p.extent);
    out.push_back(static_cast<double>(p.observations.size()));
  }
  for (const auto& l : map.lines) {
    put(l.line.moment);
    put(l.line.direction);
    put(l.start);
    put(l.end);
    out.push_back(static_cast<double>(l.observations.size()));
  }
  return out;
}

}  // namespace

TEST_CASE("Local bundle adjustment brings a perturbed map back to the level of the noise") {
  const bool with_points = GENERATE(true, false);
  const bool with_lines = GENERATE(true, false);
  if (!with_points && !with_lines) return;
  MapSceneOptions options;
  options.points = with_points ? 600 : 0;
  options.lines = with_lines ? (with_points ? 80 : 150) : 0;
  MapScene scene(options, sweep(12));
  Map<double> map = scene.make_map();
  const KeyframeId centre = 11;
  LocalBundleAdjustment adjustment;
  adjustment.solver.options.max_iterations = 15;
  perturb(scene, map, 5, radians(0.5), 0.02);
  const Errors before = measure(scene, map);
  const BundleSummary summary = adjustment.optimise(map, centre);
  const Errors after = measure(scene, map);
  INFO("points " << with_points << " lines " << with_lines << " cost " << summary.initial_cost << " to "
                 << summary.final_cost << " in " << summary.iterations);
  INFO("rotation " << degrees(before.rotation) << " to " << degrees(after.rotation) << " deg");
  INFO("centre " << before.centre << " to " << after.centre << ", point " << before.point << " to "
                 << after.point << ", line " << before.line << " to " << after.line);
  REQUIRE(improved(summary));
  REQUIRE(degrees(after.rotation) < 0.5);
  REQUIRE(after.centre < 0.05);
  if (with_points) REQUIRE(after.point < 0.04);
  if (with_lines) REQUIRE(after.line < 0.05);
}
