// SPDX-License-Identifier: BSD-3-Clause
// Your own camera and your own residual: a drone looks down on markers through a fisheye lens, which tells
// its height badly, and an altimeter helps.
#include <array>
#include <cmath>
#include <cstdio>
#include <span>

#include "sslam/residual/point_reprojection.hpp"
#include "sslam/solver/least_squares/levenberg_marquardt.hpp"
#include "sslam/testing/numeric_jacobian.hpp"

namespace {

using namespace sslam;

// Equidistant projection: the distance from the centre of the image is the angle off the axis times f.
struct Fisheye {
  double f = 300, cx = 320, cy = 240;  // pixels per radian, pixels

  [[nodiscard]] Vec2<double> project(const Vec3<double>& x) const noexcept {
    return Vec2<double>(cx, cy) + f * stretch(x) * x.head<2>();
  }
  [[nodiscard]] Vec3<double> unproject(const Vec2<double>& pixel) const noexcept {
    const Vec2<double> m = (pixel - Vec2<double>(cx, cy)) / f;
    const double angle = m.norm(), slope = angle > kSmall ? std::tan(angle) / angle : 1;
    return {slope * m.x(), slope * m.y(), 1};
  }
  [[nodiscard]] Mat<double, 2, 3> project_jacobian(const Vec3<double>& x) const noexcept {
    const double r2 = x.head<2>().squaredNorm(), d2 = x.squaredNorm(), s = stretch(x);
    const double along = r2 > kSmall * d2 ? (x.z() / d2 - s) / r2 : -2 / (3 * d2 * x.z());
    Mat<double, 2, 3> j;
    j << s * Mat2<double>::Identity() + along * x.head<2>() * x.head<2>().transpose(), -x.head<2>() / d2;
    return f * j;
  }

 private:
  static constexpr double kSmall = 1e-8;
  // The angle off the axis over the distance from it.
  [[nodiscard]] static double stretch(const Vec3<double>& x) noexcept {
    const double r = x.head<2>().norm();
    return r > kSmall * x.z() ? std::atan2(r, x.z()) / r : 1 / x.z();
  }
};
static_assert(CameraModel<Fisheye, double>);

// Height of the camera over the plane z = 0 of the world.
struct Altimeter {
  double metres = 0, sigma = 0.005;

  [[nodiscard]] double error(const SE3<double>& cam_from_world) const noexcept {
    return metres - cam_from_world.inverse().translation.z();
  }
  // For xi = (phi, rho) on the left the camera's centre moves by -R^T rho.
  [[nodiscard]] static Mat<double, 1, 6> jacobian(const SE3<double>& cam_from_world) noexcept {
    Mat<double, 1, 6> j;
    j << 0, 0, 0, cam_from_world.rotation.matrix().col(2).transpose();
    return j;
  }
};

struct Sighting {
  Vec3<double> marker;  // world
  Vec2<double> pixel;
};

// What minimize() asks of a problem: the cost at a pose, its rows in the equations, and how many are valid.
struct DronePose {
  Fisheye camera;
  std::span<const Sighting> sightings;
  const Altimeter* altimeter = nullptr;

  Evaluated<double> operator()(const SE3<double>& cam_from_world,
                               NormalEquations<double, 6>& equations) const noexcept {
    constexpr double kWeight = 1 / (0.3 * 0.3);  // pixels are read as whole numbers
    Evaluated<double> sum;
    const auto add = [&](const Mat<double, 1, 6>& j, double error, double weight) {
      equations.add(j, error, weight);
      sum.cost += weight * error * error;
    };
    for (const Sighting& s : sightings) {
      PointReprojection<double> r;
      if (!point_reprojection(camera, cam_from_world, s.marker, s.pixel, r)) continue;
      const Mat<double, 2, 6> j = r.wrt_pose();
      for (int i = 0; i < 2; ++i) add(j.row(i), r.error[i], kWeight);
      ++sum.count;
    }
    if (altimeter != nullptr)
      add(Altimeter::jacobian(cam_from_world), altimeter->error(cam_from_world),
          1 / (altimeter->sigma * altimeter->sigma));
    return sum;
  }
};

// How far the height is off, metres; the pose starts off its place.
double height_error(const DronePose& problem, const SE3<double>& truth) {
  Vec6<double> off;
  off << 0.05, -0.03, 0.1, 0.5, -0.4, 1.5;
  SE3<double> pose = truth.retract(off);
  const auto summary = minimize(problem, pose, {.max_iterations = 50});
  const double error = std::abs((pose.inverse().translation - truth.inverse().translation).z());
  std::printf("%s after %d steps, height off by %.4f m\n", name(summary.status), summary.iterations, error);
  return usable(summary.status) ? error : 1e9;
}

// The analytic derivatives against differences, entry by entry.
bool derivatives_agree(const Fisheye& camera, const Altimeter& altimeter, const SE3<double>& pose) {
  const auto height = [&](const SE3<double>& at) { return Vec<double, 1>(altimeter.error(at)); };
  const auto image = [&](const Euclidean<double, 3>& x) { return camera.project(x.value); };
  const Euclidean<double, 3> point{{0.4, -0.7, 1.5}};
  using testing::numeric_jacobian, testing::worst_entry;
  return worst_entry(Altimeter::jacobian(pose), numeric_jacobian(height, pose)).error < 1e-6 &&
         worst_entry(camera.project_jacobian(point.value), numeric_jacobian(image, point)).error < 1e-6;
}

}  // namespace

int main() {
  const Fisheye camera;
  const SO3<double> down = SO3<double>::exp({3.0, 0.1, 0.2});
  const SE3<double> cam_from_world{down, -(down * Vec3<double>(0.3, -0.2, 20))};
  std::array<Sighting, 9> sightings;
  for (std::size_t i = 0; i < sightings.size(); ++i) {
    const Vec3<double> marker(2 * (static_cast<double>(i % 3) - 1), 2 * (static_cast<double>(i / 3) - 1), 0);
    sightings[i] = {marker, camera.project(cam_from_world * marker).array().round()};
  }
  const Altimeter altimeter{20.002};
  const bool derivatives = derivatives_agree(camera, altimeter, cam_from_world);
  const double alone = height_error({camera, sightings}, cam_from_world);
  const double helped = height_error({camera, sightings, &altimeter}, cam_from_world);
  return derivatives && helped < 0.01 && alone > 0.01 && alone < 1 ? 0 : 1;
}
