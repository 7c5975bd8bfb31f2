// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/solver/bundle/reduced_system.hpp"

#include <cstddef>
#include <vector>

#include "sslam/core/random.hpp"
#include "support/catch.hpp"
#include "support/random_draws.hpp"

using namespace sslam;

namespace {

struct Block {
  Eigen::Index row, col;
  std::vector<double> values;  // column by column
};

// Views that share something with the next two, and planes with some of them; positive definite.
std::vector<Block> random_blocks(int views, int planes, Random& random) {
  std::vector<Block> blocks;
  const auto add = [&](Eigen::Index row, int height, Eigen::Index col, int width) {
    Block block{row, col, {}};
    for (int i = 0; i < height * width; ++i) block.values.push_back(testing::gaussian(random));
    if (row == col)
      for (int i = 0; i < height; ++i) block.values[static_cast<std::size_t>(i * (height + 1))] = 100;
    blocks.push_back(block);
  };
  for (int v = views - 1; v >= 0; --v)  // in no good order
    for (int w = v; w < views && w < v + 3; ++w) add(6 * w, 6, 6 * v, 6);
  for (int p = 0; p < planes; ++p) {
    for (int v = p; v < views; v += 3) add(6 * views + 3 * p, 3, 6 * v, 6);
    add(6 * views + 3 * p, 3, 6 * views + 3 * p, 3);
  }
  return blocks;
}

template <class System>
Eigen::VectorXd solved(System& system, const std::vector<Block>& blocks, int views, int planes,
                       const Eigen::VectorXd& right) {
  system.begin(views, planes);
  for (const Block& block : blocks) {
    const Eigen::Index height = block.row < 6 * views ? 6 : 3;
    for (std::size_t i = 0; i < block.values.size(); ++i) {
      const auto at = static_cast<Eigen::Index>(i);
      system.block(block.row, block.col)[at / height * system.stride(block.row) + at % height] +=
          block.values[i];
    }
  }
  Eigen::VectorXd solution;
  REQUIRE(system.solve(right, solution));
  return solution;
}

}  // namespace

TEST_CASE("a sparse system has the solution of a dense one, also when it is filled again or differently") {
  Random random(5);
  DenseSystem<double> dense;
  SparseSystem<double> sparse;
  for (const auto& [views, planes] : {std::pair(20, 4), std::pair(20, 4), std::pair(7, 0), std::pair(9, 2)}) {
    sparse.forget();
    for (int again = 0; again < 2; ++again) {
      const std::vector<Block> blocks = random_blocks(views, planes, random);
      Eigen::VectorXd right(6 * views + 3 * planes);
      for (double& x : right) x = testing::gaussian(random);
      const Eigen::VectorXd expected = solved(dense, blocks, views, planes, right);
      CHECK((solved(sparse, blocks, views, planes, right) - expected).norm() <
            1e-12 * expected.norm() + 1e-14);
    }
  }
}

TEST_CASE("a sparse system that is not positive definite is refused") {
  SparseSystem<double> sparse;
  sparse.begin(1, 0);
  sparse.block(0, 0)[0] = -1;
  Eigen::VectorXd solution;
  CHECK_FALSE(sparse.solve(Eigen::VectorXd::Ones(6), solution));
}
