// SPDX-License-Identifier: BSD-3-Clause
// Figures worked out by hand, and what must not change them.
#include "sslam/io/evaluation/evaluation.hpp"

#include <cmath>

#include "io/errors.hpp"
#include "sslam/core/random.hpp"
#include "sslam/io/plots/comparison_view.hpp"

using namespace sslam;
using testing::contains;
using testing::error_of;

namespace {

io::StampedPose pose_at(double stamp, const Vec3<double>& position, const SO3<double>& rotation = {}) {
  io::StampedPose pose;
  pose.stamp = stamp;
  pose.world_from_cam.rotation = rotation;
  pose.world_from_cam.translation = position;
  return pose;
}

// A winding path at 10 Hz.
io::Trajectory winding(int count) {
  io::Trajectory path;
  for (int i = 0; i < count; ++i) {
    const double a = 0.13 * i;
    path.push_back(pose_at(0.1 * i, Vec3<double>(std::cos(a), 0.3 * std::sin(2 * a), 0.05 * i),
                           SO3<double>::exp(Vec3<double>(0.2 * std::sin(a), 0.5 * a, 0.1))));
  }
  return path;
}

io::Trajectory noisy(io::Trajectory path, std::uint64_t seed) {
  Random random(seed);
  const auto draw = [&random](double size) {
    return Vec3<double>{random.uniform(-size, size), random.uniform(-size, size),
                        random.uniform(-size, size)};
  };
  for (io::StampedPose& pose : path) {
    pose.world_from_cam.translation += draw(0.05);
    pose.world_from_cam.rotation = pose.world_from_cam.rotation.retract(draw(0.02));
  }
  return path;
}

// The same trajectory in a world that is turned, shifted and scaled.
io::Trajectory in_another_world(const io::Trajectory& path, double scale) {
  Sim3<double> other_from_world;
  other_from_world.rotation = SO3<double>::exp(Vec3<double>(0.7, -1.9, 0.4));
  other_from_world.translation = Vec3<double>(5, -3, 2);
  other_from_world.scale = scale;
  return io::aligned(path, other_from_world);
}

void check_same(const io::Statistics& a, const io::Statistics& b) {
  CHECK(a.count == b.count);
  CHECK(a.rmse == Approx(b.rmse).margin(1e-9));
  CHECK(a.mean == Approx(b.mean).margin(1e-9));
  CHECK(a.median == Approx(b.median).margin(1e-9));
  CHECK(a.max == Approx(b.max).margin(1e-9));
}

}  // namespace

TEST_CASE("Statistics by hand") {
  const io::Statistics s = io::statistics_of({4, 1, 3, 2});
  CHECK(s.count == 4);
  CHECK(s.mean == Approx(2.5));
  CHECK(s.median == Approx(2.5));
  CHECK(s.rmse == Approx(std::sqrt(7.5)));
  CHECK(s.deviation == Approx(std::sqrt(1.25)));
  CHECK(s.min == 1);
  CHECK(s.max == 4);
  CHECK(io::statistics_of({}).count == 0);
  CHECK(io::quantile({0, 10}, 0.95) == Approx(9.5));
}

TEST_CASE("ATE by hand without alignment") {
  const io::Trajectory truth{pose_at(0, {0, 0, 0}), pose_at(1, {1, 0, 0}), pose_at(2, {2, 0, 0})};
  const io::Trajectory estimate{pose_at(0.01, {0, 0, 0}), pose_at(1.01, {1, 3, 4}), pose_at(2.01, {2, 0, 2})};
  const io::Evaluation e = io::evaluate(truth, estimate, {.alignment = io::Alignment::kNone});
  CHECK(e.pairs == 3);
  CHECK(e.position.mean == Approx(7.0 / 3));
  CHECK(e.position.rmse == Approx(std::sqrt(29.0 / 3)));
  CHECK(e.position.median == Approx(2));
  CHECK(e.position.max == Approx(5));
  CHECK(e.truth_path == Approx(2));
  CHECK(e.estimate_path == Approx(std::sqrt(26.0) + std::sqrt(1 + 9 + 4)));
}

