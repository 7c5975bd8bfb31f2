// SPDX-License-Identifier: BSD-3-Clause
// Kernels on arrays, of many views: triangulation and bundle adjustment. Pixels are those of the camera's
// images, NaN where a view does not see a thing; poses are camera to world.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>

#include "bindings/arrays.hpp"
#include "bindings/bindings.hpp"
#include "bindings/free.hpp"
#include "bindings/pixels.hpp"
#include "sslam/solver/bundle/scale_tie.hpp"
#include "sslam/system/compiled_kernels.hpp"

namespace sslam::python {
namespace {

bool unseen(const double* numbers, std::size_t count) {
  return std::all_of(numbers, numbers + count, [](double x) { return std::isnan(x); });
}

Vec3<double> place_at(const double* x) {
  return {x[0], x[1], x[2]};
}

Segment2<double> undistorted_segment(const Camera<double>& camera, const double* ends) {
  return {undistorted(camera, ends), undistorted(camera, ends + 2)};
}

std::vector<SE3<double>> cameras_of(const Rows<double>& poses) {
  std::vector<SE3<double>> cam_from_world;
  for (std::size_t v = 0; v < poses.size() / 16; ++v)
    cam_from_world.push_back(pose_from(poses.data() + 16 * v, item("poses", v)).inverse());
  return cam_from_world;
}

// pixels (N, V, 2)
nb::tuple triangulate_points(const Rows<double>& poses, const Rows<double>& pixels,
                             const Camera<double>& camera, double sigma, double min_parallax) {
  const std::vector<SE3<double>> cam_from_world = cameras_of(poses);
  const std::size_t views = cam_from_world.size(), points = views > 0 ? pixels.size() / (2 * views) : 0;
  std::vector<double> positions, covariances, parallaxes, errors;
  std::vector<std::uint8_t> statuses;
  {
    const Free free;
    PointTriangulationOptions<double> options;
    options.min_parallax = min_parallax;
    std::vector<PointView<double>> seen;
    for (std::size_t i = 0; i < points; ++i) {
      seen.clear();
      for (std::size_t v = 0; v < views; ++v) {
        const double* const pixel = pixels.data() + 2 * (i * views + v);
        if (unseen(pixel, 2)) continue;
        const Vec3<double> ray = camera.pinhole.unproject(undistorted(camera, pixel));
        seen.push_back({cam_from_world[v], ray.head<2>(), sigma / focal_of(camera)});
      }
      const PointTriangulation<double> answer =
          triangulate_point(std::span<const PointView<double>>(seen), options);
      append(positions, answer.point);
      append(covariances, answer.covariance);
      parallaxes.push_back(answer.parallax);
      errors.push_back(answer.max_error);
      statuses.push_back(static_cast<std::uint8_t>(answer.status));
    }
  }
  return nb::make_tuple(make_array(std::move(statuses), {points}),
                        make_array(std::move(positions), {points, 3}),
                        make_array(std::move(covariances), {points, 3, 3}),
                        make_array(std::move(parallaxes), {points}), make_array(std::move(errors), {points}));
}

// segments (N, V, 4); directions (N, 3): NaN where none is known
nb::tuple triangulate_lines(const Rows<double>& poses, const Rows<double>& segments,
                            const Rows<double>& directions, const Camera<double>& camera, double sigma,
                            double min_parallax) {
  const std::vector<SE3<double>> cam_from_world = cameras_of(poses);
  const std::size_t views = cam_from_world.size(), lines = directions.size() / 3;
  std::vector<double> ends, covariances, parallaxes, errors, overlaps;
  std::vector<std::uint8_t> statuses;
  {
    const Free free;
    LineTriangulationOptions<double> options;
    options.min_parallax = min_parallax;
    std::vector<LineView<double>> seen;
    for (std::size_t i = 0; i < lines; ++i) {
      seen.clear();
      for (std::size_t v = 0; v < views; ++v) {
        const double* const segment = segments.data() + 4 * (i * views + v);
        if (unseen(segment, 4)) continue;
        const Segment2<double> pixels = undistorted_segment(camera, segment);
        seen.push_back({cam_from_world[v],
                        {camera.pinhole.unproject(pixels.start).head<2>(),
                         camera.pinhole.unproject(pixels.end).head<2>()},
                        sigma / focal_of(camera)});
      }
      const std::span<const LineView<double>> all(seen);
      const double* const direction = directions.data() + 3 * i;
      const LineTriangulation<double> answer =
          unseen(direction, 3) ? triangulate_line(all, options)
                               : triangulate_line_along(all, place_at(direction), options);
      append(ends, answer.start);
      append(ends, answer.end);
      append(covariances, answer.covariance);
      parallaxes.push_back(answer.parallax);
      errors.push_back(answer.max_error);
      overlaps.push_back(answer.overlap);
      statuses.push_back(static_cast<std::uint8_t>(answer.status));
    }
  }
  return nb::make_tuple(make_array(std::move(statuses), {lines}), make_array(std::move(ends), {lines, 2, 3}),
                        make_array(std::move(covariances), {lines, 3, 3}),
                        make_array(std::move(parallaxes), {lines}), make_array(std::move(errors), {lines}),
                        make_array(std::move(overlaps), {lines}));
}

// One that fewer than two views see says nothing about any of them, and has no edges.
template <class Edge, class Landmark, class Observation>
void add_edges(const Rows<double>& pixels, std::size_t size, std::size_t views, double sigma,
               std::vector<Landmark>& landmarks, std::vector<Edge>& edges, Observation observation) {
  for (std::size_t i = 0; i < landmarks.size(); ++i) {
    const auto first = edges.size();
    for (std::size_t v = 0; v < views; ++v) {
      const double* const numbers = pixels.data() + size * (i * views + v);
      if (!unseen(numbers, size))
        edges.push_back({observation(numbers), 1 / sigma, static_cast<std::int32_t>(v)});
    }
    if (edges.size() - first < 2) edges.resize(first);
    landmarks[i].first_edge = static_cast<std::int32_t>(first);
    landmarks[i].last_edge = static_cast<std::int32_t>(edges.size());
  }
}

// Views without an edge stay where they are. With one pose held the scale is open, and is tied.
void fix_gauge(const Rows<bool>& held, BundleGraph<double>& graph) {
  std::vector<bool> sees(graph.views.size(), false);
  for (const auto& edge : graph.point_edges) sees[static_cast<std::size_t>(edge.view)] = true;
  for (const auto& edge : graph.line_edges) sees[static_cast<std::size_t>(edge.view)] = true;
  std::size_t anchors = 0, anchor = 0;
  for (std::size_t v = 0; v < graph.views.size(); ++v) {
    if (held.data()[v] || !sees[v]) graph.views[v].hold = Hold::kPose;
    if (held.data()[v] && anchors++ == 0) anchor = v;
  }
  if (anchors == 1) tie_scale(graph, anchor);
}

nb::tuple bundle_adjust(const Rows<double>& poses, const Rows<double>& points, const Rows<double>& pixels,
                        const Rows<double>& segments_world, const Rows<double>& segments,
                        const Camera<double>& camera, const Rows<bool>& held, double sigma,
                        int max_iterations) {
  BundleGraph<double> graph;
  for (const SE3<double>& cam_from_world : cameras_of(poses)) {
    BundleView<double> view;
    view.cam_from_world = cam_from_world;
    view.pinhole = camera.pinhole;
    graph.views.push_back(view);
  }
  const std::size_t views = graph.views.size();
  graph.points.resize(points.size() / 3);
  graph.lines.resize(segments_world.size() / 6);
  BundleSummary summary;
  std::vector<double> new_poses, new_points, new_lines;
  {
    const Free free;
    for (std::size_t i = 0; i < graph.points.size(); ++i)
      graph.points[i].position = place_at(points.data() + 3 * i);
    for (std::size_t i = 0; i < graph.lines.size(); ++i) {
      const double* const ends = segments_world.data() + 6 * i;
      graph.lines[i].line = Line3<double>::from_points(place_at(ends), place_at(ends + 3));
    }
    add_edges(pixels, 2, views, sigma, graph.points, graph.point_edges,
              [&](const double* pixel) { return undistorted(camera, pixel); });
    add_edges(segments, 4, views, sigma, graph.lines, graph.line_edges,
              [&](const double* ends) { return undistorted_segment(camera, ends); });
    fix_gauge(held, graph);
    BundleSolver<double> solver;
    solver.options.max_iterations = max_iterations;
    summary = solver.solve(graph);
    for (std::size_t v = 0; v < views; ++v) {
      if (graph.views[v].hold == Hold::kPose || !improved(summary))
        new_poses.insert(new_poses.end(), poses.data() + 16 * v, poses.data() + 16 * (v + 1));
      else
        append(new_poses, matrix_of(graph.views[v].cam_from_world.inverse()));
    }
    for (const auto& point : graph.points) append(new_points, point.position);
    for (std::size_t i = 0; i < graph.lines.size(); ++i)
      for (const std::size_t end : {0, 3}) {
        const Vec3<double> given = place_at(segments_world.data() + 6 * i + end);
        append(new_lines, improved(summary) ? graph.lines[i].line.point_closest_to(given) : given);
      }
  }
  const std::size_t point_count = graph.points.size(), line_count = graph.lines.size();
  return nb::make_tuple(summary.status, make_array(std::move(new_poses), {views, 4, 4}),
                        make_array(std::move(new_points), {point_count, 3}),
                        make_array(std::move(new_lines), {line_count, 2, 3}), summary.initial_cost,
                        summary.final_cost, summary.iterations);
}

}  // namespace

void bind_map_kernels(nb::module_& module) {
  module.def("triangulate_points", &triangulate_points);
  module.def("triangulate_lines", &triangulate_lines);
  module.def("bundle_adjust", &bundle_adjust);
}

}  // namespace sslam::python
