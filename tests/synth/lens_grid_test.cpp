// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/synth/lens_grid.hpp"

#include <algorithm>
#include <cmath>

#include "flat_scene.hpp"
#include "sslam/synth/rolling_shutter.hpp"
#include "support/catch.hpp"

namespace lens_grid_test {

using namespace sslam;
using namespace sslam::synth;

namespace {

Camera<double> camera_with(const RadTan<double>& distortion) {
  const View view = front_view();
  return {view.pinhole, distortion, view.width, view.height};
}

RenderedFrame render_through(const Scene& scene, const Camera<double>& camera) {
  Renderer renderer(scene);
  RenderedFrame frame;
  const auto still = [](double) { return SE3<double>(); };
  render_rolling_shutter(renderer, still, 0.0, {}, front_view(), LensGrid(camera), frame);
  return frame;
}

}  // namespace

TEST_CASE("a straight edge lies where the lens bends it to") {
  const auto [k1, k2, p1, p2] = GENERATE(table<double, double, double, double>(
      {{-0.28, 0.07, 0.0, 0.0}, {0.15, -0.05, 0.0, 0.0}, {-0.1, 0.0, 0.004, -0.006}}));
  const Camera<double> camera = camera_with({k1, k2, p1, p2, 0.0});
  double sum = 0.0, worst = 0.0;
  int count = 0;
  for (const double left : {-0.95, -0.6, -0.1, 0.4, 0.85}) {
    Scene scene;
    scene.faces.push_back(facing_card({-12.0, -12.0, 5.0}, 24.0, 24.0, 0.0, 0.2f));
    scene.faces.push_back(facing_card({left, -4.0, 2.0}, 8.0, 8.0, 0.05, 0.8f));
    const RenderedFrame frame = render_through(scene, camera);
    const Face& card = scene.faces[1];
    const auto edge_at = [&](double down) {
      return camera.distort_pixel(camera.pinhole.project(card.at(0.0, card.height - down)));
    };
    for (int y = 10; y < 110; ++y) {
      double low = 2.0, high = 6.0;
      for (int i = 0; i < 50; ++i) (edge_at(0.5 * (low + high)).y() < y ? low : high) = 0.5 * (low + high);
      const double truth = edge_at(low).x();
      if (truth < 8.0 || truth > 150.0) continue;
      const double error = step_on_row(frame, y, static_cast<int>(std::lround(truth)), 5, 0.2f, 0.8f) - truth;
      sum += error;
      worst = std::max(worst, std::abs(error));
      ++count;
    }
  }
  REQUIRE(count > 250);
  CHECK(std::abs(sum / count) < 0.01);
  CHECK(worst < 0.1);
}

TEST_CASE("depth is that of what a bent pixel shows") {
  const Camera<double> camera = camera_with({-0.28, 0.07, 0.001, 0.002, 0.0});
  Scene scene;  // a floor 1.2 m below
  scene.faces.push_back({{-40.0, 1.2, 1.0},
                         Vec3<double>::UnitX(),
                         Vec3<double>::UnitZ(),
                         80.0,
                         59.0,
                         {Vec3<float>::Constant(0.5f)},
                         even_light()});
  const RenderedFrame frame = render_through(scene, camera);
  int checked = 0;
  for (int y = 75; y < 120; y += 3) {
    for (int x = 0; x < 160; x += 3) {
      const Vec2<double> ideal = camera.undistort_pixel(Vec2<double>(x, y));
      const double inverse = camera.pinhole.unproject(ideal).y() / 1.2;
      const std::size_t pixel = static_cast<std::size_t>(y) * frame.width + x;
      REQUIRE(frame.surface[pixel] == 0);
      CHECK(std::abs(frame.inverse_depth[pixel] - inverse) < 1e-4);
      ++checked;
    }
  }
  CHECK(checked > 500);
}

TEST_CASE("a lens whose image turns back has no grid") {
  CHECK(LensGrid(camera_with({})).usable());
  CHECK(LensGrid(camera_with({-0.3, 0.1, 0.0, 0.0, 0.0})).usable());
  CHECK_FALSE(LensGrid(camera_with({-0.8, 0.0, 0.0, 0.0, 0.0})).usable());
}

}  // namespace lens_grid_test
