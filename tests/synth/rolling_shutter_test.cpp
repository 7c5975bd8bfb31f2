// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/synth/rolling_shutter.hpp"

#include <algorithm>
#include <cmath>

#include "flat_scene.hpp"
#include "support/catch.hpp"

namespace rolling_shutter_test {

using namespace sslam;
using namespace sslam::synth;

namespace {

Scene leaning_card() {
  Scene scene;
  scene.faces.push_back(facing_card({-8.0, -8.0, 5.0}, 16.0, 16.0, 0.0, 0.2f));
  scene.faces.push_back(facing_card({-0.21, -2.0, 2.0}, 1.0, 4.0, 0.1, 0.8f));
  return scene;
}

// Turns to the side and moves ahead.
SE3<double> pose_at(double seconds) {
  return {SO3<double>::exp(Vec3<double>(0.0, 0.6 * seconds, 0.0)), {0.0, 0.0, -0.5 * seconds}};
}

float largest_difference(const RenderedFrame& a, const RenderedFrame& b, int row) {
  float most = 0.0f;
  for (int x = 0; x < a.width; ++x) most = std::max(most, std::abs(grey_at(a, x, row) - grey_at(b, x, row)));
  return most;
}

}  // namespace

TEST_CASE("a row shows what a global shutter sees at the moment when the row is read") {
  const Scene scene = leaning_card();
  Renderer renderer(scene);
  View view = front_view();
  const Shutter shutter{0.0, 0.08};
  RenderedFrame rolling, whole, middle;
  render_rolling_shutter(renderer, pose_at, 0.5, shutter, view, LensGrid(), rolling);
  render_open_shutter(renderer, pose_at, 0.5, 0.0, view, middle);
  for (int row = 0; row < view.height; row += 7) {
    view.cam_from_world = pose_at(row_moment(shutter, 0.5, row, view.height));
    renderer.render(view, whole);
    CHECK(largest_difference(rolling, whole, row) < 0.06f);  // 3 of the 32 points of an edge's pixel
    const std::size_t pixel = static_cast<std::size_t>(row) * view.width + 80;
    CHECK(std::abs(rolling.inverse_depth[pixel] - whole.inverse_depth[pixel]) < 1e-4f);
    CHECK(rolling.face[rolling.surface[pixel]] == whole.face[whole.surface[pixel]]);
  }
  CHECK(largest_difference(rolling, middle, view.height / 2) < 0.06f);
  CHECK(largest_difference(rolling, middle, 0) > 0.3f);
  CHECK(largest_difference(rolling, middle, view.height - 1) > 0.3f);
}

TEST_CASE("rows that are read at once are those of a global shutter") {
  const Scene scene = leaning_card();
  Renderer renderer(scene);
  RenderedFrame rows, whole;
  for (const double open : {0.0, 0.05}) {
    render_rolling_shutter(renderer, pose_at, 0.2, {open, 0.0}, front_view(), LensGrid(), rows);
    render_open_shutter(renderer, pose_at, 0.2, open, front_view(), whole);
    for (int row = 0; row < whole.height; ++row) CHECK(largest_difference(rows, whole, row) < 1e-3f);
    CHECK(rows.surface == whole.surface);
    CHECK(rows.normals.size() == whole.normals.size());
  }
}

}  // namespace rolling_shutter_test
