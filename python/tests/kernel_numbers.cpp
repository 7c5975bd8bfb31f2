// SPDX-License-Identifier: BSD-3-Clause
// The kernels as C++ calls them, on the numbers of standard input: what test_kernels.py compares with. The
// first word names the kernel; all that it answers is printed, exactly.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <stdexcept>
#include <string>
#include <vector>

#include "sslam/geometry/nearest_rotation.hpp"
#include "sslam/manhattan/votes.hpp"
#include "sslam/system/compiled_kernels.hpp"

namespace {

using namespace sslam;

double number() {
  std::string word;
  if (!(std::cin >> word)) throw std::runtime_error("a number is missing");
  return std::stod(word);  // "nan" is one
}

std::size_t count() {
  return static_cast<std::size_t>(number());
}

Vec2<double> pixel() {
  const double u = number(), v = number();
  return {u, v};
}

Mat3<double> matrix3() {
  Mat3<double> m;
  for (int i = 0; i < 9; ++i) m(i / 3, i % 3) = number();
  return m;
}

SE3<double> pose() {
  SE3<double> pose;
  Mat3<double> m;
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) m(r, c) = number();
    pose.translation[r] = number();
  }
  for (int i = 0; i < 4; ++i) (void)number();  // 0 0 0 1
  (void)nearest_rotation(m, pose.rotation);
  return pose;
}

Camera<double> camera() {
  Camera<double> c;
  for (double* value :
       {&c.pinhole.fx, &c.pinhole.fy, &c.pinhole.cx, &c.pinhole.cy, &c.distortion.k1, &c.distortion.k2})
    *value = number();
  return c;
}

template <class Matrix>
void print(const Matrix& matrix) {
  for (int r = 0; r < matrix.rows(); ++r)
    for (int c = 0; c < matrix.cols(); ++c) std::printf("%.17g ", matrix(r, c));
}

template <class Status>
void print_status(Status status) {
  std::printf("%d ", static_cast<int>(status));
}

std::vector<BearingMatch<double>> matches(const Camera<double>& lens) {
  const double focal = std::sqrt(lens.pinhole.fx * lens.pinhole.fy);
  std::vector<BearingMatch<double>> all(count());
  for (auto& match : all) {
    match.ray0 = lens.pinhole.unproject(lens.undistort_pixel(pixel()));
    match.ray1 = lens.pinhole.unproject(lens.undistort_pixel(pixel()));
    match.sigma = 1 / focal;
  }
  return all;
}

void manhattan(bool known) {
  const Camera<double> lens = camera();
  std::vector<float> xyz(3 * count());
  for (float& value : xyz) value = static_cast<float>(number());
  std::vector<LineVote<double>> lines(count());
  for (auto& line : lines) {
    const Vec2<double> start = lens.undistort_pixel(pixel()), end = lens.undistort_pixel(pixel());
    line = line_vote(Segment2<double>{start, end}, lens.pinhole, 1.0);
  }
  const NormalView<float> normals{xyz.data(), xyz.data() + 1, xyz.data() + 2, nullptr, xyz.size() / 3, 3};
  std::vector<std::int8_t> axis_of(lines.size());
  ManhattanEstimate<double> answer;
  if (known) {
    ManhattanPrior<double> prior;
    (void)nearest_rotation(matrix3(), prior.cam_from_manhattan);
    answer = track_manhattan<double, float>(normals, lines, prior, {}, axis_of);
  } else {
    answer = find_manhattan<double, float>(normals, lines, {}, 1, axis_of);
  }
  print_status(answer.status);
  print(answer.cam_from_manhattan.matrix());
  print(answer.covariance);
  for (const int axis : axis_of) std::printf("%d ", axis);
}

void two_views(bool start) {
  const auto all = matches(camera());
  SE3<double> motion;
  if (start) motion = pose();
  const std::span<const BearingMatch<double>> span(all);
  const auto summary = start ? refine_relative_pose<double>(span, motion.rotation, motion.translation, {})
                             : find_relative_pose<double>(span, {}, 1, motion.rotation, motion.translation);
  print_status(summary.status);
  print(motion.rotation.matrix());
  print(motion.translation);
  print(summary.rotation_covariance);
}

void translation() {
  const auto all = matches(camera());
  SO3<double> rotation;
  (void)nearest_rotation(matrix3(), rotation);
  const auto answer =
      translation_from_rotation<double>(std::span<const BearingMatch<double>>(all), rotation, {}, 1);
  print_status(answer.status);
  print(answer.t_10);
}

void triangulate() {
  const Camera<double> lens = camera();
  std::vector<PointView<double>> views(count());
  for (auto& view : views) view.cam_from_world = pose().inverse();
  for (std::size_t points = count(); points > 0; --points) {
    for (auto& view : views) {
      view.normalised = lens.pinhole.unproject(lens.undistort_pixel(pixel())).head<2>();
      view.sigma = 1 / std::sqrt(lens.pinhole.fx * lens.pinhole.fy);
    }
    const auto answer =
        triangulate_point(std::span<const PointView<double>>(views), PointTriangulationOptions<double>{});
    print_status(answer.status);
    print(answer.point);
    print(answer.covariance);
  }
}

