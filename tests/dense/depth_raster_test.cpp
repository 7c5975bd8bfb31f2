// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/dense/depth_raster.hpp"

#include <cmath>

#include "dense/filmed_room.hpp"
#include "sslam/core/random.hpp"
#include "support/catch.hpp"
#include "support/random_draws.hpp"

using namespace sslam;
using namespace sslam::testing;

namespace depth_raster_test {

const Pinhole<double> kPinhole{130, 140, 79.5, 59.5};
constexpr int kWidth = 160, kHeight = 120;

// A square about the plane's point nearest to the camera, as two triangles.
void add_square(const Plane3<double>& plane, double half, dense::DepthRaster& raster) {
  const Vec3<double> middle = plane.distance * plane.normal;
  const Mat<double, 3, 2> basis = tangent_basis(plane.normal);
  const Vec3<double> s = half * basis.col(0), t = half * basis.col(1);
  raster.add(middle - s - t, middle + s - t, middle + s + t);
  raster.add(middle + s + t, middle - s + t, middle - s - t);
}

}  // namespace depth_raster_test

TEST_CASE(
    "a slanted plane has its exact inverse depth in every pixel, also where it reaches behind the camera") {
  using namespace depth_raster_test;
  const Plane3<double> plane{Vec3<double>(0.2, -0.9, 0.3).normalized(), 1.3};
  dense::DepthRaster raster;
  raster.begin(kPinhole, kWidth, kHeight);
  add_square(plane, 1e4, raster);
  int shown = 0;
  for (int v = 0; v < kHeight; ++v)
    for (int u = 0; u < kWidth; ++u) {
      const Vec2<double> pixel(u, v);
      const double inverse = plane.normal.dot(kPinhole.unproject(pixel)) / plane.distance;
      const dense::DepthRaster::Surface* const surface = raster.at(pixel);
      if (inverse < 1e-3) {  // near the square's end, or beyond the horizon
        if (inverse < 0) CHECK(surface == nullptr);
        continue;
      }
      ++shown;
      REQUIRE(surface != nullptr);
      REQUIRE(std::abs(surface->inverse_depth(pixel) / inverse - 1) < 1e-9);
      REQUIRE((surface->normal + plane.normal).norm() < 1e-9);  // towards the camera
      const Vec2<double> between = pixel + Vec2<double>(0.3, -0.2);
      REQUIRE(surface->inverse_depth(between) ==
              Approx(plane.normal.dot(kPinhole.unproject(between)) / plane.distance).margin(1e-9));
    }
  CHECK(shown > kWidth * kHeight / 3);
  CHECK(shown < kWidth * kHeight);
}

