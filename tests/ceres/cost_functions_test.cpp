// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/ceres/cost_functions.hpp"

#include <array>
#include <vector>

#include "ceres/numeric.hpp"
#include "sslam/ceres/plane_costs.hpp"
#include "sslam/core/random.hpp"
#include "support/catch.hpp"

namespace {

using namespace sslam;
using sslam::testing::analytic_jacobian;
using sslam::testing::numeric_jacobian;

template <std::size_t N>
std::vector<double> to_vector(const std::array<double, N>& block) {
  return {block.begin(), block.end()};
}

std::vector<double> pose_block(const SE3<double>& pose) {
  PoseBlock block;
  store_pose(pose, block.data());
  return to_vector(block);
}

std::vector<double> line_block(const Line3<double>& line) {
  LineBlock block;
  store_line(line, block.data());
  return to_vector(block);
}

// Entry by entry, relative to the entry, or to the largest one where the entry is small.
void require_same(const Eigen::MatrixXd& analytic, const Eigen::MatrixXd& numeric) {
  REQUIRE(analytic.rows() == numeric.rows());
  REQUIRE(analytic.cols() == numeric.cols());
  const double floor = 1e-2 * numeric.cwiseAbs().maxCoeff() + 1e-9;
  for (Eigen::Index r = 0; r < numeric.rows(); ++r)
    for (Eigen::Index c = 0; c < numeric.cols(); ++c) {
      INFO("row " << r << " column " << c << ": " << analytic(r, c) << " and " << numeric(r, c));
      REQUIRE(std::abs(analytic(r, c) - numeric(r, c)) <= 1e-5 * std::max(std::abs(numeric(r, c)), floor));
    }
}

const Pinhole<double> kPinhole{500, 480, 320, 240};

SE3<double> random_pose(Random& random) {
  Vec6<double> xi;
  for (int i = 0; i < 6; ++i) xi[i] = random.uniform(-0.4, 0.4);
  return SE3<double>::exp(xi);
}

Vec3<double> random_point(Random& random) {
  return {random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), random.uniform(3.0, 6.0)};
}

}  // namespace

TEST_CASE("Point cost is the core's residual in sigmas and its derivatives hold") {
  Random random(3);
  const PoseManifold manifold;
  const TurningPoseManifold turning;
  for (int trial = 0; trial < 20; ++trial) {
    const SE3<double> pose = random_pose(random);
    const Vec3<double> x = random_point(random);
    const PointEdge<double> edge{{random.uniform(0.0, 640.0), random.uniform(0.0, 480.0)}, 1 / 0.7, 0};
    const PointCost cost(edge, kPinhole);
    const std::vector<std::vector<double>> blocks{pose_block(pose), {x.x(), x.y(), x.z()}};
    const double* pointers[] = {blocks[0].data(), blocks[1].data()};
    Vec2<double> seen;
    PointReprojection<double> expected;
    REQUIRE(cost.Evaluate(pointers, seen.data(), nullptr));
    REQUIRE(point_reprojection(kPinhole, load_pose(blocks[0].data()), x, edge.pixel, expected));
    REQUIRE(seen == (expected.error * edge.inverse_sigma).eval());
    require_same(analytic_jacobian(cost, blocks, 0, &manifold), numeric_jacobian(cost, blocks, 0, &manifold));
    require_same(analytic_jacobian(cost, blocks, 0, &turning), numeric_jacobian(cost, blocks, 0, &turning));
    require_same(analytic_jacobian(cost, blocks, 1, nullptr), numeric_jacobian(cost, blocks, 1, nullptr));
  }
}

TEST_CASE("Point cost refuses a point behind the camera") {
  const PointCost cost({{0, 0}, 1, 0}, kPinhole);
  const auto pose = pose_block({});
  const double behind[] = {0, 0, -1};
  const double* pointers[] = {pose.data(), behind};
  double residual[2];
  REQUIRE_FALSE(cost.Evaluate(pointers, residual, nullptr));
}

TEST_CASE("Line cost is the core's residual in sigmas and its derivatives hold") {
  Random random(5);
  const PoseManifold manifold;
  const LineManifold line_manifold;
  for (int trial = 0; trial < 20; ++trial) {
    const SE3<double> pose = random_pose(random);
    const auto line = Line3<double>::from_points(random_point(random), random_point(random));
    const LineEdge<double> edge{{{random.uniform(0.0, 640.0), random.uniform(0.0, 480.0)},
                                 {random.uniform(0.0, 640.0), random.uniform(0.0, 480.0)}},
                                2,
                                0};
    const LineCost cost(edge, kPinhole);
    const std::vector<std::vector<double>> blocks{pose_block(pose), line_block(line)};
    const double* pointers[] = {blocks[0].data(), blocks[1].data()};
    Vec2<double> seen;
    LineReprojection<double> expected;
    REQUIRE(cost.Evaluate(pointers, seen.data(), nullptr));
    REQUIRE(line_reprojection(kPinhole, load_pose(blocks[0].data()), line, edge.segment, expected));
    REQUIRE(seen == (expected.error * edge.inverse_sigma).eval());
    require_same(analytic_jacobian(cost, blocks, 0, &manifold), numeric_jacobian(cost, blocks, 0, &manifold));
    require_same(analytic_jacobian(cost, blocks, 1, &line_manifold),
                 numeric_jacobian(cost, blocks, 1, &line_manifold));
  }
}

