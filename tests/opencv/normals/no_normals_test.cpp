// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/opencv/normals/no_normals.hpp"

#include "support/catch.hpp"

using namespace sslam;

TEST_CASE("no normals are no failure") {
  NormalField field;
  field.push_back(0, 0, -1, 1);
  CHECK(NoNormals().fill({}, {}, field) == NormalStatus::kOk);
  CHECK(field.size() == 0);
}
