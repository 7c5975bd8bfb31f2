// SPDX-License-Identifier: BSD-3-Clause
// Estimates that are mirror images.
#include "sslam/io/evaluation/reflection.hpp"

#include <cmath>
#include <string>

#include "io/errors.hpp"
#include "sslam/core/random.hpp"
#include "sslam/io/evaluation/evaluation.hpp"

using namespace sslam;
using testing::contains;

namespace reflection_test {
namespace {

// A winding path; in a plane where `height` is 0.
io::Trajectory curve(double height = 0.6) {
  io::Trajectory path;
  for (int i = 0; i < 80; ++i) {
    const double a = 0.13 * i;
    io::StampedPose pose;
    pose.stamp = 0.1 * i;
    pose.world_from_cam.translation = {std::cos(a), 0.3 * std::sin(2 * a), height * std::sin(0.7 * a)};
    pose.world_from_cam.rotation = SO3<double>::exp(Vec3<double>(0.2 * std::sin(a), 0.5 * a, 0.1));
    path.push_back(pose);
  }
  return path;
}

io::Trajectory mirror(io::Trajectory path, int axis) {
  for (io::StampedPose& pose : path) pose.world_from_cam = io::mirrored(pose.world_from_cam, axis);
  return path;
}

std::string notes(const io::Trajectory& truth, const io::Trajectory& estimate,
                  io::Alignment alignment = io::Alignment::kSim3) {
  io::EvaluationOptions options;
  options.alignment = alignment;
  std::string all;
  for (const std::string& note : io::evaluate(truth, estimate, options).notes) all += note + "\n";
  return all;
}

}  // namespace
}  // namespace reflection_test

TEST_CASE("A mirror image is told with both errors, and the figure stays that of a rotation") {
  using namespace reflection_test;
  const io::Trajectory truth = curve();
  for (int axis = 0; axis < 3; ++axis) {
    io::Trajectory estimate = mirror(truth, axis);
    Random random(7);
    for (io::StampedPose& pose : estimate) {
      Vec3<double>& t = pose.world_from_cam.translation;
      for (int k = 0; k < 3; ++k) t[k] = 2 * (t[k] + random.uniform(-0.01, 0.01)) + 3;
    }
    const io::Evaluation evaluation = io::evaluate(truth, estimate);
    CHECK(evaluation.position.rmse > 0.1);
    REQUIRE(evaluation.notes.size() == 1);
    char other[24];
    std::snprintf(other, sizeof other, "%.4g m;", evaluation.position.rmse);
    CHECK(contains(evaluation.notes[0],
                   "mirror image of the ground truth: with a reflection the position error "
                   "would be 0.00"));
    CHECK(contains(evaluation.notes[0], std::string("instead of ") + other));
    CHECK(contains(notes(truth, mirror(truth, axis), io::Alignment::kSe3), "mirror image"));
  }
}

TEST_CASE("A mirror image of a path in a plane is told by its rotations") {
  using namespace reflection_test;
  const io::Trajectory truth = curve(0);
  CHECK(contains(
      notes(truth, mirror(truth, 0)),
      "seems to be a mirror image of the ground truth: with its x negated the rotations would agree"));
}

TEST_CASE("What is no mirror image is not taken for one") {
  using namespace reflection_test;
  const io::Trajectory truth = curve();
  CHECK(notes(truth, truth).empty());
  CHECK(notes(curve(0), curve(0)).empty());
  io::Trajectory estimate = truth;
  Random random(3);
  for (io::StampedPose& pose : estimate)
    for (int k = 0; k < 3; ++k) pose.world_from_cam.translation[k] += random.uniform(-0.3, 0.3);
  CHECK_FALSE(contains(notes(truth, estimate), "mirror"));
  io::Trajectory inverse = truth;
  for (io::StampedPose& pose : inverse) pose.world_from_cam = pose.world_from_cam.inverse();
  CHECK_FALSE(contains(notes(truth, inverse), "mirror"));
}
