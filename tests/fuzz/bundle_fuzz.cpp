// SPDX-License-Identifier: BSD-3-Clause
// Bundle adjustment of points, lines and a plane: whatever they are, a graph that is said to be better is
// finite and costs no more, and any other stays as it was.
#include <vector>

#include "fuzz/sound_descent.hpp"
#include "sslam/solver/bundle/bundle_solver.hpp"

namespace bundle_fuzz {

using namespace sslam;

constexpr std::size_t kRow = 8;

// Numbers of views, points, lines, a plane, and then of the edges, view by view.
struct Shape {
  std::size_t views, points, lines;
  bool tied;  // to the plane
  bool turns, axes, scale;
};

inline Vec3<double> three(const double* r) {
  return {r[0], r[1], r[2]};
}

inline std::vector<double> sound_scene(const Shape& shape, Random& random) {
  std::vector<double> rows;
  const auto row = [&rows](std::initializer_list<double> numbers) {
    rows.insert(rows.end(), numbers);
    rows.resize((rows.size() + kRow - 1) / kRow * kRow);
  };
  const auto place = [&] {
    return Vec3<double>(random.uniform(-2.0, 2.0), random.uniform(-2.0, 2.0), random.uniform(3.0, 6.0));
  };
  std::vector<SE3<double>> poses;
  for (std::size_t v = 0; v < shape.views; ++v) {
    const double x = 0.3 * static_cast<double>(v);
    poses.push_back({SO3<double>::exp({0.01 * x, -0.05 * x, 0}), {-x, 0.02 * x, 0.01}});
    const auto q = poses.back().rotation.quaternion();
    const Vec3<double>& t = poses.back().translation;
    row({q.w(), q.x(), q.y(), q.z(), t.x() + 0.01, t.y(), t.z(), 500});
  }
  std::vector<Vec3<double>> places;
  for (std::size_t i = 0; i < shape.points + 2 * shape.lines; ++i) places.push_back(place());
  for (std::size_t i = 0; i < shape.points; ++i) row({places[i].x(), places[i].y(), places[i].z() + 0.02});
  for (std::size_t i = 0; i < shape.lines; ++i) {
    const Vec3<double>&a = places[shape.points + 2 * i], &b = places[shape.points + 2 * i + 1];
    row({a.x(), a.y(), a.z(), b.x(), b.y(), b.z() + 0.02});
  }
  row({0, 0, 1, 4, 0, 0, 1, 1});  // the plane, its axis, the depth of the scene
  const Pinhole<double> pinhole{500, 500, 320, 240};
  for (const SE3<double>& pose : poses)
    for (const Vec3<double>& x : places) {
      const Vec2<double> pixel = pinhole.project(pose * x);
      row({pixel.x() + random.uniform(-1.0, 1.0), pixel.y() + random.uniform(-1.0, 1.0), 1});
    }
  return rows;
}

inline BundleGraph<double> graph_of(const Shape& shape, const std::vector<double>& rows) {
  BundleGraph<double> graph;
  const double* r = rows.data();
  const double* const plane = r + (shape.views + shape.points + shape.lines) * kRow;
  const double* const edges = plane + kRow;
  const std::size_t seen = shape.points + 2 * shape.lines;
  const auto edge = [&](std::size_t view, std::size_t place) { return edges + (view * seen + place) * kRow; };
  for (std::size_t v = 0; v < shape.views; ++v, r += kRow) {
    BundleView<double> view;
    view.cam_from_world = {SO3<double>::from_quaternion(r[0], r[1], r[2], r[3]), three(r + 4)};
    view.pinhole = {r[7], r[7], 320, 240};
    view.hold = v == 0 ? Hold::kPose : v == 1 && !shape.scale ? Hold::kCentre : Hold::kNothing;
    if (shape.turns)
      view.rotation =
          RotationTie<double>{view.cam_from_world.rotation, Mat3<double>::Identity() * r[3] * 100};
    graph.views.push_back(view);
  }
  for (std::size_t i = 0; i < shape.points; ++i, r += kRow) {
    BundlePoint<double> point;
    point.position = three(r);
    point.first_edge = static_cast<std::int32_t>(graph.point_edges.size());
    for (std::size_t v = 0; v < shape.views; ++v)
      graph.point_edges.push_back(
          {{edge(v, i)[0], edge(v, i)[1]}, edge(v, i)[2], static_cast<std::int32_t>(v)});
    point.last_edge = static_cast<std::int32_t>(graph.point_edges.size());
    if (shape.tied && i % 2 == 0) point.plane = 0;
    graph.points.push_back(point);
  }
  for (std::size_t i = 0; i < shape.lines; ++i, r += kRow) {
    BundleLine<double> line;
    line.line = Line3<double>::from_points(three(r), three(r + 3));
    line.first_edge = static_cast<std::int32_t>(graph.line_edges.size());
    for (std::size_t v = 0; v < shape.views; ++v) {
      const double *a = edge(v, shape.points + 2 * i), *b = edge(v, shape.points + 2 * i + 1);
      graph.line_edges.push_back({{{a[0], a[1]}, {b[0], b[1]}}, a[2], static_cast<std::int32_t>(v)});
    }
    line.last_edge = static_cast<std::int32_t>(graph.line_edges.size());
    line.start = three(r);
    line.end = three(r + 3);
    if (shape.axes) line.axis = three(plane + 4);
    if (shape.tied) line.plane = 0;
    graph.lines.push_back(line);
  }
  if (shape.tied) {
    BundlePlane<double> wall;
    wall.plane = {three(plane), plane[3]};
    if (shape.axes) wall.axis = three(plane + 4);
    wall.held = Mat<double, 4, 4>::Identity() * plane[7];
    graph.planes.push_back(wall);
  }
  if (shape.scale) graph.scale = ScaleTie<double>{0, 1, plane[7]};
  graph.depth = plane[7];
  return graph;
}

inline bool same(const BundleGraph<double>& a, const BundleGraph<double>& b) {
  using fuzzing::same_bits;
  for (std::size_t i = 0; i < a.views.size(); ++i) {
    const SE3<double>&x = a.views[i].cam_from_world, &y = b.views[i].cam_from_world;
    if (!same_bits(x.rotation.quaternion().coeffs(), y.rotation.quaternion().coeffs()) ||
        !same_bits(x.translation, y.translation))
      return false;
  }
  for (std::size_t i = 0; i < a.points.size(); ++i)
    if (!same_bits(a.points[i].position, b.points[i].position)) return false;
  for (std::size_t i = 0; i < a.lines.size(); ++i)
    if (!same_bits(a.lines[i].line.moment, b.lines[i].line.moment) ||
        !same_bits(a.lines[i].line.direction, b.lines[i].line.direction))
      return false;
  for (std::size_t i = 0; i < a.planes.size(); ++i)
    if (!same_bits(a.planes[i].plane.normal, b.planes[i].plane.normal)) return false;
  return true;
}

}  // namespace bundle_fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace bundle_fuzz;
  fuzzing::Bytes bytes(data, size);
  Random random(bytes.take<std::uint8_t>());
  const auto counts = bytes.take<std::uint8_t>(), flags = bytes.take<std::uint8_t>();
  const Shape shape{2U + counts % 3,  (counts / 3U) % 10, (counts / 30U) % 4, (flags & 1) != 0,
                    (flags & 2) != 0, (flags & 4) != 0,   (flags & 8) != 0};
  std::vector<double> rows = sound_scene(shape, random);
  fuzzing::spoil(rows, kRow, bytes);
  const BundleGraph<double> before = graph_of(shape, rows);
  BundleGraph<double> graph = before;
  BundleSolver<double> solver;
  if (!fuzzing::descended(solver.solve(graph), [&] { return same(before, graph); })) return 0;
  BundleState<double> state;
  state.load(graph);
  fuzzing::demand(state.finite());
  return 0;
}
