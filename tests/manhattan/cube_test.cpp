// SPDX-License-Identifier: BSD-3-Clause
#include <vector>

#include "sslam/manhattan/cube.hpp"
#include "support/catch.hpp"
#include "support/test_scalars.hpp"
#include "vote_scene.hpp"

using namespace sslam;

namespace {

std::vector<Mat3<double>> cube_rotations() {
  std::vector<Mat3<double>> all;
  Random random(3);
  while (all.size() < 24) {
    const Mat3<double> q = nearest_cube_rotation(test::any_rotation(random).matrix());
    bool fresh = true;
    for (const Mat3<double>& other : all) fresh = fresh && (other - q).norm() > 0.5;
    if (fresh) all.push_back(q);
  }
  return all;
}

}  // namespace

TEST_CASE("the cube has 24 rotations and they are rotations", "[cube]") {
  for (const Mat3<double>& q : cube_rotations()) {
    CHECK(q.determinant() == Approx(1));
    CHECK((q * q.transpose() - Mat3<double>::Identity()).norm() < 1e-12);
    CHECK((nearest_cube_rotation(q) - q).norm() < 1e-12);
  }
}

TEMPLATE_TEST_CASE("every renamed frame gets its old names back", "[cube]", SSLAM_TEST_SCALARS) {
  using S = TestType;
  Random random(11);
  for (const Mat3<double>& q : cube_rotations()) {
    const SO3<double> frame = test::any_rotation(random);
    const SO3<double> off = SO3<double>::exp(0.7 * test::gaussian_vector<3>(random).normalized());
    const SO3<S> renamed = SO3<S>::from_matrix((off * frame).matrix().cast<S>() * q.cast<S>());
    const SO3<S> named = closest_naming(renamed, frame.cast<S>());
    CHECK(angle_between(named, (off * frame).cast<S>()) < S(1e-3));
    CHECK(angle_between_frames(renamed, frame.cast<S>()) == Approx(0.7).margin(1e-3));
  }
}

TEST_CASE("no two frames are farther apart than the cube allows", "[cube]") {
  // The largest distance from the 24 rotations: 62.8 degrees, about a diagonal.
  Random random(2);
  double most = 0;
  for (int i = 0; i < 5000; ++i) {
    const double angle = angle_between_frames(test::any_rotation(random), test::any_rotation(random));
    most = std::max(most, degrees(angle));
  }
  CHECK(most < 62.9);
  CHECK(most > 50);
}
