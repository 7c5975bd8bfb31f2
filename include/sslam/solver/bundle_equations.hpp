// SPDX-License-Identifier: BSD-3-Clause
// Normal equations of a bundle adjustment, kept by block, and their solution by elimination of the landmarks
// (Schur complement; Triggs et al., Bundle Adjustment - A Modern Synthesis, 2000, section 6.1).
#pragma once

#include <Eigen/Cholesky>
#include <algorithm>
#include <vector>

#include "sslam/solver/block_kernels.hpp"
#include "sslam/solver/bundle_graph.hpp"
#include "sslam/solver/positive_inverse.hpp"

namespace sslam {

template <Scalar S, int D>
struct BlockEquations {
  Mat<S, D, D> H = Mat<S, D, D>::Zero();
  Vec<S, D> g = Vec<S, D>::Zero();

  template <int Rows>
  void add(const Mat<S, Rows, D>& derivative, const Vec<S, Rows>& error, S weight) noexcept {
    add_square<S, Rows, D>(derivative, weight, H);
    add_product<S, Rows, D>(derivative, error, weight, g);
  }
};

// The mixed block of a landmark and a free view; slot is kHeld for a view that does not move.
template <Scalar S, int D>
struct MixedBlock {
  Mat<S, 6, D> W;
  std::int32_t slot;
};
inline constexpr std::int32_t kHeldSlot = -1;

template <Scalar S, int D>
class LandmarkSide {
 public:
  std::vector<BlockEquations<S, D>> landmarks;
  std::vector<MixedBlock<S, D>> mixed;  // one for each edge
  std::vector<Vec<S, D>> steps;

  void reset(std::size_t landmark_count, std::size_t edge_count) {
    landmarks.assign(landmark_count, {});
    mixed.resize(edge_count);
    for (auto& m : mixed) m.slot = kHeldSlot;
    steps.assign(landmark_count, Vec<S, D>::Zero());
    roots_.resize(landmark_count);
  }

  // Takes landmark i, with its edges [first, last), out of the system of the views: S -= W H^-1 W^T, b -= W
  // H^-1 g, with Y = W L^-T where H = L L^T.
  template <class System, class Right>
  void eliminate(std::size_t i, std::size_t first, std::size_t last, S damping, System& system,
                 Right& right) {
    Mat<S, D, D> damped = landmarks[i].H;
    for (int a = 0; a < D; ++a) damped(a, a) += damping * std::max(damped(a, a), S(1e-9));
    roots_[i].setZero();  // a landmark that nothing fixes stays where it is
    if (!inverse_root<S, D>(damped, roots_[i])) return;
    const Vec<S, D> z = roots_[i] * landmarks[i].g;
    reduced_.resize(last - first);
    for (std::size_t e = first; e < last; ++e) {
      const std::int32_t row = mixed[e].slot;
      if (row == kHeldSlot) continue;
      Mat<S, 6, D>& y = reduced_[e - first];
      y = times_transposed_lower<S, 6, D>(mixed[e].W, roots_[i]);
      for (int d = 0; d < D; ++d)
        for (int r = 0; r < 6; ++r) right[6 * row + r] -= y(r, d) * z[d];
      for (std::size_t f = first; f <= e; ++f) {
        const std::int32_t col = mixed[f].slot;
        if (col == kHeldSlot) continue;
        const Mat<S, 6, D>& other = reduced_[f - first];
        if (row >= col) subtract_outer<S, 6, D>(y, other, &system(6 * row, 6 * col), system.rows());
        if (row <= col && f != e) subtract_outer<S, 6, D>(other, y, &system(6 * col, 6 * row), system.rows());
      }
    }
  }

  // The landmark's own step once the views' is known: H^-1 (-g - sum W^T d).
  template <class Step>
  void substitute(std::size_t i, std::size_t first, std::size_t last, const Step& views) {
    Vec<S, D> right = -landmarks[i].g;
    for (std::size_t e = first; e < last; ++e)
      if (mixed[e].slot != kHeldSlot)
        add_product<S, 6, D>(mixed[e].W, views.template segment<6>(6 * mixed[e].slot), S(-1), right);
    steps[i] = roots_[i].transpose() * (roots_[i] * right);
  }

 private:
  std::vector<Mat<S, D, D>> roots_;    // L^-1
  std::vector<Mat<S, 6, D>> reduced_;  // of one landmark's edges
};

template <Scalar S>
class BundleEquations {
 public:
  LandmarkSide<S, 3> points;
  LandmarkSide<S, 4> lines;

  void reset(const BundleGraph<S>& graph) {
    slots_.clear();
    turning_.clear();
    std::int32_t next = 0;
    for (const BundleView<S>& v : graph.views) {
      slots_.push_back(v.hold == Hold::kPose ? kHeldSlot : next++);
      turning_.push_back(v.hold == Hold::kCentre ? 1 : 0);
    }
    views_.assign(static_cast<std::size_t>(next), {});
    points.reset(graph.points.size(), graph.point_edges.size());
    lines.reset(graph.lines.size(), graph.line_edges.size());
  }