TEST_CASE("ATE by hand with alignment: corners of a square of which one is off") {
  // The best rigid fit of a square with one corner d along its diagonal leaves d^2 (1 - 1/4 - 1/4) / 4 or
  // less; with the shift alone it is the variance of (d, 0, 0, 0). By symmetry no turn helps, a scale does.
  const double d = 0.4;
  const double q = d / std::sqrt(2.0);
  const io::Trajectory truth{pose_at(0, {1, 1, 0}), pose_at(1, {-1, 1, 0}), pose_at(2, {-1, -1, 0}),
                             pose_at(3, {1, -1, 0})};
  io::Trajectory estimate = truth;
  estimate[0].world_from_cam.translation += Vec3<double>(q, q, 0);
  const io::Evaluation rigid = io::evaluate(truth, estimate, {.alignment = io::Alignment::kSe3});
  CHECK(rigid.position.rmse == Approx(d * std::sqrt(3.0) / 4));
  CHECK(rigid.truth_from_estimate.scale == 1);
  // s = sum a . b / sum b . b over centred corners, b = a + (3/4, -1/4, -1/4, -1/4) of the shift.
  const double ab = 8 + 2 * q;
  const double bb = 8 + 4 * q + 0.75 * d * d;
  const io::Evaluation scaled = io::evaluate(truth, estimate);
  CHECK(scaled.truth_from_estimate.scale == Approx(ab / bb));
  CHECK(scaled.position.rmse == Approx(std::sqrt((8 - ab * ab / bb) / 4)));
}

TEST_CASE("RPE by hand: a constant drift per step and the last pose left out") {
  io::Trajectory truth;
  io::Trajectory estimate;
  const SO3<double> turn = SO3<double>::exp(Vec3<double>(0, 0.01, 0));
  SE3<double> drifted;
  SE3<double> step;
  step.rotation = turn;
  step.translation = Vec3<double>(1, 0, 0.02);
  for (int i = 0; i < 11; ++i) {
    truth.push_back(pose_at(0.5 * i, Vec3<double>(i, 0, 0)));
    estimate.push_back(pose_at(0.5 * i, drifted.translation, drifted.rotation));
    drifted = drifted * step;
  }
  io::EvaluationOptions options;
  options.alignment = io::Alignment::kNone;
  options.deltas = {{1, io::DeltaUnit::kFrames}, {1, io::DeltaUnit::kSeconds}, {10, io::DeltaUnit::kFrames}};
  const io::Evaluation e = io::evaluate(truth, estimate, options);
  REQUIRE(e.relative.size() == 3);
  CHECK(e.relative[0].translation.count == 9);
  CHECK(e.relative[0].translation.rmse == Approx(0.02));
  CHECK(e.relative[0].rotation.max == Approx(0.01));
  CHECK(e.relative[1].rotation.count == 8);
  CHECK(e.relative[1].rotation.mean == Approx(0.02));
  CHECK(e.relative[2].translation.count == 0);
  options.seconds_per_stamp = 2;  // one second is half a stamp: one frame
  options.deltas = {{1, io::DeltaUnit::kSeconds}};
  CHECK(io::evaluate(truth, estimate, options).relative[0].rotation.mean == Approx(0.01));
}

TEST_CASE("A perfect estimate in another world and scale has no error") {
  const io::Trajectory truth = winding(60);
  const io::Evaluation e = io::evaluate(truth, in_another_world(truth, 0.25));
  CHECK(e.truth_from_estimate.scale == Approx(4));
  CHECK(e.position.max < 1e-9);
  CHECK(e.rotation.max < 1e-7);
  CHECK(e.rotation_own_offset.max < 1e-7);
  for (const io::RelativeError& relative : e.relative) CHECK(relative.translation.max < 1e-9);
  CHECK(e.estimate_path == Approx(e.truth_path));
}

TEST_CASE("The figures do not depend on the estimate's world and scale") {
  const io::Trajectory truth = winding(80);
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    const io::Trajectory estimate = noisy(truth, seed);
    const io::Evaluation a = io::evaluate(truth, estimate);
    const io::Evaluation b = io::evaluate(truth, in_another_world(estimate, 7));
    CHECK(a.position.rmse > 0.01);
    check_same(a.position, b.position);
    check_same(a.rotation, b.rotation);
    check_same(a.rotation_own_offset, b.rotation_own_offset);
    for (std::size_t i = 0; i < a.relative.size(); ++i) {
      check_same(a.relative[i].translation, b.relative[i].translation);
      check_same(a.relative[i].rotation, b.relative[i].rotation);
    }
    io::EvaluationOptions rigid{.alignment = io::Alignment::kSe3};
    check_same(io::evaluate(truth, estimate, rigid).position,
               io::evaluate(truth, in_another_world(estimate, 1), rigid).position);
    CHECK(a.position.rmse <= io::evaluate(truth, estimate, rigid).position.rmse);
  }
}

