// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/solver/bundle/pose_graph_solver.hpp"

#include <limits>
#include <numbers>

#include "support/catch.hpp"
#include "support/random_draws.hpp"
#include "support/test_scalars.hpp"

namespace {

using namespace sslam;
using namespace sslam::testing;

constexpr int kNodes = 40;

// A camera that walks around a circle of 3 m and looks outwards.
template <Scalar S>
Sim3<S> truth(int node) {
  const S yaw = 2 * std::numbers::pi_v<S> * S(node) / kNodes;
  const SO3<S> world_from_cam = SO3<S>::exp(Vec3<S>(0, yaw, 0));
  return {world_from_cam.inverse(), -(world_from_cam.inverse() * (world_from_cam * Vec3<S>(0, 0, 3))), 1};
}

// What dead reckoning makes of it: every step turns, shifts and shrinks the world a little.
template <Scalar S>
PoseGraph<S> drifted_ring(const Sim3<S>& drift) {
  PoseGraph<S> graph;
  for (int n = 0; n < kNodes; ++n) {
    PoseGraphNode<S> node{truth<S>(n), n == 0, std::nullopt};
    if (n > 0) {
      const Sim3<S> step = drift * truth<S>(n) * truth<S>(n - 1).inverse();
      node.cam_from_world = step * graph.nodes.back().cam_from_world;
      graph.edges.push_back({n - 1, n, step, Vec<S, 7>::Constant(100)});
    }
    graph.nodes.push_back(node);
  }
  return graph;
}

template <Scalar S>
void close(PoseGraph<S>& graph) {
  graph.edges.push_back(
      {0, kNodes - 1, truth<S>(kNodes - 1) * truth<S>(0).inverse(), Vec<S, 7>::Constant(100)});
}

template <Scalar S>
S worst_place(const PoseGraph<S>& graph) {
  S worst = 0;
  for (int n = 0; n < kNodes; ++n)
    worst = std::max(worst, (graph.nodes[static_cast<std::size_t>(n)].cam_from_world.inverse().translation -
                             truth<S>(n).inverse().translation)
                                .norm());
  return worst;
}

template <Scalar S>
Sim3<S> small_drift() {
  Vec<S, 7> xi;
  xi << S(1e-3), S(2e-3), S(-1e-3), S(0.002), S(0.001), S(0.003), S(-0.01);
  return Sim3<S>::exp(xi);
}

}  // namespace

TEMPLATE_TEST_CASE("A loop takes most of the drift out of a ring", "", SSLAM_TEST_SCALARS) {
  using S = TestType;
  PoseGraph<S> graph = drifted_ring(small_drift<S>());
  const S before = worst_place(graph);
  close(graph);
  const BundleSummary summary = PoseGraphSolver<S>().solve(graph);
  REQUIRE(improved(summary));
  CHECK(summary.final_cost < 0.1 * summary.initial_cost);
  INFO(before << " m before, " << worst_place(graph) << " m after");
  CHECK(worst_place(graph) < S(0.15) * before);
  CHECK((graph.nodes[0].cam_from_world.translation - truth<S>(0).translation).norm() == 0);
}

TEST_CASE("Steps that agree with the loop bring every pose to its place") {
  PoseGraph<double> graph = drifted_ring(Sim3<double>());
  close(graph);
  Random random(3);
  for (std::size_t n = 1; n < graph.nodes.size(); ++n)
    graph.nodes[n].cam_from_world =
        graph.nodes[n].cam_from_world.retract(uniform_vector<double, 7>(random, -0.2, 0.2));
  PoseGraphSolver<double> solver;
  solver.options.min_decrease = 1e-12;
  REQUIRE(improved(solver.solve(graph)));
  CHECK(worst_place(graph) < 1e-6);
}

TEST_CASE("Rotations that structure knows do not bend with the loop") {
  PoseGraph<double> bent = drifted_ring(small_drift<double>());
  close(bent);
  PoseGraph<double> tied = bent;
  for (int n = 0; n < kNodes; ++n)
    tied.nodes[static_cast<std::size_t>(n)].rotation =
        RotationTie<double>{truth<double>(n).rotation, Mat3<double>::Identity() / radians(0.2)};
  REQUIRE(improved(PoseGraphSolver<double>().solve(bent)));
  REQUIRE(improved(PoseGraphSolver<double>().solve(tied)));
  const auto turn = [](const PoseGraph<double>& graph) {
    double worst = 0;
    for (int n = 0; n < kNodes; ++n)
      worst = std::max(worst, angle_between(graph.nodes[static_cast<std::size_t>(n)].cam_from_world.rotation,
                                            truth<double>(n).rotation));
    return degrees(worst);
  };
  CHECK(turn(tied) < 0.1);
  CHECK(turn(tied) < 0.2 * turn(bent));
  CHECK(worst_place(tied) < worst_place(bent));
}

TEST_CASE("A graph without edges or with numbers that are none is left as it is") {
  PoseGraph<double> graph = drifted_ring(small_drift<double>());
  const auto edges = graph.edges;
  graph.edges.clear();
  CHECK(PoseGraphSolver<double>().solve(graph).status == Status::kTooFew);
  graph.edges = edges;
  graph.edges[5].to_from.translation.x() = std::numeric_limits<double>::quiet_NaN();
  const Vec3<double> before = graph.nodes[20].cam_from_world.translation;
  CHECK(PoseGraphSolver<double>().solve(graph).status == Status::kNotFinite);
  CHECK(graph.nodes[20].cam_from_world.translation == before);
  graph.edges = edges;
  for (auto& node : graph.nodes) node.cam_from_world.scale *= -1;
  CHECK(PoseGraphSolver<double>().solve(graph).status == Status::kNotFinite);
  CHECK(graph.nodes[20].cam_from_world.translation == before);
}
