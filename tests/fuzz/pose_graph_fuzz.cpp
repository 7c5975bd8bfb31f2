// SPDX-License-Identifier: BSD-3-Clause
// A ring of poses and the motions between them: whatever they are, a graph that is said to be better is
// finite and costs no more, and any other stays as it was.
#include <cmath>
#include <cstring>
#include <vector>

#include "fuzz/sound_descent.hpp"
#include "sslam/solver/bundle/pose_graph_solver.hpp"

namespace pose_graph_fuzz {

using namespace sslam;

constexpr std::size_t kRow = 15;  // a similarity, and the sigmas of an edge

inline Sim3<double> similarity(const double* r) {
  return {SO3<double>::from_quaternion(r[0], r[1], r[2], r[3]), {r[4], r[5], r[6]}, r[7]};
}

inline bool same(const PoseGraph<double>& a, const PoseGraph<double>& b) {
  for (std::size_t i = 0; i < a.nodes.size(); ++i) {
    const Sim3<double>&x = a.nodes[i].cam_from_world, &y = b.nodes[i].cam_from_world;
    if (!fuzzing::same_bits(x.rotation.quaternion().coeffs(), y.rotation.quaternion().coeffs()) ||
        !fuzzing::same_bits(x.translation, y.translation) ||
        std::memcmp(&x.scale, &y.scale, sizeof x.scale) != 0)
      return false;
  }
  return true;
}

inline bool finite(const Sim3<double>& pose) {
  return pose.rotation.matrix().allFinite() && pose.translation.allFinite() && std::isfinite(pose.scale) &&
         pose.scale > 0;
}

}  // namespace pose_graph_fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace pose_graph_fuzz;
  fuzzing::Bytes bytes(data, size);
  Random random(bytes.take<std::uint8_t>());
  const std::size_t count = 2 + bytes.take<std::uint8_t>() % 8;
  const auto flags = bytes.take<std::uint8_t>();
  std::vector<double> rows;
  const auto add = [&](const Sim3<double>& s) {
    const auto q = s.rotation.quaternion();
    rows.insert(rows.end(), {q.w(), q.x(), q.y(), q.z(), s.translation.x(), s.translation.y(),
                             s.translation.z(), s.scale});
    rows.insert(rows.end(), {100, 100, 100, 20, 20, 20, 10});
  };
  std::vector<Sim3<double>> poses;
  for (std::size_t i = 0; i < count; ++i) {
    const double at = static_cast<double>(i);
    poses.push_back({SO3<double>::exp({0, 0.3 * at, 0}), {random.uniform(-0.1, 0.1), 0, at}, 1 + 0.01 * at});
    add(poses.back());
  }
  for (std::size_t i = 0; i < count; ++i) add(poses[(i + 1) % count] * poses[i].inverse());
  fuzzing::spoil(rows, kRow, bytes);

  PoseGraph<double> before;
  for (std::size_t i = 0; i < 2 * count; ++i) {
    const double* const r = rows.data() + i * kRow;
    if (i < count) {
      PoseGraphNode<double> node;
      node.cam_from_world = similarity(r);
      node.held = i == 0 && (flags & 1) == 0;
      if ((flags & 2) != 0)
        node.rotation = RotationTie<double>{similarity(r).rotation, Mat3<double>::Identity() * r[8]};
      before.nodes.push_back(node);
      continue;
    }
    PoseGraphEdge<double> edge{static_cast<std::int32_t>(i - count),
                               static_cast<std::int32_t>((i - count + 1) % count), similarity(r)};
    for (int k = 0; k < 7; ++k) edge.inverse_sigma[k] = r[8 + k];
    before.edges.push_back(edge);
    if ((flags & 4) != 0) before.edges.push_back(edge);
  }
  PoseGraph<double> graph = before;
  PoseGraphSolver<double> solver;
  if (!fuzzing::descended(solver.solve(graph), [&] { return same(before, graph); })) return 0;
  for (const PoseGraphNode<double>& node : graph.nodes)
    if (!node.held) fuzzing::demand(finite(node.cam_from_world));
  return 0;
}
