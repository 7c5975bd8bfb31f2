// SPDX-License-Identifier: BSD-3-Clause
// Self-calibration: the camera that a map's observations ask for. Keyframes, points and lines are adjusted
// with the camera as one more unknown; the map itself stays as it is.
#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>
#include <memory>
#include <vector>

#include "sslam/ceres/bundle_blocks.hpp"
#include "sslam/ceres/camera_estimate.hpp"
#include "sslam/ceres/lens_costs.hpp"
#include "sslam/ceres/marginal_covariance.hpp"
#include "sslam/ceres/schur_problem.hpp"
#include "sslam/map/bundle_window.hpp"

namespace sslam {

struct CameraAdjustmentOptions {
  CameraPrior prior;
  BundleLosses<double> losses;
  std::size_t max_keyframes = 60;  // the first ones of the map: more tell little that is new
  int max_iterations = 20;
  double function_tolerance = 1e-4;  // relative decrease of the cost below which it stops
};

class CameraAdjustment {
 public:
  CameraAdjustmentOptions options;

  // `camera` is the one that the map's features were undistorted with. What holds the gauge in the graph is
  // not looked at: the first view stays, and the farthest one from it keeps its distance.
  [[nodiscard]] CameraEstimate estimate(const Map<double>& map, const Camera<double>& camera) {
    BundleWindowOptions<double> window;
    // Both were found with the given camera, and would speak for it.
    window.planes = window.manhattan = false;
    if (std::none_of(map.keyframes.begin(), map.keyframes.end(), [](const auto& kf) { return kf.alive(); }))
      return {.camera = camera};
    window_.gather_all(map, window);
    return estimate(window_.graph, camera);
  }
  [[nodiscard]] CameraEstimate estimate(const BundleGraph<double>& graph, const Camera<double>& camera);

 private:
  // Edges to the views that take part; a landmark needs two.
  template <class Edge>
  [[nodiscard]] bool seen_twice(const std::vector<Edge>& edges, std::int32_t first, std::int32_t last) const {
    return std::count_if(edges.begin() + first, edges.begin() + last,
                         [this](const Edge& edge) { return takes_part(edge.view); }) >= 2;
  }
  [[nodiscard]] bool takes_part(std::int32_t view) const noexcept {
    return static_cast<std::size_t>(view) < options.max_keyframes;
  }
  void add_landmarks(const BundleGraph<double>& graph, const Camera<double>& camera,
                     ceres::LossFunction& point_loss, ceres::LossFunction& line_loss,
                     ceres::Problem& problem);
  void add_views(const BundleGraph<double>& graph, ceres::Problem& problem);
  template <class Cost, class Edge, class Observed>
  bool add(std::deque<Cost>& costs, const Camera<double>& camera, const Edge& edge, const Observed& raw,
           ceres::LossFunction& loss, double* landmark, ceres::Problem& problem);
  [[nodiscard]] ceres::Solver::Options solver_options() const;