TEST_CASE("The alignment is the least squares one") {
  const io::Trajectory truth = winding(40);
  const io::Trajectory estimate = noisy(in_another_world(truth, 2), 3);
  const std::vector<Vec3<double>> to = io::positions_of(truth);
  const std::vector<Vec3<double>> from = io::positions_of(estimate);
  const auto cost = [&](const Sim3<double>& map) {
    double sum = 0;
    for (std::size_t i = 0; i < to.size(); ++i) sum += (map * from[i] - to[i]).squaredNorm();
    return sum;
  };
  for (const io::Alignment alignment : {io::Alignment::kSim3, io::Alignment::kSe3}) {
    const Sim3<double> best = io::align(from, to, alignment);
    for (int i = 0; i < 14; ++i) {
      Sim3<double> other = best;
      const double step = i % 2 == 0 ? 1e-3 : -1e-3;
      Vec3<double> along = Vec3<double>::Zero();
      along[(i / 2) % 3] = step;
      if (i < 6) {
        other.rotation = other.rotation.retract(along);
      } else if (i < 12) {
        other.translation += along;
      } else if (alignment == io::Alignment::kSim3) {
        other.scale *= 1 + step;
      } else {
        continue;
      }
      // Turn and scale about the middle, where they are independent of the shift.
      if (i < 6 || i >= 12) {
        Vec3<double> middle = Vec3<double>::Zero();
        for (const Vec3<double>& p : from) middle += p / static_cast<double>(from.size());
        other.translation += best * middle - other * middle;
      }
      CHECK(cost(other) > cost(best));
    }
  }
}

TEST_CASE("Frames tracked are counted by their stamps") {
  const io::Trajectory truth = winding(60);
  io::Trajectory estimate(truth.begin() + 10, truth.begin() + 40);
  io::EvaluationOptions options;
  for (int i = 0; i < 30; ++i) options.frame_stamps.push_back(0.2 * i + 0.001);
  const io::Evaluation e = io::evaluate(truth, estimate, options);
  CHECK(e.frames == 30);
  CHECK(e.tracked == 15);
  CHECK(e.poses == 30);
  const io::Evaluation counted = io::evaluate(truth, estimate, {.frames = 60});
  CHECK(counted.tracked == 30);
  CHECK(counted.frames == 60);
}

TEST_CASE("A trajectory stands still in proportion to its size, wherever it stands") {
  const io::Trajectory truth = winding(60);
  const auto standing = [&](const Vec3<double>& place, double shake) {
    io::Trajectory poses = truth;
    double sign = shake;
    for (io::StampedPose& pose : poses) {
      pose.world_from_cam.translation = place + Vec3<double>(sign, 0, 0);
      sign = -sign;
    }
    return poses;
  };
  for (const Vec3<double>& place :
       {Vec3<double>(0.3, 0.2, 0.1), Vec3<double>(0, 0, 0), Vec3<double>(1e5, 5e6, 30)}) {
    for (const double shake : {0.0, 1e-6}) {
      const io::Trajectory still = standing(place, shake);
      CHECK(contains(error_of([&] { (void)io::evaluate(truth, still); }), "the estimate stands still"));
      CHECK(contains(error_of([&] { (void)io::evaluate(still, truth); }), "the ground truth stands still"));
    }
  }
  io::Trajectory far = truth;  // a small path in a large world moves
  for (io::StampedPose& pose : far) pose.world_from_cam.translation += Vec3<double>(1e5, 5e6, 30);
  CHECK(io::evaluate(far, truth).position.rmse < 1e-6);
}

