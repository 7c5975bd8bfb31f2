// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/geometry/camera.hpp"

#include <limits>
#include <vector>

#include "sslam/core/random.hpp"
#include "sslam/testing/jacobian_mutants.hpp"
#include "sslam/testing/numeric_jacobian.hpp"
#include "support/catch.hpp"
#include "support/test_scalars.hpp"

using namespace sslam;
using namespace sslam::testing;

namespace {

// Published calibrations of the TUM RGB-D cameras fr1 and fr2, a wide lens with strong barrel, and a
// pincushion.
template <class S>
std::vector<RadTan<S>> lenses() {
  return {{},
          {S(0.262383), S(-0.953104), S(-0.005358), S(0.002628), S(1.163314)},
          {S(0.231222), S(-0.784899), S(-0.003257), S(-0.000105), S(0.917205)},
          {S(-0.28), S(0.07), S(0.001), S(-0.0005), 0},
          {S(0.15), 0, 0, 0, 0}};
}

}  // namespace

TEMPLATE_TEST_CASE("pinhole projects and comes back", "", SSLAM_TEST_SCALARS) {
  using S = TestType;
  const Pinhole<S> k{500, 510, 320, 240};
  CHECK(k.project({0, 0, 2}) == Vec2<S>(320, 240));
  CHECK(k.project({1, 0, 1}) == Vec2<S>(820, 240));
  CHECK(k.project({0, 1, 1}) == Vec2<S>(320, 750));
  const Vec3<S> x(S(0.2), S(-0.4), S(1.7));
  CHECK((k.unproject(k.project(x)) - x / x.z()).norm() < 20 * std::numeric_limits<S>::epsilon());
}

TEST_CASE("pinhole Jacobian entry by entry") {
  const Pinhole<double> k{500, 510, 320, 240};
  Random random(1);
  int killed = 0;
  for (int i = 0; i < 50; ++i) {
    const Vec3<double> x{random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), random.uniform(0.5, 4.0)};
    const auto numeric =
        numeric_jacobian([&](const Euclidean<double, 3>& p) -> Vec2<double> { return k.project(p.value); },
                         Euclidean<double, 3>{x});
    const Mat<double, 2, 3> analytic = k.project_jacobian(x);
    CHECK(worst_entry(analytic, numeric).error < 1e-7);
    for_each_mutant<double, 2, 3>(analytic, [&](const char* name, const Mat<double, 2, 3>& mutant) {
      CAPTURE(name);
      CHECK(worst_entry(mutant, numeric).error > 1e-3);
      ++killed;
    });
    // x and y taken for each other, in the point and in the focal lengths.
    const Pinhole<double> turned{510, 500, 320, 240};
    CHECK(worst_entry(k.project_jacobian({x.y(), x.x(), x.z()}), numeric).error > 1e-4);
    CHECK(worst_entry(turned.project_jacobian(x), numeric).error > 1e-3);
  }
  CHECK(killed > 400);
}

TEMPLATE_TEST_CASE("distortion is undone all over a wide image", "", SSLAM_TEST_SCALARS) {
  using S = TestType;
  const S tolerance = std::is_same_v<S, float> ? S(2e-5) : S(1e-10);
  for (const RadTan<S>& lens : lenses<S>()) {
    for (S x = S(-0.7); x < S(0.71); x += S(0.1)) {
      for (S y = S(-0.5); y < S(0.51); y += S(0.1)) {
        Vec2<S> back;
        CAPTURE(lens.k1, x, y);
        // fr1 and fr2 fold beyond a radius of about 0.8, just outside of their images.
        if (Vec2<S>(x, y).norm() > S(0.75)) continue;
        CHECK(lens.undistort(lens.distort({x, y}), back));
        CHECK((back - Vec2<S>(x, y)).norm() < tolerance);
      }
    }
  }
}

TEST_CASE("distortion Jacobian entry by entry") {
  Random random(2);
  for (const RadTan<double>& lens : lenses<double>()) {
    for (int i = 0; i < 20; ++i) {
      const Vec2<double> m{random.uniform(-0.7, 0.7), random.uniform(-0.5, 0.5)};
      const auto numeric = numeric_jacobian(
          [&](const Euclidean<double, 2>& p) -> Vec2<double> { return lens.distort(p.value); },
          Euclidean<double, 2>{m});
      CHECK(worst_entry(lens.distort_jacobian(m), numeric).error < 1e-7);
      for_each_mutant<double, 2, 2>(lens.distort_jacobian(m),
                                    [&](const char* name, const Mat2<double>& mutant) {
                                      CAPTURE(name);
                                      CHECK(worst_entry(mutant, numeric).error > 1e-5);
                                    });
    }
  }
}

TEST_CASE("radial and tangential terms mean what OpenCV means by them") {
  const RadTan<double> lens{0.1, 0.01, 0.003, -0.002, 0.001};
  const double x = 0.3, y = -0.2, r2 = x * x + y * y;
  const double radial = 1 + 0.1 * r2 + 0.01 * r2 * r2 + 0.001 * r2 * r2 * r2;
  const Vec2<double> d = lens.distort({x, y});
  CHECK(std::abs(d.x() - (x * radial + 2 * 0.003 * x * y - 0.002 * (r2 + 2 * x * x))) < 1e-15);
  CHECK(std::abs(d.y() - (y * radial + 0.003 * (r2 + 2 * y * y) - 2 * 0.002 * x * y)) < 1e-15);
}

TEMPLATE_TEST_CASE("a point that the lens cannot have seen is refused", "", SSLAM_TEST_SCALARS) {
  using S = TestType;
  const RadTan<S> barrel{S(-0.3), 0, 0, 0, 0};  // its image ends at a radius of 0.70
  Vec2<S> m;
  CHECK_FALSE(barrel.undistort({S(0.9), 0}, m));
  CHECK(m.allFinite());
  CHECK(barrel.undistort({S(0.69), 0}, m));
  CHECK(m.norm() < S(1.06));
  CHECK_FALSE(barrel.undistort({std::numeric_limits<S>::quiet_NaN(), 0}, m));
}

TEMPLATE_TEST_CASE("pixels of a camera with a lens", "", SSLAM_TEST_SCALARS) {
  using S = TestType;
  const Camera<S> camera{{S(517.306), S(516.469), S(318.643), S(255.314)}, lenses<S>()[1], 640, 480};
  for (S u = 0; u < 640; u += 53) {
    for (S v = 0; v < 480; v += 53) {
      CHECK((camera.distort_pixel(camera.undistort_pixel({u, v})) - Vec2<S>(u, v)).norm() < S(1e-2));
    }
  }
  Camera<S> ideal = camera;
  ideal.distortion = {};
  CHECK(ideal.undistort_pixel({S(12.5), S(7.25)}) == Vec2<S>(S(12.5), S(7.25)));
}