TEST_CASE("Ties have the derivatives that they claim") {
  Random random(7);
  const PoseManifold manifold;
  const TurningPoseManifold turning;
  const LineManifold line_manifold;
  for (int trial = 0; trial < 20; ++trial) {
    const SE3<double> pose = random_pose(random);
    Mat3<double> root;
    root << 50, 0, 0, 5, 40, 0, -3, 8, 30;
    const RotationTieCost rotation({random_pose(random).rotation, root});
    require_same(analytic_jacobian(rotation, {pose_block(pose)}, 0, &manifold),
                 numeric_jacobian(rotation, {pose_block(pose)}, 0, &manifold));
    require_same(analytic_jacobian(rotation, {pose_block(pose)}, 0, &turning),
                 numeric_jacobian(rotation, {pose_block(pose)}, 0, &turning));
    const auto line = Line3<double>::from_points(random_point(random), random_point(random));
    const AxisTieCost axis(random_point(random).normalized(), 0.01);
    require_same(analytic_jacobian(axis, {line_block(line)}, 0, &line_manifold),
                 numeric_jacobian(axis, {line_block(line)}, 0, &line_manifold));
    const ScaleTieCost scale(random_point(random), 2, 1e-2);
    require_same(analytic_jacobian(scale, {pose_block(pose)}, 0, &manifold),
                 numeric_jacobian(scale, {pose_block(pose)}, 0, &manifold));
  }
}

TEST_CASE("Ties to planes are the core's residuals in sigmas and their derivatives hold") {
  Random random(8);
  const LineManifold line_manifold;
  const PlaneManifold plane_manifold;
  for (int trial = 0; trial < 20; ++trial) {
    const Plane3<double> plane{random_point(random).normalized(), random.uniform(-2.0, 2.0)};
    PlaneBlock stored;
    store_plane(plane, stored.data());
    const Vec3<double> x = random_point(random), y = random_point(random);
    const auto line = Line3<double>::from_points(x, y);
    const PointOnPlaneCost point_cost(0.02);
    const LineOnPlaneCost line_cost(x, y, 0.02);
    const std::vector<std::vector<double>> with_point{to_vector(stored), {x.x(), x.y(), x.z()}};
    const std::vector<std::vector<double>> with_line{to_vector(stored), line_block(line)};
    const double* pointers[] = {with_point[0].data(), with_point[1].data()};
    double off = 0;
    REQUIRE(point_cost.Evaluate(pointers, &off, nullptr));
    REQUIRE(off == Approx(point_on_plane(plane, x).error[0] / 0.02));
    pointers[1] = with_line[1].data();
    Vec2<double> ends;
    REQUIRE(line_cost.Evaluate(pointers, ends.data(), nullptr));
    REQUIRE((ends - line_on_plane(plane, line, x, y).error / 0.02).norm() < 1e-9);
    require_same(analytic_jacobian(point_cost, with_point, 0, &plane_manifold),
                 numeric_jacobian(point_cost, with_point, 0, &plane_manifold));
    require_same(analytic_jacobian(point_cost, with_point, 1, nullptr),
                 numeric_jacobian(point_cost, with_point, 1, nullptr));
    require_same(analytic_jacobian(line_cost, with_line, 0, &plane_manifold),
                 numeric_jacobian(line_cost, with_line, 0, &plane_manifold));
    require_same(analytic_jacobian(line_cost, with_line, 1, &line_manifold),
                 numeric_jacobian(line_cost, with_line, 1, &line_manifold));
    Mat<double, 4, 4> held = Mat<double, 4, 4>::Zero();
    double squares = 0;
    for (int i = 0; i < 5; ++i) {
      const Vec3<double> member = random_point(random);
      const Vec4<double> row(member.x(), member.y(), member.z(), -1);
      held += row * row.transpose();
      squares += std::pow(plane.offset(member) / 0.02, 2);
    }
    const PlaneHeldCost held_cost(held, 0.02);
    Vec4<double> whitened;
    pointers[0] = with_point[0].data();
    REQUIRE(held_cost.Evaluate(pointers, whitened.data(), nullptr));
    REQUIRE(whitened.squaredNorm() == Approx(squares));
    require_same(analytic_jacobian(held_cost, {to_vector(stored)}, 0, &plane_manifold),
                 numeric_jacobian(held_cost, {to_vector(stored)}, 0, &plane_manifold));
    const PlaneAxisCost axis_cost(random_point(random).normalized(), 0.01);
    require_same(analytic_jacobian(axis_cost, {to_vector(stored)}, 0, &plane_manifold),
                 numeric_jacobian(axis_cost, {to_vector(stored)}, 0, &plane_manifold));
  }
}

TEST_CASE("A turning pose keeps its centre") {
  Random random(9);
  const SE3<double> pose = random_pose(random);
  const auto before = pose_block(pose);
  const double phi[] = {0.2, -0.1, 0.3};
  PoseBlock after;
  REQUIRE(TurningPoseManifold().Plus(before.data(), phi, after.data()));
  REQUIRE((load_pose(after.data()).inverse().translation - pose.inverse().translation).norm() < 1e-12);
}

TEST_CASE("An axis tie does not ask which way a line points") {
  const auto line = Line3<double>::from_points({0, 1, 2}, {0, 1, 5});
  REQUIRE(axis_tie_residual<double>({0, 0, 1}, line).norm() < 1e-15);
  REQUIRE(axis_tie_residual<double>({0, 0, -1}, line).norm() < 1e-15);
}
