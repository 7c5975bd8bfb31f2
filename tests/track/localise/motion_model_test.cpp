// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/track/localise/motion_model.hpp"

#include "support/catch.hpp"

namespace motion_model_test {

using namespace sslam;

// Per second, of the left tangent: it turns and moves.
const Vec6<double> kVelocity = (Vec6<double>() << 0.1, -0.4, 0.2, 0.5, 0.3, -1).finished();
const SE3<double> kStart{SO3<double>::exp({0.3, 0.2, -0.1}), {1, 2, 3}};

SE3<double> pose_after(double seconds) {
  return SE3<double>::exp(kVelocity * seconds) * kStart;
}

double apart(const SE3<double>& a, const SE3<double>& b) {
  return (a * b.inverse()).log().norm();
}

ConstantVelocity<double> moving() {
  ConstantVelocity<double> motion;
  motion.update(kStart, 10);
  motion.update(pose_after(0.1), 10.1);
  return motion;
}

}  // namespace motion_model_test

TEST_CASE("A camera at constant velocity is where it is predicted, whatever frames are dropped") {
  using namespace motion_model_test;
  const ConstantVelocity<double> motion = moving();
  for (const double ahead : {0.0, 0.05, 0.1, 0.7})
    CHECK(apart(motion.predict(10.1 + ahead), pose_after(0.1 + ahead)) < 1e-12);
}

TEST_CASE("Without a velocity the camera stays where it was") {
  using namespace motion_model_test;
  ConstantVelocity<double> motion;
  CHECK(apart(motion.predict(5), SE3<double>()) == 0);
  motion.update(kStart, 10);
  CHECK(apart(motion.predict(11), kStart) < 1e-15);
  CHECK_FALSE(motion.reaches(10));
  motion.update(pose_after(1), 10);  // the same stamp tells no velocity
  CHECK(apart(motion.predict(11), pose_after(1)) < 1e-15);
  motion = moving();
  motion.stop();
  CHECK(apart(motion.predict(12), pose_after(0.1)) < 1e-15);
  motion.update(pose_after(3), 13);  // it is not known how it came here
  CHECK(apart(motion.predict(14), pose_after(3)) < 1e-15);
  CHECK_FALSE(motion.reaches(13));
}

TEST_CASE("A velocity is believed up to the horizon") {
  using namespace motion_model_test;
  ConstantVelocity<double> motion = moving();
  motion.options.horizon = 0.5;
  CHECK(motion.reaches(10.59));
  CHECK_FALSE(motion.reaches(10.61));
}

TEST_CASE("A world that moves and changes scale takes the velocity along") {
  using namespace motion_model_test;
  ConstantVelocity<double> motion = moving();
  const SE3<double> other{SO3<double>::exp({0, 1, 0}), {-4, 0, 2}};
  motion.move_to(other, 2);
  Vec6<double> velocity = kVelocity;
  velocity.tail<3>() *= 2;
  CHECK(apart(motion.predict(10.3), SE3<double>::exp(velocity * 0.2) * other) < 1e-12);
}
