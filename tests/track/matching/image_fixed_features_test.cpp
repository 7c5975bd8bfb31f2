// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/track/matching/image_fixed_features.hpp"

#include "support/catch.hpp"
#include "support/random_draws.hpp"
#include "track/simulation.hpp"

using namespace sslam;
using namespace sslam::testing;

namespace {

constexpr std::size_t kFixed = 60;

PointFeature<double> feature(Random& random, double left, double top, double right, double bottom) {
  PointFeature<double> point;
  const double u = random.uniform(left, right);
  point.pixel = {u, random.uniform(top, bottom)};
  for (auto& word : point.descriptor.words) word = random.next();
  return point;
}

// Behind the image's lower edge, a panel that the camera carries along.
std::vector<PointFeature<double>> panel(const Frame<double>& frame) {
  Random random(4);
  std::vector<PointFeature<double>> points;
  const double w = frame.width, h = frame.height;
  for (std::size_t i = 0; i < kFixed; ++i)
    points.push_back(feature(random, 0.1 * w, 0.85 * h, 0.9 * w, h - 1));
  return points;
}

// How many features of the world, and of the panel, are left of the frame.
std::pair<std::size_t, std::size_t> left_of(const Frame<double>& frame,
                                            const std::vector<PointFeature<double>>& fixed) {
  std::size_t of_panel = 0;
  for (const auto& point : frame.points)
    of_panel +=
        std::any_of(fixed.begin(), fixed.end(), [&](const auto& f) { return f.pixel == point.pixel; });
  return {frame.points.size() - of_panel, of_panel};
}

}  // namespace

TEST_CASE("What stays in the image while the camera walks is left out, and the world is not") {
  Simulation simulation(walk(90));
  ImageFixedFeatures<double> filter;
  for (std::size_t k = 0; k < simulation.size(); ++k) {
    Frame<double> frame = simulation.frame(k);
    const std::size_t world = frame.points.size();
    const auto fixed = panel(frame);
    frame.points.insert(frame.points.end(), fixed.begin(), fixed.end());
    const std::size_t left_out = filter.leave_out(frame, false);
    const auto [of_world, of_panel] = left_of(frame, fixed);
    if (k > 60) {
      CHECK(of_panel == 0);
      CHECK(left_out >= kFixed);
      CHECK(of_world > world - world / 10);  // but for what lies among the panel
    }
  }
}

TEST_CASE("A panel is found sooner before there is a map") {
  const auto found_at = [](bool early) {
    Simulation simulation(walk(90));
    ImageFixedFeatures<double> filter;
    for (std::size_t k = 0; k < simulation.size(); ++k) {
      Frame<double> frame = simulation.frame(k);
      const auto fixed = panel(frame);
      frame.points.insert(frame.points.end(), fixed.begin(), fixed.end());
      if (filter.leave_out(frame, early) >= kFixed) return k;
    }
    return simulation.size();
  };
  CHECK(found_at(true) < found_at(false));
}

TEST_CASE(
    "A walk without a panel loses nothing, nor does a camera at rest, or one before which somebody walks") {
  Simulation walking(walk(90));
  ImageFixedFeatures<double> of_walk, at_rest, with_person, off;
  off.options.travel = 0;
  const Frame<double> still = walking.frame(0);
  Random random(8);
  std::vector<PointFeature<double>> person;
  for (int i = 0; i < 60; ++i)
    person.push_back(
        feature(random, 0.1 * still.width, 0.2 * still.height, 0.3 * still.width, 0.9 * still.height));
  for (std::size_t k = 0; k < walking.size(); ++k) {
    Frame<double> frame = walking.frame(k);
    CHECK(of_walk.leave_out(frame, true) == 0);
    frame = still;
    CHECK(at_rest.leave_out(frame, true) == 0);
    frame = still;
    for (PointFeature<double> point : person) {
      point.pixel.x() += 4.0 * static_cast<double>(k % 60);
      frame.points.push_back(point);
    }
    CHECK(with_person.leave_out(frame, true) == 0);
    frame = still;
    CHECK(off.leave_out(frame, true) == 0);
  }
}

TEST_CASE("Lines among what is fixed go with it") {
  Simulation simulation(walk(90));
  ImageFixedFeatures<double> filter;
  for (std::size_t k = 0; k < simulation.size(); ++k) {
    Frame<double> frame = simulation.frame(k);
    // A row of points, and a line through them.
    Random random(4);
    for (int i = 0; i < 60; ++i) {
      frame.points.push_back(feature(random, 0, 0, 1, 1));
      frame.points.back().pixel = {100.0 + 4 * i, 0.9 * frame.height};
    }
    const std::size_t lines = frame.lines.size();
    LineFeature<double> line;
    line.segment = {{100, 0.9 * frame.height}, {330, 0.9 * frame.height}};
    frame.lines.push_back(line);
    filter.leave_out(frame, false);
    if (k > 60) CHECK(frame.lines.size() <= lines);
  }
}
