// SPDX-License-Identifier: BSD-3-Clause
// What the kernels are given for one frame: normals, segments, matches and map observations of a box room, as
// much of each as a real frame has. The axes of the world are the Manhattan axes.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "sslam/core/random.hpp"
#include "sslam/manhattan/votes.hpp"
#include "sslam/solver/pose/pose_refinement.hpp"
#include "sslam/solver/triangulation/triangulate_line.hpp"
#include "sslam/solver/triangulation/triangulate_point.hpp"
#include "support/random_draws.hpp"

namespace sslam::testing {

struct RoomFrameOptions {
  int normal_columns = 256, normal_rows = 192;
  int segments = 200;
  int matches = 500;
  int points = 200, lines = 60;  // of the map
  int views = 7;                 // of the landmarks to triangulate
  double mismatches = 0.3;       // share of the matches
  double outliers = 0.1;         // share of the map observations
  double normal_noise = radians(5.0);
  double pixel_noise = 0.7;
  std::uint64_t seed = 1;
};

template <Scalar S>
class RoomFrame {
 public:
  explicit RoomFrame(const RoomFrameOptions& options = {}) : options_(options), random_(options.seed) {
    add_normals();
    for (int i = 0; i < options.segments; ++i) add_vote();
    for (int i = 0; i < options.matches; ++i) add_match();
    for (int i = 0; i < options.points; ++i) add_point();
    for (int i = 0; i < options.lines; ++i) add_line();
    add_views();
  }

  Pinhole<S> pinhole{500, 500, 320, 240};
  SE3<S> previous = pose(0).template cast<S>(), current = pose(1).template cast<S>();  // cam_from_world
  std::vector<LineVote<S>> votes;                                                      // of the current view
  std::vector<BearingMatch<S>> matches;                                                // previous to current
  std::vector<PointObservation<S>> points;
  std::vector<LineObservation<S>> lines;
  std::vector<PointView<S>> point_views;  // one landmark of each kind, from a row of poses
  std::vector<LineView<S>> line_views;

  [[nodiscard]] NormalView<S> normals() const noexcept {
    return {x_.data(), y_.data(), z_.data(), nullptr, x_.size(), 1};
  }

 private:
  static constexpr double kHalf[3] = {4, 1.5, 3};  // metres
  static constexpr int kWidth = 640, kHeight = 480;

  struct OnWall {
    Vec3<double> point;
    int axis;  // across the wall
    double side;
  };

  // A camera that moves sideways and turns by a few degrees each time.
  [[nodiscard]] static SE3<double> pose(int k) {
    const auto world_from_cam = SO3<double>::exp(Vec3<double>(0.1, 0.3 + 0.05 * k, 0.02 * k));
    return SE3<double>{world_from_cam, Vec3<double>(-1.0 + 0.2 * k, 0.1 + 0.03 * k, -1.5)}.inverse();
  }

  [[nodiscard]] Vec2<double> noise() { return gaussian_vector<2>(random_) * options_.pixel_noise; }
  [[nodiscard]] bool chance(double share) { return random_.uniform(0.0, 1.0) < share; }
  [[nodiscard]] Vec2<double> random_pixel() {
    const double u = random_.uniform(0.0, double{kWidth}), v = random_.uniform(0.0, double{kHeight});
    return {u, v};
  }
  [[nodiscard]] Pinhole<double> lens() const { return {pinhole.fx, pinhole.fy, pinhole.cx, pinhole.cy}; }
  [[nodiscard]] Vec2<double> seen(const SE3<double>& cam_from_world, const Vec3<double>& point) const {
    return lens().project(cam_from_world * point);
  }
  [[nodiscard]] static bool inside(const Vec2<double>& p) {
    return p.x() > 0 && p.y() > 0 && p.x() < kWidth && p.y() < kHeight;
  }

  // Where the ray of a pixel leaves the room.
  [[nodiscard]] OnWall wall_at(const SE3<double>& cam_from_world, const Vec2<double>& pixel) const {
    const SE3<double> world_from_cam = cam_from_world.inverse();
    const Vec3<double> ray = world_from_cam.rotation * lens().unproject(pixel);
    OnWall hit{Vec3<double>::Zero(), 0, 1};
    double nearest = 1e9;
    for (int i = 0; i < 3; ++i) {
      const double side = ray[i] > 0 ? 1 : -1;
      const double along = (side * kHalf[i] - world_from_cam.translation[i]) / ray[i];
      if (!(along < nearest)) continue;
      nearest = along;
      hit = {Vec3<double>(world_from_cam.translation + along * ray), i, side};
    }
    return hit;
  }

