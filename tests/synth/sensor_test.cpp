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
