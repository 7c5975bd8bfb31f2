// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/solver/modes/offset_modes.hpp"

#include <algorithm>
#include <vector>

#include "sslam/core/random.hpp"
#include "support/catch.hpp"
#include "support/test_scalars.hpp"

namespace {

using namespace sslam;

template <class S>
std::vector<S> scatter(Random& random, int count, S low, S high) {
  std::vector<S> out;
  for (int i = 0; i < count; ++i) out.push_back(random.uniform<S>(low, high));
  return out;
}

}  // namespace

TEMPLATE_TEST_CASE("The mode is where the crowd is, and stands out", "", SSLAM_TEST_SCALARS) {
  using S = TestType;
  Random random(1);
  std::vector<S> offsets = scatter<S>(random, 200, -1, 3);
  const std::vector<S> wall = scatter<S>(random, 40, S(0.99), S(1.01));
  offsets.insert(offsets.end(), wall.begin(), wall.end());
  std::sort(offsets.begin(), offsets.end());
  const OffsetMode<S> mode = offset_mode<S>(offsets, S(0.02));
  CHECK(mode.size() >= 40);
  CHECK(mode.size() < 46);
  CHECK(offsets[mode.first] > S(0.97));
  CHECK(offsets[mode.last - 1] < S(1.03));
  CHECK(mode.contrast > 10);
}

TEST_CASE("Clutter has a mode too, which does not stand out") {
  Random random(2);
  std::vector<double> offsets = scatter<double>(random, 2000, 0, 1);
  std::sort(offsets.begin(), offsets.end());
  const OffsetMode<double> mode = offset_mode<double>(offsets, 0.02);
  CHECK(mode.size() > 40);
  CHECK(mode.contrast < 2);
}

TEST_CASE("Few numbers, or none") {
  CHECK(offset_mode<double>({}, 0.1).size() == 0);
  const std::vector<double> one{3};
  CHECK(offset_mode<double>(one, 0.1).size() == 1);
  const std::vector<double> apart{0, 1, 2};
  const OffsetMode<double> mode = offset_mode<double>(apart, 0.1);
  CHECK(mode.first == 0);
  CHECK(mode.size() == 1);
}
