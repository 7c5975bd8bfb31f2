// SPDX-License-Identifier: BSD-3-Clause
// The landmarks' part of the normal equations of a bundle adjustment, kept by block, and its elimination
// (Schur complement; Triggs et al., Bundle Adjustment - A Modern Synthesis, 2000, section 6.1).
#pragma once

#include <algorithm>
#include <vector>

#include "sslam/solver/least_squares/block_kernels.hpp"
#include "sslam/solver/least_squares/positive_inverse.hpp"

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

// The mixed block of a landmark and what is not eliminated, a view or a plane: it begins at `row` of the
// reduced system, or nowhere (kHeld) when it does not move.
template <Scalar S, int Rows, int D>
struct MixedBlock {
  Mat<S, Rows, D> W;
  Eigen::Index row;
};
inline constexpr Eigen::Index kHeld = -1;

template <Scalar S, int D>
class LandmarkSide {
 public:
  std::vector<BlockEquations<S, D>> landmarks;
  std::vector<MixedBlock<S, 6, D>> mixed;   // one for each edge
  std::vector<MixedBlock<S, 3, D>> planes;  // one for each landmark
  std::vector<Vec<S, D>> steps;

  void reset(std::size_t landmark_count, std::size_t edge_count) {
    landmarks.assign(landmark_count, {});
    mixed.resize(edge_count);
    for (auto& m : mixed) m.row = kHeld;
    planes.resize(landmark_count);
    for (auto& m : planes) m.row = kHeld;
    steps.assign(landmark_count, Vec<S, D>::Zero());
    roots_.resize(landmark_count);
  }

  // Takes landmark i, with its edges [first, last), out of the system of views and planes: S -= W H^-1 W^T, b
  // -= W H^-1 g, with Y = W L^-T where H = L L^T.
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
      const Eigen::Index row = mixed[e].row;
      if (row == kHeld) continue;
      Mat<S, 6, D>& y = reduced_[e - first];
      y = times_transposed_lower<S, 6, D>(mixed[e].W, roots_[i]);
      for (int d = 0; d < D; ++d)
        for (int r = 0; r < 6; ++r) right[row + r] -= y(r, d) * z[d];
      for (std::size_t f = first; f <= e; ++f) {
        const Eigen::Index col = mixed[f].row;
        if (col == kHeld) continue;
        const Mat<S, 6, D>& other = reduced_[f - first];
        if (row >= col) subtract_outer<S, 6, 6, D>(y, other, system.block(row, col), system.stride(row));
        if (row <= col && f != e)
          subtract_outer<S, 6, 6, D>(other, y, system.block(col, row), system.stride(col));
      }
    }
    const Eigen::Index row = planes[i].row;  // below those of the views
    if (row == kHeld) return;
    const Mat<S, 3, D> y = times_transposed_lower<S, 3, D>(planes[i].W, roots_[i]);
    for (int d = 0; d < D; ++d)
      for (int r = 0; r < 3; ++r) right[row + r] -= y(r, d) * z[d];
    for (std::size_t e = first; e < last; ++e)
      if (mixed[e].row != kHeld)
        subtract_outer<S, 3, 6, D>(y, reduced_[e - first], system.block(row, mixed[e].row),
                                   system.stride(row));
    subtract_outer<S, 3, 3, D>(y, y, system.block(row, row), system.stride(row));
  }

  // The landmark's own step once those of views and planes are known: H^-1 (-g - sum W^T d).
  template <class Step>
  void substitute(std::size_t i, std::size_t first, std::size_t last, const Step& known) {
    Vec<S, D> right = -landmarks[i].g;
    for (std::size_t e = first; e < last; ++e)
      if (mixed[e].row != kHeld)
        add_product<S, 6, D>(mixed[e].W, known.template segment<6>(mixed[e].row), S(-1), right);
    if (planes[i].row != kHeld)
      add_product<S, 3, D>(planes[i].W, known.template segment<3>(planes[i].row), S(-1), right);
    steps[i] = roots_[i].transpose() * (roots_[i] * right);
  }

 private:
  std::vector<Mat<S, D, D>> roots_;    // L^-1
  std::vector<Mat<S, 6, D>> reduced_;  // of one landmark's edges
};

}  // namespace sslam
