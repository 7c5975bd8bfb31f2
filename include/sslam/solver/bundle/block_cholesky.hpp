// SPDX-License-Identifier: BSD-3-Clause
// Cholesky factorisation of a sparse symmetric matrix of square blocks: the views of a whole map share
// landmarks with few others. Ordered by approximate minimum degree, column by column, looking to the right.
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/OrderingMethods>
#include <Eigen/SparseCore>
#include <algorithm>
#include <cstddef>
#include <vector>

#include "sslam/core/types.hpp"

namespace sslam {

template <Scalar S, int Side = 6>
class BlockCholesky {
 public:
  static constexpr int kSide = Side;
  using Block = Mat<S, kSide, kSide>;
  using VecX = Eigen::Matrix<S, Eigen::Dynamic, 1>;

  // columns[r]: where row r has blocks left of the diagonal, or on it.
  void analyse(const std::vector<std::vector<int>>& columns) {
    order(columns);
    const std::size_t size = columns.size();
    std::vector<std::vector<int>> below(size);  // of each column, in its new place
    for (std::size_t r = 0; r < size; ++r)
      for (const int c : columns[r]) {
        const int a = place_[r], b = place_[static_cast<std::size_t>(c)];
        if (a != b) below[index(std::min(a, b))].push_back(std::max(a, b));
      }
    first_.assign(1, 0);
    rows_.clear();
    for (std::size_t c = 0; c < size; ++c) {
      std::vector<int>& here = below[c];
      std::sort(here.begin(), here.end());
      here.erase(std::unique(here.begin(), here.end()), here.end());
      rows_.insert(rows_.end(), here.begin(), here.end());
      first_.push_back(rows_.size());
      if (here.empty()) continue;  // what is left of it comes to the next column that it reaches
      std::vector<int>& next = below[index(here.front())];
      next.insert(next.end(), here.begin() + 1, here.end());
      here = {};
    }
    diagonal_.resize(size);
    blocks_.resize(rows_.size());
  }

  void clear() {
    std::fill(diagonal_.begin(), diagonal_.end(), Block::Zero());
    std::fill(blocks_.begin(), blocks_.end(), Block::Zero());
  }

  // To a block of the lower half, which analyse() has been told of.
  void add(int row, int col, const Block& block) {
    const int a = place_[index(row)], b = place_[index(col)];
    if (a == b)
      diagonal_[index(a)] += block;
    else if (a > b)
      blocks_[find(a, index(b))] += block;
    else
      blocks_[find(b, index(a))] += block.transpose();
  }

  // False where the matrix is not positive definite.
  [[nodiscard]] bool factor() {
    for (std::size_t c = 0; c < diagonal_.size(); ++c) {
      const Eigen::LLT<Block> root(diagonal_[c]);
      if (root.info() != Eigen::Success) return false;
      diagonal_[c] = root.matrixL();
      for (std::size_t i = first_[c]; i < first_[c + 1]; ++i)
        blocks_[i] = root.matrixL().solve(blocks_[i].transpose()).transpose();
      for (std::size_t i = first_[c]; i < first_[c + 1]; ++i) subtract_from_column(c, i);
    }
    return true;
  }

  // After factor(); in place.
  void solve(VecX& x) {
    sorted_.resize(x.size());
    for (std::size_t r = 0; r < place_.size(); ++r) part(sorted_, index(place_[r])) = part(x, r);
    for (std::size_t c = 0; c < diagonal_.size(); ++c) {
      diagonal_[c].template triangularView<Eigen::Lower>().solveInPlace(part(sorted_, c));
      for (std::size_t i = first_[c]; i < first_[c + 1]; ++i)
        part(sorted_, index(rows_[i])) -= blocks_[i] * part(sorted_, c);
    }
    for (std::size_t c = diagonal_.size(); c-- > 0;) {
      for (std::size_t i = first_[c]; i < first_[c + 1]; ++i)
        part(sorted_, c) -= blocks_[i].transpose() * part(sorted_, index(rows_[i]));
      diagonal_[c].transpose().template triangularView<Eigen::Upper>().solveInPlace(part(sorted_, c));
    }
    for (std::size_t r = 0; r < place_.size(); ++r) part(x, r) = part(sorted_, index(place_[r]));
  }

 private:
  [[nodiscard]] static std::size_t index(int i) noexcept { return static_cast<std::size_t>(i); }
  [[nodiscard]] static auto part(VecX& x, std::size_t block) {
    return x.template segment<kSide>(kSide * static_cast<Eigen::Index>(block));
  }

  void order(const std::vector<std::vector<int>>& columns) {
    std::vector<Eigen::Triplet<S>> marks;
    for (std::size_t r = 0; r < columns.size(); ++r)
      for (const int c : columns[r]) {
        marks.emplace_back(static_cast<int>(r), c, S(1));
        marks.emplace_back(c, static_cast<int>(r), S(1));
      }
    const auto size = static_cast<Eigen::Index>(columns.size());
    Eigen::SparseMatrix<S> pattern(size, size);
    pattern.setFromTriplets(marks.begin(), marks.end());
    Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> new_to_old;
    Eigen::AMDOrdering<int>()(pattern, new_to_old);
    place_.resize(columns.size());
    for (Eigen::Index i = 0; i < size; ++i) place_[index(new_to_old.indices()[i])] = static_cast<int>(i);
  }

  [[nodiscard]] std::size_t find(int row, std::size_t col) const {
    const auto begin = rows_.begin() + static_cast<std::ptrdiff_t>(first_[col]);
    const auto end = rows_.begin() + static_cast<std::ptrdiff_t>(first_[col + 1]);
    return static_cast<std::size_t>(std::lower_bound(begin, end, row) - rows_.begin());
  }

  // What block k of column c takes from the column of its row: all rows of c from there on are in it.
  void subtract_from_column(std::size_t c, std::size_t k) {
    const std::size_t col = index(rows_[k]);
    const Block other = blocks_[k].transpose();
    diagonal_[col].noalias() -= blocks_[k] * other;
    std::size_t at = first_[col];
    for (std::size_t i = k + 1; i < first_[c + 1]; ++i) {
      while (rows_[at] != rows_[i]) ++at;
      blocks_[at].noalias() -= blocks_[i] * other;
    }
  }

  std::vector<int> place_;          // of each row in the order of elimination
  std::vector<std::size_t> first_;  // block of each column, and the end
  std::vector<int> rows_;           // of each block, ascending within a column
  std::vector<Block> diagonal_, blocks_;
  VecX sorted_;
};

}  // namespace sslam
