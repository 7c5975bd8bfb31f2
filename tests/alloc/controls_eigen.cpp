// SPDX-License-Identifier: BSD-3-Clause
#include "alloc/heap_watch.hpp"
// The watch defines what Eigen calls: it comes first.
#include <Eigen/Core>

#include "support/catch.hpp"

using namespace sslam::testing;

TEST_CASE("A matrix of dynamic size is noticed") {
  forbid_heap();
  Eigen::MatrixXd matrix(3, 3);
  escape(matrix.data());
  CHECK(allow_heap() > 0);
}

TEST_CASE("A hidden temporary is noticed") {
  Eigen::MatrixXd a = Eigen::MatrixXd::Identity(20, 20);
  forbid_heap();
  a = a * a;
  escape(a.data());
  CHECK(allow_heap() > 0);
}

TEST_CASE("A matrix of fixed size is let pass") {
  forbid_heap();
  Eigen::Matrix3d matrix = Eigen::Matrix3d::Identity();
  escape(matrix.data());
  CHECK(allow_heap() == 0);
}