  void add_normals() {
    const Mat3<double> R = pose(1).rotation.matrix();
    for (int row = 0; row < options_.normal_rows; ++row)
      for (int column = 0; column < options_.normal_columns; ++column) {
        const Vec2<double> pixel((column + 0.5) * kWidth / options_.normal_columns,
                                 (row + 0.5) * kHeight / options_.normal_rows);
        const OnWall hit = wall_at(pose(1), pixel);
        Vec3<double> n = -hit.side * R.col(hit.axis);
        n += options_.normal_noise * gaussian_vector<3>(random_);
        n.normalize();
        x_.push_back(static_cast<S>(n.x()));
        y_.push_back(static_cast<S>(n.y()));
        z_.push_back(static_cast<S>(n.z()));
      }
  }

  // An edge along a world axis on some wall, seen whole in the current view.
  void random_edge(Vec3<double>& start, Vec3<double>& end) {
    do {
      const OnWall hit = wall_at(pose(1), random_pixel());
      const int along = (hit.axis + 1 + static_cast<int>(random_.below(2))) % 3;
      start = end = hit.point;
      end[along] += random_.uniform(0.3, 1.2) * (start[along] > 0 ? -1 : 1);
    } while (!inside(seen(pose(1), end)) || (pose(1) * end).z() < 0.2);
  }
  [[nodiscard]] Segment2<double> image_of(const SE3<double>& view, const Vec3<double>& a,
                                          const Vec3<double>& b) {
    return {seen(view, a) + noise(), seen(view, b) + noise()};
  }
  [[nodiscard]] static Segment2<S> cast(const Segment2<double>& s) {
    return {s.start.template cast<S>(), s.end.template cast<S>()};
  }

  void add_vote() {
    Vec3<double> a, b;
    random_edge(a, b);
    votes.push_back(line_vote(cast(image_of(pose(1), a, b)), pinhole, static_cast<S>(options_.pixel_noise)));
  }

  void add_match() {
    Vec2<double> before, now;
    do {
      before = random_pixel();
      now = seen(pose(1), wall_at(pose(0), before).point);
    } while (!inside(now));
    if (chance(options_.mismatches)) now = random_pixel();
    matches.push_back({lens().unproject(before + noise()).template cast<S>(),
                       lens().unproject(now + noise()).template cast<S>(),
                       static_cast<S>(options_.pixel_noise / 500)});
  }

  void add_point() {
    const Vec2<double> pixel = random_pixel();
    const Vec3<double> point = wall_at(pose(1), pixel).point;
    const Vec2<double> observed = chance(options_.outliers) ? random_pixel() : Vec2<double>(pixel + noise());
    points.push_back(
        {point.template cast<S>(), observed.template cast<S>(), static_cast<S>(options_.pixel_noise)});
  }

  void add_line() {
    Vec3<double> a, b;
    random_edge(a, b);
    Segment2<double> observed = image_of(pose(1), a, b);
    if (chance(options_.outliers)) observed = {random_pixel(), random_pixel()};
    lines.push_back({Line3<double>::from_points(a, b).template cast<S>(), cast(observed),
                     static_cast<S>(options_.pixel_noise)});
  }

  void add_views() {
    const Vec3<double> point = wall_at(pose(1), {340, 250}).point;
    // Upright: the path runs across it.
    const Vec3<double> a = wall_at(pose(1), {280, 250}).point, b = a + Vec3<double>(0, 0.8, 0);
    for (int k = 0; k < options_.views; ++k) {
      const Vec3<double> ray = lens().unproject(seen(pose(k), point) + noise());
      point_views.push_back({pose(k).template cast<S>(), ray.template head<2>().template cast<S>(),
                             static_cast<S>(options_.pixel_noise / 500)});
      line_views.push_back(make_line_view(pose(k).template cast<S>(), pinhole, cast(image_of(pose(k), a, b)),
                                          static_cast<S>(options_.pixel_noise)));
    }
  }

  RoomFrameOptions options_;
  Random random_;
  std::vector<S> x_, y_, z_;
};

}  // namespace sslam::testing