  BundleWindow<double> window_;
  BundleBlocks blocks_;
  LensBlock lens_{};
  std::deque<LensPointCost> point_costs_;  // Ceres' cost functions cannot move
  std::deque<LensLineCost> line_costs_;
  std::deque<ScaleTieCost> scale_costs_;
  PoseManifold pose_manifold_;
  LineManifold line_manifold_;
  std::shared_ptr<ceres::ParameterBlockOrdering> ordering_;
  int observations_ = 0;
};

inline CameraEstimate CameraAdjustment::estimate(const BundleGraph<double>& graph,
                                                 const Camera<double>& camera) {
  CameraEstimate out;
  out.camera = camera;
  ceres::Problem problem(borrowing_problem());
  ceres::CauchyLoss point_loss(options.losses.point), line_loss(options.losses.line);
  LensPriorCost prior(options.prior.sigma(camera));
  blocks_.load(graph);
  lens_.fill(0);
  observations_ = 0;
  ordering_ = std::make_shared<ceres::ParameterBlockOrdering>();
  problem.AddResidualBlock(&prior, nullptr, lens_.data());
  ordering_->AddElementToGroup(lens_.data(), 1);
  add_landmarks(graph, camera, point_loss, line_loss, problem);
  add_views(graph, problem);
  out.observations = observations_;
  if (observations_ > 0) {
    ceres::Solver::Summary summary;
    ceres::Solve(solver_options(), &problem, &summary);
    const LensChange<double> change(lens_.data());
    const bool solved = summary.IsSolutionUsable() && blocks_.finite() && change.allFinite() &&
                        marginal_covariance(problem, lens_.data(), out.covariance);
    out.status = solved ? Status::kOk : Status::kDegenerate;
    if (solved) {
      out.change = change;
      out.camera = changed(camera, change);
      // By how much the cost would rise if the camera were held and all else adjusted: to second order.
      const double rise = 0.5 * change.dot(out.covariance.ldlt().solve(change));
      out.gain = rise / std::max(rise + summary.final_cost, 1e-12);
    }
  }
  point_costs_.clear();
  line_costs_.clear();
  scale_costs_.clear();
  ordering_.reset();
  return out;
}

inline ceres::Solver::Options CameraAdjustment::solver_options() const {
  ceres::Solver::Options o = schur_options(true, ordering_);
  o.max_num_iterations = options.max_iterations;
  o.function_tolerance = options.function_tolerance;
  return o;
}

template <class Cost, class Edge, class Observed>
bool CameraAdjustment::add(std::deque<Cost>& costs, const Camera<double>& camera, const Edge& edge,
                           const Observed& raw, ceres::LossFunction& loss, double* landmark,
                           ceres::Problem& problem) {
  if (!takes_part(edge.view)) return false;
  double* const pose = blocks_.poses[static_cast<std::size_t>(edge.view)].data();
  costs.emplace_back(camera, raw, edge.inverse_sigma);
  if (!add_observation(costs.back(), loss, problem, lens_.data(), pose, landmark)) return false;
  ++observations_;
  return true;
}

inline void CameraAdjustment::add_landmarks(const BundleGraph<double>& graph, const Camera<double>& camera,
                                            ceres::LossFunction& point_loss, ceres::LossFunction& line_loss,
                                            ceres::Problem& problem) {
  for (std::size_t i = 0; i < graph.points.size(); ++i) {
    if (!seen_twice(graph.point_edges, graph.points[i].first_edge, graph.points[i].last_edge)) continue;
    double* const block = blocks_.points[i].data();
    bool used = false;
    for (auto e = graph.points[i].first_edge; e < graph.points[i].last_edge; ++e) {
      const PointEdge<double>& edge = graph.point_edges[static_cast<std::size_t>(e)];
      used |= add(point_costs_, camera, edge, camera.distort_pixel(edge.pixel), point_loss, block, problem);
    }
    if (used) ordering_->AddElementToGroup(block, 0);
  }
  for (std::size_t i = 0; i < graph.lines.size(); ++i) {
    if (!seen_twice(graph.line_edges, graph.lines[i].first_edge, graph.lines[i].last_edge)) continue;
    double* const block = blocks_.lines[i].data();
    bool used = false;
    for (auto e = graph.lines[i].first_edge; e < graph.lines[i].last_edge; ++e) {
      const LineEdge<double>& edge = graph.line_edges[static_cast<std::size_t>(e)];
      const Segment2<double> raw{camera.distort_pixel(edge.segment.start),
                                 camera.distort_pixel(edge.segment.end)};
      used |= add(line_costs_, camera, edge, raw, line_loss, block, problem);
    }
    if (!used) continue;
    problem.SetManifold(block, &line_manifold_);
    ordering_->AddElementToGroup(block, 0);
  }
}

inline void CameraAdjustment::add_views(const BundleGraph<double>& graph, ceres::Problem& problem) {
  const auto centre = [&](std::size_t v) { return graph.views[v].cam_from_world.inverse().translation; };
  std::size_t farthest = 0;
  double distance = 0;
  for (std::size_t v = 0; v < graph.views.size(); ++v) {
    double* const block = blocks_.poses[v].data();
    if (!problem.HasParameterBlock(block)) continue;
    ordering_->AddElementToGroup(block, 1);
    problem.SetManifold(block, &pose_manifold_);
    if ((centre(v) - centre(0)).norm() <= distance) continue;
    distance = (centre(v) - centre(0)).norm();
    farthest = v;
  }
  if (problem.HasParameterBlock(blocks_.poses[0].data()))
    problem.SetParameterBlockConstant(blocks_.poses[0].data());
  if (farthest == 0) return;
  scale_costs_.emplace_back(centre(0), distance, options.losses.scale_sigma);
  problem.AddResidualBlock(&scale_costs_.back(), nullptr, blocks_.poses[farthest].data());
}

}  // namespace sslam
