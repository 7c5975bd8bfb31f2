// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/image/patch_alignment.hpp"

#include <cmath>

#include "support/catch.hpp"
#include "support/drawn_image.hpp"

using namespace sslam;
using namespace sslam::testing;

namespace patch_alignment_test {

// Grey levels that vary in all directions.
double pattern(double x, double y) {
  return 110 + 40 * std::sin(0.55 * x + 0.2 * y) + 35 * std::cos(0.3 * x - 0.6 * y) + 20 * std::sin(0.8 * y);
}

constexpr float kAt = 20;  // where a feature is detected, both coordinates

// What a view shows in which pattern(x, y) stands at kAt + over * (x, y) + `moved`.
FeaturePatch patch(const Mat2<double>& over, const Vec2<double>& moved, double gain = 1, double offset = 0) {
  const Mat2<double> back = over.inverse();
  const DrawnImage image = draw({40, 40}, [&](double u, double v) {
    const Vec2<double> at = back * (Vec2<double>(u - kAt, v - kAt) - moved);
    return gain * pattern(at.x(), at.y()) + offset;
  });
  return cut_patch(image.view(), kAt, kAt);
}

Mat2<double> turn(double angle, double scale) {
  Mat2<double> m;
  m << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
  return scale * m;
}

}  // namespace patch_alignment_test

TEST_CASE("A patch is laid over another to a fraction of a pixel, whatever its brightness") {
  using namespace patch_alignment_test;
  const Mat2<double> same = Mat2<double>::Identity();
  const FeaturePatch reference = patch(same, Vec2<double>::Zero());
  PatchAlignment alignment;
  for (const double x : {-1.6, -0.5, 0.0, 0.3, 1.2})
    for (const double y : {-1.1, 0.0, 0.7}) {
      const auto shift = alignment.align(reference, patch(same, {x, y}, 0.7, 30), same.cast<float>());
      REQUIRE(shift);
      CHECK(shift->x() == Approx(x).margin(0.03));
      CHECK(shift->y() == Approx(y).margin(0.03));
    }
}

TEST_CASE("A patch is warped as it is told before it is laid over another") {
  using namespace patch_alignment_test;
  const FeaturePatch reference = patch(Mat2<double>::Identity(), Vec2<double>::Zero());
  PatchAlignment alignment;
  for (const double angle : {-0.3, 0.2})
    for (const double scale : {1.0, 1.3}) {
      const Mat2<double> over = turn(angle, scale);
      const auto shift = alignment.align(reference, patch(over, {0.6, -0.4}), over.cast<float>());
      REQUIRE(shift);
      CHECK(shift->x() == Approx(0.6).margin(0.06));
      CHECK(shift->y() == Approx(-0.4).margin(0.06));
    }
}

TEST_CASE("Patches that show too little, or not the same, are not aligned") {
  using namespace patch_alignment_test;
  const Mat2<float> same = Mat2<float>::Identity();
  const FeaturePatch reference = patch(Mat2<double>::Identity(), Vec2<double>::Zero());
  PatchAlignment alignment;
  const auto cut = [](auto shade) { return cut_patch(draw({40, 40}, shade).view(), kAt, kAt); };
  const FeaturePatch grey = cut([](double, double) { return 90.0; });
  const FeaturePatch edge = cut([](double u, double) { return u > 20.3 ? 200.0 : 40.0; });
  const FeaturePatch other =
      cut([](double u, double v) { return 120 + 60 * std::sin(1.1 * u) * std::cos(v); });
  const FeaturePatch far = patch(Mat2<double>::Identity(), {2.4, 0});
  CHECK(!alignment.align(reference, grey, same));
  CHECK(!alignment.align(grey, reference, same));
  CHECK(!alignment.align(edge, edge, same));
  CHECK(!alignment.align(reference, other, same));
  CHECK(!alignment.align(reference, far, same));
  CHECK(!alignment.align(reference, reference, 0.2F * same));  // it would show more than the patch holds
  CHECK(alignment.align(reference, reference, same));
}