TEST_CASE("Steps across a gap do not count") {
  io::Trajectory truth = winding(60), estimate = truth;
  for (std::size_t i = 30; i < 60; ++i) {  // the estimate jumps while it is lost
    estimate[i].world_from_cam.translation += Vec3<double>(0, 5, 0);
  }
  estimate.erase(estimate.begin() + 28, estimate.begin() + 35);
  const io::EvaluationOptions options{
      .alignment = io::Alignment::kNone,
      .deltas = {{1, io::DeltaUnit::kFrames}, {0.2, io::DeltaUnit::kSeconds}}};
  const io::Evaluation e = io::evaluate(truth, estimate, options);
  CHECK(e.pairs == 53);
  CHECK(e.relative[0].translation.count == 50);  // 52 steps, without the last and the one across
  for (const io::RelativeError& relative : e.relative) CHECK(relative.translation.max < 1e-9);
}

TEST_CASE("Doubtful figures say why") {
  const io::Trajectory truth = winding(60);
  const auto notes = [](const io::Trajectory& t, const io::Trajectory& estimate, io::Alignment alignment) {
    std::string text;
    for (const std::string& note : io::evaluate(t, estimate, {.alignment = alignment}).notes)
      text += note + ';';
    return text;
  };
  constexpr io::Alignment kScaled = io::Alignment::kSim3, kRigid = io::Alignment::kSe3;
  CHECK(notes(truth, noisy(in_another_world(truth, 2), 1), kScaled).empty());
  CHECK(notes(truth, noisy(truth, 1), kRigid).empty());
  io::Trajectory w_first = truth, inverse = truth, line = truth, thousandth = truth, aimless = truth;
  Random random(5);
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const auto q = truth[i].world_from_cam.rotation.quaternion();
    w_first[i].world_from_cam.rotation = SO3<double>::from_quaternion(q.z(), q.w(), q.x(), q.y());
    inverse[i].world_from_cam = truth[i].world_from_cam.inverse();
    line[i].world_from_cam.translation = Vec3<double>(0.1 * static_cast<double>(i), 0, 0);
    thousandth[i].world_from_cam.translation *= 1e-3;
    aimless[i].world_from_cam.translation =
        Vec3<double>{random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0)};
  }
  CHECK(contains(notes(truth, w_first, kScaled), "the estimate's quaternions seem to have w first"));
  CHECK(contains(notes(w_first, truth, kScaled), "the ground truth's quaternions seem to have w first"));
  CHECK(contains(notes(truth, inverse, kScaled), "inverted (world to camera, or quaternions of JPL's kind)"));
  CHECK(contains(notes(line, line, kScaled), "lie on a line"));
  CHECK(contains(notes(thousandth, truth, kRigid), "the estimate seems to be in millimetres"));
  CHECK(contains(notes(truth, thousandth, kRigid), "the ground truth seems to be in millimetres"));
  CHECK(contains(notes(truth, aimless, kScaled), "no likeness"));
  const io::Trajectory few(truth.begin(), truth.begin() + 8);
  CHECK(contains(notes(truth, few, kScaled), "only 8 of 8 poses have a partner"));
}

TEST_CASE("What cannot be evaluated says why") {
  const io::Trajectory truth = winding(20);
  io::Trajectory late = truth;
  for (io::StampedPose& pose : late) pose.stamp += 1000;
  const std::string no_overlap = error_of([&] { (void)io::evaluate(truth, late); });
  CHECK(testing::is_one_line(no_overlap));
  CHECK(contains(no_overlap, "no overlap between ground truth (stamps 0.000000 to 1.9"));
  CHECK(contains(no_overlap, "and estimate (1000.000000 to 1001.9"));
  CHECK(contains(error_of([&] { (void)io::evaluate(truth, {}); }), "the estimate holds no pose"));
  CHECK(contains(error_of([&] { (void)io::evaluate({}, truth); }), "the ground truth holds no pose"));
  const io::Trajectory two(truth.begin(), truth.begin() + 2);
  CHECK(contains(error_of([&] { (void)io::evaluate(truth, two); }), "at least 3 pairs of poses, found 2"));
  io::Trajectory still = truth;
  for (io::StampedPose& pose : still) pose.world_from_cam.translation.setZero();
  CHECK(contains(error_of([&] { (void)io::evaluate(truth, still); }), "the estimate stands still"));
  CHECK(contains(error_of([&] { (void)io::evaluate(still, truth); }), "the ground truth stands still"));
  const io::Evaluation rotations = io::evaluate(still, still, {.alignment = io::Alignment::kNone});
  CHECK(rotations.rotation_own_offset.max < 1e-7);
}
