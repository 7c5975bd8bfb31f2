// SPDX-License-Identifier: BSD-3-Clause
// Solves a BundleGraph with Ceres: landmarks are eliminated first, what remains is dense and small.
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <vector>

#include "sslam/ceres/bundle_blocks.hpp"
#include "sslam/ceres/plane_costs.hpp"
#include "sslam/ceres/schur_problem.hpp"
#include "sslam/core/parameter.hpp"
#include "sslam/solver/bundle/bundle_summary.hpp"

namespace sslam {

struct CeresBundleOptions {
  int max_iterations = 8;
  double function_tolerance = 1e-4;  // relative decrease of the cost below which it stops
  int num_threads = 1;
  bool sparse = false;  // of the reduced system: worth it for hundreds of keyframes
  BundleLosses<double> losses;

  template <class Self, class Visit>
  static void parameters(Self& self, Visit&& visit) {
    visit("max_iterations", self.max_iterations, Unit::kCount, 1, 10000, "steps tried at most");
    visit("function_tolerance", self.function_tolerance, Unit::kShare, 0, 1,
          "of the cost: a step that wins less is the last");
    visit("num_threads", self.num_threads, Unit::kCount, 1, 1024, "that solve");
    visit("sparse", self.sparse, Unit::kCount, 0, 1,
          "1: the reduced system is sparse, for hundreds of keyframes");
    visit_within("losses.", self.losses, visit);
  }
};
static_assert(Described<CeresBundleOptions>);

class CeresBundleSolver {
 public:
  CeresBundleOptions options;

  CeresBundleSolver() = default;
  explicit CeresBundleSolver(const CeresBundleOptions& o) : options(o) {}

  // On failure the graph is left as it was.
  BundleSummary solve(BundleGraph<double>& graph) {
    ceres::Problem problem(problem_options());
    load(graph);
    observations_ = 0;
    ordering_ = std::make_shared<ceres::ParameterBlockOrdering>();
    add_points(graph, problem);
    add_lines(graph, problem);
    add_planes(graph, problem);
    add_views(graph, problem);
    ceres::Solver::Summary answer;
    if (observations_ > 0) ceres::Solve(solver_options(), &problem, &answer);
    const BundleSummary summary = summarise(answer);
    if (improved(summary)) blocks_.store(graph);
    release();
    return summary;
  }

 private:
  [[nodiscard]] static ceres::Problem::Options problem_options() {
    ceres::Problem::Options o = borrowing_problem();
    o.disable_all_safety_checks = true;
    return o;
  }

  [[nodiscard]] ceres::Solver::Options solver_options() const {
    ceres::Solver::Options o = schur_options(options.sparse, ordering_);
    o.max_num_iterations = options.max_iterations;
    o.function_tolerance = options.function_tolerance;
    o.num_threads = options.num_threads;
    return o;
  }

  void load(const BundleGraph<double>& graph) {
    blocks_.load(graph);
    point_loss_ = std::make_unique<ceres::CauchyLoss>(options.losses.point);
    line_loss_ = std::make_unique<ceres::CauchyLoss>(options.losses.line);
    rotation_loss_ = std::make_unique<ceres::CauchyLoss>(options.losses.rotation);
    axis_loss_ = std::make_unique<ceres::CauchyLoss>(options.losses.axis);
    plane_loss_ = std::make_unique<ceres::CauchyLoss>(options.losses.plane);
  }

  // The edges of one landmark, whose block this is. False: none can be evaluated.
  template <class Cost, class Edge>
  bool add_edges(const BundleGraph<double>& graph, const std::vector<Edge>& edges, std::int32_t first,
                 std::int32_t last, std::deque<Cost>& costs, ceres::LossFunction& loss, double* block,
                 ceres::Problem& problem) {
    const int before = observations_;
    for (auto e = first; e < last; ++e) {
      const Edge& edge = edges[static_cast<std::size_t>(e)];
      const auto view = static_cast<std::size_t>(edge.view);
      costs.emplace_back(edge, graph.views[view].pinhole);
      if (add_observation(costs.back(), loss, problem, blocks_.poses[view].data(), block)) ++observations_;
    }
    return observations_ > before;
  }

  void add_points(const BundleGraph<double>& graph, ceres::Problem& problem) {
    for (std::size_t i = 0; i < graph.points.size(); ++i) {
      double* const block = blocks_.points[i].data();
      if (add_edges(graph, graph.point_edges, graph.points[i].first_edge, graph.points[i].last_edge,
                    point_costs_, *point_loss_, block, problem))
        ordering_->AddElementToGroup(block, 0);
    }
  }

  void add_lines(const BundleGraph<double>& graph, ceres::Problem& problem) {
    for (std::size_t i = 0; i < graph.lines.size(); ++i) {
      double* const block = blocks_.lines[i].data();
      if (!add_edges(graph, graph.line_edges, graph.lines[i].first_edge, graph.lines[i].last_edge,
                     line_costs_, *line_loss_, block, problem))
        continue;
      problem.SetManifold(block, &line_manifold_);
      ordering_->AddElementToGroup(block, 0);
      if (!graph.lines[i].axis) continue;
      axis_costs_.emplace_back(*graph.lines[i].axis, options.losses.axis_sigma);
      problem.AddResidualBlock(&axis_costs_.back(), axis_loss_.get(), block);
    }
  }

