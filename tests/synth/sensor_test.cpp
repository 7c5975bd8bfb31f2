// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/synth/sensor.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "support/catch.hpp"

using namespace sslam::synth;

namespace {

RenderedFrame grey_frame(float grey) {
  RenderedFrame frame;
  frame.resize(200, 150);
  frame.rgb.assign(frame.rgb.size(), grey);
  return frame;
}

std::vector<std::uint8_t> expose(const Sensor& sensor, int number, double seconds = 0.0) {
  std::vector<std::uint8_t> out;
  sensor.expose(grey_frame(0.5f), number, seconds, out);
  return out;
}

}  // namespace

TEST_CASE("noise has the strength that was asked for and no bias") {
  const Sensor sensor({2.0f, 0.0f, 0.0f, 1.0f}, 5);
  double sum = 0.0, squares = 0.0;
  const std::vector<std::uint8_t> image = expose(sensor, 3);
  for (const std::uint8_t value : image) {
    sum += value - 127.5;
    squares += (value - 127.5) * (value - 127.5);
  }
  const double count = static_cast<double>(image.size()), mean = sum / count;
  CHECK(std::abs(mean - 0.0) < 0.05);
  CHECK(std::abs(std::sqrt(squares / count - mean * mean) - 2.0) < 0.1);
}

TEST_CASE("noise depends on seed and frame alone") {
  const SensorOptions options;
  CHECK(expose(Sensor(options, 1), 4) == expose(Sensor(options, 1), 4));
  CHECK(expose(Sensor(options, 1), 4) != expose(Sensor(options, 1), 5));
  CHECK(expose(Sensor(options, 1), 4) != expose(Sensor(options, 2), 4));
}

TEST_CASE("exposure steps within its bounds") {
  const Sensor sensor({0.0f, 0.0f, 0.2f, 0.5f}, 8);
  int lowest = 255, highest = 0;
  for (int i = 0; i < 200; ++i) {
    const int level = expose(sensor, i, i / 10.0).front();
    lowest = std::min(lowest, level);
    highest = std::max(highest, level);
  }
  CHECK(lowest >= 101);
  CHECK(highest <= 154);
  CHECK(highest - lowest > 25);
}

TEST_CASE("exposure and white balance wander slowly within their bounds") {
  SensorOptions options;
  options.noise = options.vignetting = 0.0f;
  options.exposure_drift = 0.2f;
  options.white_balance_drift = 0.1f;
  const Sensor sensor(options, 3);
  std::vector<double> green, warmth;
  for (int i = 0; i < 400; ++i) {
    const std::vector<std::uint8_t> image = expose(sensor, i, i * 0.2);
    green.push_back(image[1]);
    warmth.push_back(static_cast<double>(image[0]) / image[1]);
    CHECK(std::abs(image[0] + image[2] - 2.0 * image[1]) <= 2.0);  // red gains what blue loses
  }
  const auto [darkest, brightest] = std::minmax_element(green.begin(), green.end());
  CHECK((*darkest >= 101 && *brightest <= 154 && *brightest - *darkest > 20));
  const auto [coldest, warmest] = std::minmax_element(warmth.begin(), warmth.end());
  CHECK((*coldest > 0.885 && *warmest < 1.115 && *warmest - *coldest > 0.05));
  for (std::size_t i = 1; i < green.size(); ++i) CHECK(std::abs(green[i] - green[i - 1]) < 6);
}
