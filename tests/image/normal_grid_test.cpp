// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/image/normal_grid.hpp"

#include "support/catch.hpp"

using namespace sslam;

TEST_CASE("normals count as far as their neighbours agree") {
  NormalGrid grid;
  grid.reset(7, 5);
  for (std::size_t i = 0; i < grid.normal.size(); ++i) {
    grid.normal[i] = {0, 0, -1};
    grid.weight[i] = 0.5F;
  }
  grid.normal[2 * 7 + 3] = {1, 0, 0};  // an outlier in the middle
  NormalField field;
  keep_planar(grid, {}, field);
  // The outlier has no friend and a corner only three neighbours.
  CHECK(field.size() == 7 * 5 - 1 - 4);
  for (std::size_t i = 0; i < field.size(); ++i) {
    CHECK(field.z[i] == -1);
    CHECK((field.weight[i] == 0.5F || field.weight[i] < 0.5F));
  }
}
