// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/solver/bundle/block_cholesky.hpp"

#include <Eigen/Dense>
#include <vector>

#include "sslam/core/random.hpp"
#include "support/catch.hpp"
#include "support/test_scalars.hpp"

namespace block_cholesky_test {

using namespace sslam;

// Which blocks of the lower half are not zero, by row: a chain, one loop, and a row that most see.
const std::vector<std::vector<int>> kColumns{{0}, {0, 1}, {1, 2}, {2, 3}, {3, 4}, {0, 4, 5}, {1, 3, 5, 6}};

template <Scalar S>
using Dense = Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic>;

// Positive definite, with these blocks alone.
template <Scalar S>
Dense<S> matrix() {
  const auto size = static_cast<Eigen::Index>(6 * kColumns.size());
  Random random(3);
  Dense<S> a = Dense<S>::Zero(size, size);
  for (std::size_t r = 0; r < kColumns.size(); ++r)
    for (const int c : kColumns[r])
      for (int i = 0; i < 6; ++i)
        for (int j = 0; j < 6; ++j)
          a(6 * static_cast<int>(r) + i, 6 * c + j) = random.uniform(S(-0.5), S(0.5));
  Dense<S> lower = a.template triangularView<Eigen::StrictlyLower>();
  return lower + lower.transpose() + S(30) * Dense<S>::Identity(size, size);
}

template <Scalar S>
void fill(const Dense<S>& a, BlockCholesky<S>& cholesky) {
  cholesky.clear();
  for (std::size_t r = 0; r < kColumns.size(); ++r)
    for (const int c : kColumns[r])
      cholesky.add(static_cast<int>(r), c, a.template block<6, 6>(6 * static_cast<int>(r), 6 * c));
}

}  // namespace block_cholesky_test

TEMPLATE_TEST_CASE("A sparse matrix of blocks is solved as a dense one is", "", SSLAM_TEST_SCALARS) {
  using namespace block_cholesky_test;
  using S = TestType;
  const Dense<S> a = matrix<S>();
  BlockCholesky<S> cholesky;
  cholesky.analyse(kColumns);
  for (int time = 0; time < 2; ++time) {  // the same pattern serves again
    fill<S>(a, cholesky);
    REQUIRE(cholesky.factor());
    const typename BlockCholesky<S>::VecX right = BlockCholesky<S>::VecX::LinSpaced(a.rows(), S(-1), S(2));
    typename BlockCholesky<S>::VecX x = right;
    cholesky.solve(x);
    CHECK((a * x - right).norm() < (sizeof(S) == 4 ? S(1e-4) : S(1e-12)));
    CHECK((x - a.ldlt().solve(right)).norm() < (sizeof(S) == 4 ? S(1e-5) : S(1e-13)));
  }
}

TEST_CASE("A sparse matrix of blocks that is not positive definite is refused") {
  using namespace block_cholesky_test;
  Dense<double> a = matrix<double>();
  a(20, 20) = -1;
  BlockCholesky<double> cholesky;
  cholesky.analyse(kColumns);
  fill<double>(a, cholesky);
  CHECK_FALSE(cholesky.factor());
  // Positive on the diagonal, and indefinite by a block beside it.
  a = matrix<double>();
  a(6, 0) = a(0, 6) = 100;
  fill<double>(a, cholesky);
  CHECK_FALSE(cholesky.factor());
}

TEST_CASE("Blocks that are cleared are zero, and none need stand beside the diagonal") {
  using namespace block_cholesky_test;
  const std::vector<std::vector<int>> diagonal{{0}, {1}};
  BlockCholesky<double> cholesky;
  cholesky.analyse(diagonal);
  cholesky.clear();
  CHECK_FALSE(cholesky.factor());
  for (int r = 0; r < 2; ++r) cholesky.add(r, r, (r + 1) * BlockCholesky<double>::Block::Identity());
  REQUIRE(cholesky.factor());
  BlockCholesky<double>::VecX x = BlockCholesky<double>::VecX::Constant(12, 4);
  cholesky.solve(x);
  CHECK((x.head<6>().array() - 4).matrix().norm() < 1e-15);
  CHECK((x.tail<6>().array() - 2).matrix().norm() < 1e-15);
}