bool unseen(const std::vector<double>& numbers) {
  return std::all_of(numbers.begin(), numbers.end(), [](double x) { return std::isnan(x); });
}

std::vector<double> numbers(std::size_t count) {
  std::vector<double> all(count);
  for (double& value : all) value = number();
  return all;
}

Segment2<double> segment(const Camera<double>& lens, const std::vector<double>& ends) {
  return {lens.undistort_pixel({ends[0], ends[1]}), lens.undistort_pixel({ends[2], ends[3]})};
}

void triangulate_lines() {
  const Camera<double> lens = camera();
  std::vector<SE3<double>> cameras(count());
  for (auto& view : cameras) view = pose().inverse();
  for (std::size_t lines = count(); lines > 0; --lines) {
    const std::vector<double> along = numbers(3);
    std::vector<LineView<double>> views;
    for (const auto& cam_from_world : cameras) {
      const std::vector<double> ends = numbers(4);
      if (unseen(ends)) continue;
      LineView<double> view = make_line_view(cam_from_world, lens.pinhole, segment(lens, ends), 1.0);
      view.sigma = 1 / std::sqrt(lens.pinhole.fx * lens.pinhole.fy);
      views.push_back(view);
    }
    const std::span<const LineView<double>> all(views);
    const LineTriangulationOptions<double> options;
    const auto answer = unseen(along) ? triangulate_line(all, options)
                                      : triangulate_line_along(all, {along[0], along[1], along[2]}, options);
    print_status(answer.status);
    print(answer.start);
    print(answer.end);
    print(answer.covariance);
  }
}

// The first view is held, and its distance from the last.
void adjust() {
  const Camera<double> lens = camera();
  BundleGraph<double> graph;
  graph.views.resize(count());
  for (auto& view : graph.views) {
    view.cam_from_world = pose().inverse();
    view.pinhole = lens.pinhole;
  }
  graph.views.front().hold = Hold::kPose;
  const auto last = static_cast<std::int32_t>(graph.views.size()) - 1;
  const auto centre = [&](const auto& view) -> Vec3<double> {
    return view.cam_from_world.inverse().translation;
  };
  graph.scale = {0, last, (centre(graph.views.back()) - centre(graph.views.front())).norm()};
  graph.points.resize(count());
  for (auto& point : graph.points) {
    for (int i = 0; i < 3; ++i) point.position[i] = number();
    point.first_edge = static_cast<std::int32_t>(graph.point_edges.size());
    for (std::int32_t v = 0; v <= last; ++v)
      graph.point_edges.push_back({lens.undistort_pixel(pixel()), 1.0, v});
    point.last_edge = static_cast<std::int32_t>(graph.point_edges.size());
  }
  graph.lines.resize(count());
  for (auto& line : graph.lines) {
    const std::vector<double> ends = numbers(6);
    line.start = {ends[0], ends[1], ends[2]};
    line.end = {ends[3], ends[4], ends[5]};
    line.line = Line3<double>::from_points(line.start, line.end);
    line.first_edge = static_cast<std::int32_t>(graph.line_edges.size());
    for (std::int32_t v = 0; v <= last; ++v) graph.line_edges.push_back({segment(lens, numbers(4)), 1.0, v});
    line.last_edge = static_cast<std::int32_t>(graph.line_edges.size());
  }
  BundleSolver<double> solver;
  solver.options.max_iterations = 50;
  const BundleSummary summary = solver.solve(graph);
  print_status(summary.status);
  for (const auto& view : graph.views) {
    const SE3<double> world_from_cam = view.cam_from_world.inverse();
    print(world_from_cam.rotation.matrix());
    print(world_from_cam.translation);
  }
  for (const auto& point : graph.points) print(point.position);
  for (const auto& line : graph.lines) {
    print(line.line.point_closest_to(line.start));
    print(line.line.point_closest_to(line.end));
  }
  std::printf("%.17g %.17g %d ", summary.initial_cost, summary.final_cost, summary.iterations);
}

void refine() {
  const Camera<double> lens = camera();
  std::vector<PointObservation<double>> points(count());
  for (auto& point : points) {
    for (int i = 0; i < 3; ++i) point.point_world[i] = number();
    point.pixel = lens.undistort_pixel(pixel());
  }
  SE3<double> start = pose().inverse();
  std::vector<std::uint8_t> inliers(points.size());
  const auto summary = refine_pose<double>(lens.pinhole, points, {}, start, {}, inliers, {});
  print_status(summary.status);
  const SE3<double> refined = start.inverse();
  print(refined.rotation.matrix());
  print(refined.translation);
}

}  // namespace

int main() {
  std::string kernel;
  std::cin >> kernel;
  if (kernel == "manhattan") manhattan(false);
  if (kernel == "manhattan_near") manhattan(true);
  if (kernel == "relative_pose") two_views(false);
  if (kernel == "refined_relative_pose") two_views(true);
  if (kernel == "translation") translation();
  if (kernel == "triangulate") triangulate();
  if (kernel == "triangulate_lines") triangulate_lines();
  if (kernel == "bundle_adjust") adjust();
  if (kernel == "refine_pose") refine();
  return 0;
}
