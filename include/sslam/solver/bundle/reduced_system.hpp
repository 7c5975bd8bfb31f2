// SPDX-License-Identifier: BSD-3-Clause
// The system of a bundle adjustment that is left when its landmarks are eliminated: views of six rows, below
// them planes of three. Dense for a window; sparse for a whole map, most of whose views share nothing.
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cstddef>
#include <vector>

#include "sslam/core/types.hpp"

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
    fill(right.size());
    if (grown_) factor_.analyzePattern(upper_);
    grown_ = false;
    factor_.factorize(upper_);
    if (factor_.info() != Eigen::Success) return false;
    solution = factor_.solve(right);
    return true;
  }

 private:
  using Sparse = Eigen::SparseMatrix<S>;
  struct Entry {
    Eigen::Index col;
    std::size_t first;  // of the block's values, column by column
  };

  [[nodiscard]] std::size_t number(Eigen::Index at) const noexcept {
    return static_cast<std::size_t>(at < 6 * views_ ? at / 6 : views_ + (at - 6 * views_) / 3);
  }
  [[nodiscard]] Eigen::Index begin_of(std::size_t number) const noexcept {
    const auto n = static_cast<Eigen::Index>(number);
    return n < views_ ? 6 * n : 6 * views_ + 3 * (n - views_);
  }

  // A row of blocks of the lower half is a column of the upper one.
  void fill(Eigen::Index size) {
    upper_.resize(size, size);
    upper_.reserve(static_cast<Eigen::Index>(values_.size()));
    for (std::size_t n = 0; n < rows_.size(); ++n) {
      const Eigen::Index row = begin_of(n), height = stride(row);
      for (Eigen::Index r = 0; r < height; ++r) {
        upper_.startVec(row + r);
        for (const Entry& entry : rows_[n]) {
          const Eigen::Index width = entry.col == row ? r + 1 : stride(entry.col);
          for (Eigen::Index c = 0; c < width; ++c)
            upper_.insertBack(entry.col + c, row + r) =
                values_[entry.first + static_cast<std::size_t>(c * height + r)];
        }
      }
    }
    upper_.finalize();
  }

  Eigen::Index views_ = 0;
  std::vector<std::vector<Entry>> rows_;  // of each view and plane, from left to right
  std::vector<S> values_;
  bool grown_ = false;  // since the pattern was looked at
  Sparse upper_;
  Eigen::SimplicialLLT<Sparse, Eigen::Upper> factor_;
};

}  // namespace sslam