TEST_CASE("a triangle covers the pixels whose middles lie in it, and the nearest one is kept") {
  using namespace depth_raster_test;
  dense::DepthRaster raster;
  raster.begin(kPinhole, kWidth, kHeight);
  const auto place = [](double u, double v, double z) -> Vec3<double> {
    return z * kPinhole.unproject(Vec2<double>(u, v));
  };
  raster.add(place(9.8, 9.8, 2), place(110.6, 9.8, 4), place(9.8, 50.4, 3));
  raster.add(place(40, 5, 5), place(150, 5, 5), place(40, 100, 5));  // wound the same way, farther
  raster.add(place(0, 70, 1), place(0, 90, 1), place(40.2, 80, 1));  // wound the other way
  raster.add(place(60, 60, 2), place(80, 60, 4), place(70, 60, 3));  // seen along its plane
  raster.add(place(60, 60, -2), place(80, 60, -2), place(60, 90, -2));
  const auto depth = [&](int u, int v) {
    const dense::DepthRaster::Surface* const surface = raster.at(Vec2<double>(u, v));
    return surface == nullptr ? 0.0 : 1 / surface->inverse_depth(Vec2<double>(u, v));
  };
  const auto first = [](double u, double v) {  // the depth of the first triangle
    const double b = (u - 9.8) / 100.8, c = (v - 9.8) / 40.6;
    return 1 / ((1 - b - c) / 2 + b / 4 + c / 3);
  };
  CHECK(depth(10, 10) == Approx(first(10, 10)));
  CHECK(depth(10, 50) == Approx(first(10, 50)));
  CHECK(depth(10, 51) == 0);
  CHECK(depth(9, 10) == 0);
  CHECK(depth(10, 9) == 0);
  CHECK(depth(110, 10) == Approx(first(110, 10)));  // before the other
  CHECK(depth(111, 10) == Approx(5));
  CHECK(depth(60, 50) == Approx(5));
  CHECK(depth(40, 80) == Approx(1));
  CHECK(depth(41, 80) == Approx(5));
  CHECK(raster.at(Vec2<double>(-0.6, 80)) == nullptr);
  CHECK(raster.at(Vec2<double>(-0.4, 80)) != nullptr);
  CHECK(raster.at(Vec2<double>(20, kHeight)) == nullptr);
  CHECK(raster.at(Vec2<double>::Constant(std::nan(""))) == nullptr);
  raster.begin(kPinhole, kWidth, kHeight);
  CHECK(depth(10, 10) == 0);
}

TEST_CASE("triangles that share edges leave no gap between them") {
  using namespace depth_raster_test;
  dense::DepthRaster raster;
  Random random(4);
  for (int t = 0; t < 20; ++t) {
    raster.begin(kPinhole, kWidth, kHeight);
    const Vec3<double> middle = uniform_vector<double, 3>(random, -0.3, 0.3) + Vec3<double>(0, 0, 2);
    const Vec3<double> corners[] = {{-9, -7, 3}, {8, -9, 2}, {9, 8, 4}, {-7, 9, 3}};
    for (int i = 0; i < 4; ++i) raster.add(middle, corners[i], corners[(i + 1) % 4]);
    int gaps = 0;
    for (int v = 0; v < kHeight; ++v)
      for (int u = 0; u < kWidth; ++u) gaps += raster.at(Vec2<double>(u, v)) == nullptr ? 1 : 0;
    CHECK(gaps == 0);
  }
}

TEST_CASE("the faces of a room have the depth that its renderer finds") {
  const FilmedRoom room;
  dense::DepthRaster raster;
  std::size_t others = 0, all = 0;
  for (std::size_t k = 0; k < room.views.size(); k += 5) {
    const dense::DenseView& view = room.views[k];
    const synth::RenderedFrame& frame = room.frames[k];
    raster.begin(view.pinhole, frame.width, frame.height);
    for (const synth::Face& face : room.scene.faces) {
      const SE3<double>& turn = view.cam_from_world;
      const Vec3<double> a = turn * face.at(0, 0), b = turn * face.at(face.width, 0),
                         c = turn * face.at(face.width, face.height), d = turn * face.at(0, face.height);
      raster.add(a, b, c);
      raster.add(a, c, d);
    }
    for (int v = 0; v < frame.height; ++v)
      for (int u = 0; u < frame.width; ++u) {
        const auto i = static_cast<std::size_t>(v * frame.width + u);
        const double wanted = static_cast<double>(frame.inverse_depth[i]);
        const dense::DepthRaster::Surface* const surface = raster.at(Vec2<double>(u, v));
        ++all;
        const double inverse = surface == nullptr ? 0 : surface->inverse_depth(Vec2<double>(u, v));
        if (std::abs(inverse - wanted) > 1e-5) {
          ++others;
          continue;
        }
        const auto& normal = frame.normals[static_cast<std::size_t>(frame.surface[i])];
        if (!((surface->normal - normal.cast<double>()).norm() < 1e-4)) FAIL("another normal");
      }
  }
  CHECK(all > 300000);
  CHECK(others * 20000 < all);  // on the edge of a doorway either side may count
}