  void add_planes(const BundleGraph<double>& graph, ceres::Problem& problem) {
    const double sigma = options.losses.flatness * graph.depth;
    for (std::size_t p = 0; p < graph.planes.size(); ++p) {
      double* const block = blocks_.planes[p].data();
      plane_held_costs_.emplace_back(graph.planes[p].held, sigma);
      problem.AddResidualBlock(&plane_held_costs_.back(), nullptr, block);
      problem.SetManifold(block, &plane_manifold_);
      ordering_->AddElementToGroup(block, 1);
      if (!graph.planes[p].axis) continue;
      plane_axis_costs_.emplace_back(*graph.planes[p].axis, options.losses.axis_sigma);
      problem.AddResidualBlock(&plane_axis_costs_.back(), axis_loss_.get(), block);
    }
    const auto tie = [&](ceres::CostFunction& cost, std::int32_t plane, double* landmark) {
      if (!problem.HasParameterBlock(landmark)) return;  // no observation of it can be evaluated
      problem.AddResidualBlock(&cost, plane_loss_.get(),
                               blocks_.planes[static_cast<std::size_t>(plane)].data(), landmark);
    };
    for (std::size_t i = 0; i < graph.points.size(); ++i) {
      if (graph.points[i].plane == kNoPlane) continue;
      point_tie_costs_.emplace_back(sigma);
      tie(point_tie_costs_.back(), graph.points[i].plane, blocks_.points[i].data());
    }
    for (std::size_t i = 0; i < graph.lines.size(); ++i) {
      if (graph.lines[i].plane == kNoPlane) continue;
      line_tie_costs_.emplace_back(graph.lines[i].start, graph.lines[i].end, sigma);
      tie(line_tie_costs_.back(), graph.lines[i].plane, blocks_.lines[i].data());
    }
  }

  void add_views(const BundleGraph<double>& graph, ceres::Problem& problem) {
    for (std::size_t v = 0; v < graph.views.size(); ++v) {
      const BundleView<double>& view = graph.views[v];
      double* const block = blocks_.poses[v].data();
      if (view.rotation && view.hold != Hold::kPose) {
        rotation_costs_.emplace_back(*view.rotation);
        problem.AddResidualBlock(&rotation_costs_.back(), rotation_loss_.get(), block);
      }
      if (graph.scale && graph.scale->free == static_cast<std::int32_t>(v)) {
        const auto held = static_cast<std::size_t>(graph.scale->held);
        scale_costs_.emplace_back(graph.views[held].cam_from_world.inverse().translation,
                                  graph.scale->distance, options.losses.scale_sigma);
        problem.AddResidualBlock(&scale_costs_.back(), nullptr, block);
      }
      if (!problem.HasParameterBlock(block)) continue;
      ordering_->AddElementToGroup(block, 1);
      if (view.hold == Hold::kPose)
        problem.SetParameterBlockConstant(block);
      else if (view.hold == Hold::kCentre)
        problem.SetManifold(block, &turning_manifold_);
      else
        problem.SetManifold(block, &pose_manifold_);
    }
  }

  [[nodiscard]] BundleSummary summarise(const ceres::Solver::Summary& answer) const {
    BundleSummary out;
    out.iterations = static_cast<int>(answer.iterations.size()) - 1;
    out.initial_cost = answer.initial_cost;
    out.final_cost = answer.final_cost;
    if (answer.termination_type == ceres::CONVERGENCE)
      out.status = Status::kOk;
    else if (answer.termination_type == ceres::NO_CONVERGENCE)
      out.status = Status::kNotConverged;
    else if (answer.num_residual_blocks > 0)
      out.status = Status::kDegenerate;
    else
      return out;
    if (!blocks_.finite()) out.status = Status::kNotFinite;
    return out;
  }

  void release() {
    point_costs_.clear();
    line_costs_.clear();
    rotation_costs_.clear();
    axis_costs_.clear();
    scale_costs_.clear();
    point_tie_costs_.clear();
    line_tie_costs_.clear();
    plane_held_costs_.clear();
    plane_axis_costs_.clear();
    ordering_.reset();
  }

  BundleBlocks blocks_;
  std::deque<PointCost> point_costs_;  // Ceres' cost functions cannot move
  std::deque<LineCost> line_costs_;
  std::deque<RotationTieCost> rotation_costs_;
  std::deque<AxisTieCost> axis_costs_;
  std::deque<ScaleTieCost> scale_costs_;
  std::deque<PointOnPlaneCost> point_tie_costs_;
  std::deque<LineOnPlaneCost> line_tie_costs_;
  std::deque<PlaneHeldCost> plane_held_costs_;
  std::deque<PlaneAxisCost> plane_axis_costs_;
  std::unique_ptr<ceres::LossFunction> point_loss_, line_loss_, rotation_loss_, axis_loss_, plane_loss_;
  PoseManifold pose_manifold_;
  TurningPoseManifold turning_manifold_;
  LineManifold line_manifold_;
  PlaneManifold plane_manifold_;
  std::shared_ptr<ceres::ParameterBlockOrdering> ordering_;
  int observations_ = 0;  // of points and lines, in the problem
};

}  // namespace sslam
