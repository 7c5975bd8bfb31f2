// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/synth/render.hpp"

#include <algorithm>
#include <cmath>

#include "flat_scene.hpp"
#include "sslam/synth/pattern.hpp"
#include "sslam/synth/shutter.hpp"
#include "support/catch.hpp"

using namespace sslam;
using namespace sslam::synth;

namespace {

Scene card_before_wall(double turn) {
  Scene scene;
  scene.faces.push_back(facing_card({-8.0, -8.0, 5.0}, 16.0, 16.0, 0.0, 0.2f));
  scene.faces.push_back(facing_card({-0.21, -0.47, 2.0}, 3.0, 3.0, turn, 0.8f));
  return scene;
}

RenderedFrame render(const Scene& scene, const View& view) {
  RenderedFrame frame;
  Renderer(scene).render(view, frame);
  return frame;
}

}  // namespace

TEST_CASE("an edge lies where geometry puts it") {
  const View view = front_view();
  double sum = 0.0, worst = 0.0;
  int count = 0;
  for (const double turn : {0.0, 0.013, 0.1, 0.3, -0.2, -0.45}) {
    const Scene scene = card_before_wall(turn);
    const RenderedFrame frame = render(scene, view);
    const Face& card = scene.faces[1];
    const Vec2<double> top = view.pinhole.project(card.at(0.0, card.height));
    const Vec2<double> end = view.pinhole.project(card.origin);
    for (int y = static_cast<int>(top.y()) + 8; y < 110; ++y) {
      const double truth = top.x() + (y - top.y()) / (end.y() - top.y()) * (end.x() - top.x());
      if (truth < 8.0 || truth > 150.0) continue;
      const double error = step_on_row(frame, y, static_cast<int>(std::lround(truth)), 5, 0.2f, 0.8f) - truth;
      sum += error;
      worst = std::max(worst, std::abs(error));
      ++count;
    }
  }
  REQUIRE(count > 200);
  CHECK(std::abs(sum / count) < 0.01);
  CHECK(worst < 0.1);
}

TEST_CASE("a corner of the room projects onto the corner in the image") {
  const View view = front_view();
  const Scene scene = card_before_wall(0.0);
  const RenderedFrame frame = render(scene, view);
  const Vec2<double> corner = view.pinhole.project(scene.faces[1].at(0.0, scene.faces[1].height));
  const int x = static_cast<int>(std::lround(corner.x())), y = static_cast<int>(std::lround(corner.y()));
  CHECK(std::abs(step_on_row(frame, y + 20, x, 5, 0.2f, 0.8f) - corner.x()) < 0.05);
  double beyond = 0.0;
  for (int v = y - 5; v <= y + 5; ++v) beyond += (grey_at(frame, x + 20, v) - 0.2) / 0.6;
  CHECK(std::abs(y + 5.5 - beyond - corner.y()) < 0.05);
}

TEST_CASE("a bar thinner than a pixel keeps its light on every row") {
  Scene scene;
  scene.faces.push_back(facing_card({-8.0, -8.0, 5.0}, 16.0, 16.0, 0.0, 0.2f));
  scene.faces.push_back(facing_card({0.1, -3.0, 2.0}, 0.005, 6.0, 0.02, 0.8f));  // a third of a pixel wide
  const RenderedFrame frame = render(scene, front_view());
  for (int y = 10; y < 110; ++y) {
    double light = 0.0;
    for (int x = 60; x < 110; ++x) light += (grey_at(frame, x, y) - 0.2) / 0.6;
    CHECK(std::abs(light - 0.325) < 0.13);
  }
}

TEST_CASE("a texture finer than the pixels turns into its mean") {
  Scene scene;
  const auto stripes = [](float s, float, float* out) { out[0] = 0.5f + 0.5f * std::sin(400.0f * s); };
  Face wall = facing_card({-4.0, -3.0, 6.0}, 8.0, 6.0, 0.0, 0.5f);
  wall.paint.texture = scene.add(Texture::bake(8.0f, 6.0f, 0.004f, 1, stripes));
  wall.paint.swing = Vec3<float>::Constant(0.8f);
  scene.faces.push_back(wall);
  const RenderedFrame frame = render(scene, front_view());  // a pixel is 46 mm, a period of the stripes 16 mm
  for (int y = 20; y < 100; ++y) {
    for (int x = 20; x < 140; ++x) REQUIRE(std::abs(grey_at(frame, x, y) - 0.5f) < 0.03);
  }
}

TEST_CASE("nothing in view is black without depth") {
  const RenderedFrame frame = render(Scene{}, front_view());
  CHECK(*std::max_element(frame.rgb.begin(), frame.rgb.end()) == 0.0f);
  CHECK(*std::max_element(frame.surface.begin(), frame.surface.end()) == -1);
}

TEST_CASE("a face shows its front alone") {
  Scene scene;
  scene.faces.push_back(facing_card({-8.0, -8.0, 5.0}, 16.0, 16.0, 0.0, 0.2f));
  std::swap(scene.faces[0].along_s, scene.faces[0].along_t);
  CHECK(render(scene, front_view()).surface[0] == -1);
}

TEST_CASE("a moving camera smears an edge about where it is in the middle of the exposure") {
  const Scene scene = card_before_wall(0.0);
  const View view = front_view();
  const auto pose_at = [](double t) {
    SE3<double> pose;
    pose.translation.x() = 2.0 * t;
    return pose;
  };
  Renderer renderer(scene);
  RenderedFrame sharp, still, smeared;
  renderer.render(view, sharp);
  render_open_shutter(renderer, pose_at, 0.0, 0.0, view, still);
  CHECK(still.rgb == sharp.rgb);
  render_open_shutter(renderer, pose_at, 0.0, 1.0 / 30.0, view, smeared);
  CHECK(smeared.surface == sharp.surface);
  const int y = 60, x = static_cast<int>(std::lround(view.pinhole.project({-0.21, 0.0, 2.0}).x()));
  const double smeared_at = step_on_row(smeared, y, x, 8, 0.2f, 0.8f);
  CHECK(std::abs(smeared_at - step_on_row(sharp, y, x, 8, 0.2f, 0.8f)) < 0.05);
  CHECK(std::abs(grey_at(smeared, x + 2, y) - grey_at(sharp, x + 2, y)) > 0.02f);
}