  // The sink of BundleTerms.
  template <class Derive>
  void point(std::size_t i, std::size_t edge, std::size_t view, const Vec2<S>& error, S weight,
             Derive derive) {
    add_edge(points, i, edge, view, error, weight, derive);
  }
  template <class Derive>
  void line(std::size_t i, std::size_t edge, std::size_t view, const Vec2<S>& error, S weight,
            Derive derive) {
    add_edge(lines, i, edge, view, error, weight, derive);
  }
  void axis(std::size_t i, const Vec2<S>& error, S weight, const Mat<S, 2, 4>& by_line) {
    lines.landmarks[i].add(by_line, error, weight);
  }
  void rotation(std::size_t view, const Vec3<S>& error, S weight, const Mat3<S>& by_rotation) {
    Mat<S, 3, 6> by_view = Mat<S, 3, 6>::Zero();
    by_view.template leftCols<3>() = by_rotation;
    views_[static_cast<std::size_t>(slots_[view])].add(by_view, error, weight);
  }
  void scale(std::size_t view, S error, const Mat<S, 1, 6>& by_pose) {
    views_[static_cast<std::size_t>(slots_[view])].add(by_pose, Vec<S, 1>(error), S(1));
  }

  // Steps of everything for a damping relative to the diagonal; false when the views' system cannot be
  // factored.
  [[nodiscard]] bool solve(const BundleGraph<S>& graph, S damping) {
    const auto size = static_cast<Eigen::Index>(6 * views_.size());
    system_.setZero(size, size);
    right_.resize(size);
    for (std::size_t v = 0; v < views_.size(); ++v) {
      const auto at = static_cast<Eigen::Index>(6 * v);
      system_.template block<6, 6>(at, at) = views_[v].H;
      for (Eigen::Index a = at; a < at + 6; ++a) system_(a, a) += damping * std::max(system_(a, a), S(1e-9));
      right_.template segment<6>(at) = views_[v].g;
    }
    for_each(graph.points, [&](auto i, auto first, auto last) {
      points.eliminate(i, first, last, damping, system_, right_);
    });
    for_each(graph.lines, [&](auto i, auto first, auto last) {
      lines.eliminate(i, first, last, damping, system_, right_);
    });
    for (std::size_t v = 0; v < slots_.size(); ++v)
      if (turning_[v] != 0)
        for (int a = 3; a < 6; ++a)
          system_(6 * slots_[v] + a, 6 * slots_[v] + a) = 1;  // its gradient there is zero
    factor_.compute(system_);
    if (factor_.info() != Eigen::Success) return false;
    view_steps_ = -factor_.solve(right_);
    if (!view_steps_.allFinite()) return false;
    for_each(graph.points,
             [&](auto i, auto first, auto last) { points.substitute(i, first, last, view_steps_); });
    for_each(graph.lines,
             [&](auto i, auto first, auto last) { lines.substitute(i, first, last, view_steps_); });
    return true;
  }

  // Zero for a held view.
  [[nodiscard]] Vec6<S> view_step(std::size_t view) const {
    if (slots_[view] == kHeldSlot) return Vec6<S>::Zero();
    return view_steps_.template segment<6>(6 * slots_[view]);
  }

 private:
  template <int D, class Derive>
  void add_edge(LandmarkSide<S, D>& side, std::size_t i, std::size_t edge, std::size_t view,
                const Vec2<S>& error, S weight, Derive derive) {
    Mat<S, 2, 6> by_view;
    Mat<S, 2, D> by_landmark;
    derive(by_view, by_landmark);
    side.landmarks[i].add(by_landmark, error, weight);
    const std::int32_t slot = slots_[view];
    side.mixed[edge].slot = slot;
    if (slot == kHeldSlot) return;
    if (turning_[view] != 0) by_view.template rightCols<3>().setZero();
    views_[static_cast<std::size_t>(slot)].add(by_view, error, weight);
    side.mixed[edge].W.setZero();
    add_product<S, 2, 6, D>(by_view, by_landmark, weight, side.mixed[edge].W);
  }

  template <class Landmarks, class F>
  static void for_each(const Landmarks& landmarks, F f) {
    for (std::size_t i = 0; i < landmarks.size(); ++i)
      f(i, static_cast<std::size_t>(landmarks[i].first_edge),
        static_cast<std::size_t>(landmarks[i].last_edge));
  }

  using MatX = Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic>;
  using VecX = Eigen::Matrix<S, Eigen::Dynamic, 1>;
  std::vector<BlockEquations<S, 6>> views_;  // free ones
  std::vector<std::int32_t> slots_;          // by view: its place among the free ones
  std::vector<std::uint8_t> turning_;        // by view: 1 where the centre is held
  MatX system_;                              // lower half
  VecX right_, view_steps_;
  Eigen::LLT<MatX> factor_;
};

}  // namespace sslam
