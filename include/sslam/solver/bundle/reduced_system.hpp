// SPDX-License-Identifier: BSD-3-Clause
// The system of a bundle adjustment that is left when its landmarks are eliminated: views of six rows, below
// them planes of three. Dense for a window; sparse for a whole map, most of whose views share nothing.
#pragma once

#include <Eigen/Cholesky>
#include <algorithm>
#include <cstddef>
#include <vector>

#include "sslam/core/types.hpp"
#include "sslam/solver/bundle/block_cholesky.hpp"

namespace sslam {

template <Scalar S>
class DenseSystem {
 public:
  using VecX = Eigen::Matrix<S, Eigen::Dynamic, 1>;

  void begin(Eigen::Index views, Eigen::Index planes) {
    const Eigen::Index size = 6 * views + 3 * planes;
    lower_.setZero(size, size);
  }
  // The block that begins there, not above the diagonal; its columns lie `stride` apart.
  [[nodiscard]] S* block(Eigen::Index row, Eigen::Index col) noexcept { return &lower_(row, col); }
  [[nodiscard]] Eigen::Index stride(Eigen::Index) const noexcept { return lower_.rows(); }

  [[nodiscard]] bool solve(const VecX& right, VecX& solution) {
    factor_.compute(lower_);
    if (factor_.info() != Eigen::Success) return false;
    solution = factor_.solve(right);
    return true;
  }

 private:
  using MatX = Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic>;
  MatX lower_;
  Eigen::LLT<MatX> factor_;
};

// The same by blocks, which come to be when they are first asked for and stay until forget().
template <Scalar S>
class SparseSystem {
 public:
  using VecX = Eigen::Matrix<S, Eigen::Dynamic, 1>;

  // The graph is another one.
  void forget() noexcept {
    rows_.clear();
    values_.clear();
  }

  void begin(Eigen::Index views, Eigen::Index planes) {
    views_ = views;
    rows_.resize(static_cast<std::size_t>(views + planes));
    std::fill(values_.begin(), values_.end(), S(0));
  }

  // Valid until the next block is asked for.
  [[nodiscard]] S* block(Eigen::Index row, Eigen::Index col) {
    std::vector<Entry>& entries = rows_[number(row)];
    const auto at = std::lower_bound(entries.begin(), entries.end(), col,
                                     [](const Entry& entry, Eigen::Index c) { return entry.col < c; });
    if (at != entries.end() && at->col == col) return &values_[at->first];
    const std::size_t first = values_.size();
    values_.resize(first + static_cast<std::size_t>(stride(row) * stride(col)), S(0));
    entries.insert(at, {col, first});
    grown_ = true;
    return &values_[first];
  }
  [[nodiscard]] Eigen::Index stride(Eigen::Index at) const noexcept { return at < 6 * views_ ? 6 : 3; }

  [[nodiscard]] bool solve(const VecX& right, VecX& solution) {
    if (grown_) analyse();
    grown_ = false;
    fill();
    if (!factor_.factor()) return false;
    solution.setZero(kSide * static_cast<Eigen::Index>(rows_.size()));
    solution.head(6 * views_) = right.head(6 * views_);
    for_planes([&](Eigen::Index from, Eigen::Index into) {
      solution.template segment<3>(into) = right.template segment<3>(from);
    });
    factor_.solve(solution);
    for_planes([&](Eigen::Index from, Eigen::Index into) {  // upwards: none is overwritten before it moves
      const Vec3<S> step = solution.template segment<3>(into);
      solution.template segment<3>(from) = step;
    });
    solution.conservativeResize(right.size());
    return true;
  }

 private:
  static constexpr Eigen::Index kSide = BlockCholesky<S>::kSide;
  struct Entry {
    Eigen::Index col;
    std::size_t first;  // of the block's values, column by column
  };

  [[nodiscard]] std::size_t number(Eigen::Index at) const noexcept {
    return static_cast<std::size_t>(at < 6 * views_ ? at / 6 : views_ + (at - 6 * views_) / 3);
  }
  // A plane takes a block of six of the factor, whose second half stands for itself.
  template <class F>
  void for_planes(F f) const {
    const auto planes = static_cast<Eigen::Index>(rows_.size()) - views_;
    for (Eigen::Index p = 0; p < planes; ++p) f(6 * views_ + 3 * p, kSide * (views_ + p));
  }

  void analyse() {
    std::vector<std::vector<int>> columns(rows_.size());
    for (std::size_t n = 0; n < rows_.size(); ++n)
      for (const Entry& entry : rows_[n]) columns[n].push_back(static_cast<int>(number(entry.col)));
    factor_.analyse(columns);
  }

  void fill() {
    factor_.clear();
    for (std::size_t n = 0; n < rows_.size(); ++n)
      for (const Entry& entry : rows_[n]) {
        const std::size_t col = number(entry.col);
        const Eigen::Index height = static_cast<Eigen::Index>(n) < views_ ? 6 : 3;
        const Eigen::Index width = stride(entry.col);
        Mat<S, kSide, kSide> block = Mat<S, kSide, kSide>::Zero();
        if (n == col) block.setIdentity();
        for (Eigen::Index c = 0; c < width; ++c)
          for (Eigen::Index r = 0; r < height; ++r)
            block(r, c) = values_[entry.first + static_cast<std::size_t>(c * height + r)];
        factor_.add(static_cast<int>(n), static_cast<int>(col), block);
      }
  }

  Eigen::Index views_ = 0;
  std::vector<std::vector<Entry>> rows_;  // of each view and plane, from left to right
  std::vector<S> values_;
  bool grown_ = false;  // since the pattern was looked at
  BlockCholesky<S> factor_;
};

}  // namespace sslam
