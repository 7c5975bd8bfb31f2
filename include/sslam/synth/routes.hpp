// SPDX-License-Identifier: BSD-3-Clause
// Where a person with a camera walks and looks: around a room, before a wall, through a sequence of rooms.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "sslam/core/random.hpp"
#include "sslam/synth/path.hpp"

namespace sslam::synth {

// The ellipse that a room leaves free for walking.
struct FreeArea {
  Vec2<double> centre;
  Vec2<double> half;  // semi-axes, metres
};

// Once around the area, looking across it to the other side with a gaze that wanders.
[[nodiscard]] inline Route loop_route(const FreeArea& area, Random& random) {
  Route route;
  const double start = random.uniform(0.0, kTurn), wander = random.uniform(0.0, kTurn);
  const double sense = random.below(2) == 0 ? 1.0 : -1.0, height = random.uniform(1.35, 1.6);
  constexpr int kPoints = 720;
  for (int i = 0; i < kPoints; ++i) {
    const double phase = kTurn * i / kPoints, angle = start + sense * phase;
    const double rim = 1.0 + 0.06 * std::sin(3.0 * phase + wander);
    const double yaw = angle + sense * (std::numbers::pi * 0.80 + 0.32 * std::sin(2.0 * phase + wander));
    route.points.push_back({{area.centre.x() + rim * area.half.x() * std::cos(angle),
                             area.centre.y() + rim * area.half.y() * std::sin(angle),
                             height + 0.08 * std::sin(2.0 * phase + 1.7 * wander)},
                            yaw,
                            -0.10 + 0.09 * std::sin(3.0 * phase + wander)});
  }
  route.turn = sense * kTurn;
  return route;
}

// To and fro on a flat figure of eight, facing one way within 35 degrees.
[[nodiscard]] inline Route sweep_route(const FreeArea& area, double facing, Random& random) {
  Route route;
  const double wander = random.uniform(0.0, kTurn), height = random.uniform(1.3, 1.6);
  const Vec2<double> ahead(std::cos(facing), std::sin(facing)), aside(-ahead.y(), ahead.x());
  const double reach = 0.9 * std::min(area.half.x(), area.half.y());
  constexpr int kPoints = 720;
  for (int i = 0; i < kPoints; ++i) {
    const double phase = kTurn * i / kPoints;
    const Vec2<double> at = area.centre - (0.35 * reach - 0.4 * reach * std::sin(2.0 * phase)) * ahead +
                            reach * std::sin(phase) * aside;
    route.points.push_back({{at.x(), at.y(), height + 0.15 * std::sin(2.0 * phase + wander)},
                            facing + 0.5 * std::sin(phase + 0.4 * std::sin(wander)),
                            -0.08 + 0.12 * std::sin(3.0 * phase + wander)});
  }
  return route;
}

// The loop, after turning on the spot to and fro by 50 degrees: no parallax for the first seconds.
[[nodiscard]] inline Route pivot_route(const FreeArea& area, Random& random) {
  const Route loop = loop_route(area, random);
  Route route;
  constexpr int kPoints = 240;
  for (int i = 0; i < kPoints; ++i) {
    RoutePoint point = loop.points.front();
    point.yaw -= std::copysign(0.44 * (1.0 - std::cos(kTurn * i / kPoints)), loop.turn);
    route.points.push_back(point);
  }
  route.points.insert(route.points.end(), loop.points.begin(), loop.points.end());
  route.turn = loop.turn;
  return route;
}

// Weighted mean of each point with its neighbours around a closed curve; `sigma` in points.
template <class Values>
[[nodiscard]] Values smoothed(const Values& in, double sigma) {
  const int n = static_cast<int>(in.size()), reach = static_cast<int>(3.0 * sigma);
  Values out = in;
  for (int i = 0; i < n; ++i) {
    auto sum = in[0];
    sum *= 0.0;
    double total = 0.0;
    for (int k = -reach; k <= reach; ++k) {
      const double weight = std::exp(-0.5 * k * k / (sigma * sigma));
      sum += weight * in[static_cast<std::size_t>(((i + k) % n + n) % n)];
      total += weight;
    }
    sum *= 1.0 / total;
    out[static_cast<std::size_t>(i)] = sum;
  }
  return out;
}

// Along a closed chain of way points with rounded corners, looking ahead with a gaze that wanders.
[[nodiscard]] inline Route tour_route(const std::vector<Vec2<double>>& way, Random& random) {
  constexpr double kStep = 0.05;
  std::vector<Vec2<double>> dense;
  for (std::size_t i = 0; i < way.size(); ++i) {
    const Vec2<double> run = way[(i + 1) % way.size()] - way[i];
    const int steps = std::max(1, static_cast<int>(run.norm() / kStep));
    for (int k = 0; k < steps; ++k) dense.push_back(way[i] + run * k / steps);
  }
  dense = smoothed(dense, 0.22 / kStep);
  const std::size_t n = dense.size(), ahead = static_cast<std::size_t>(1.3 / kStep);
  std::vector<double> bend(n), yaw(n);  // the change of heading from point to point, and its sum
  const auto heading = [&](std::size_t i) {
    const Vec2<double> run = dense[(i + ahead) % n] - dense[i % n];
    return std::atan2(run.y(), run.x());
  };
  for (std::size_t i = 0; i < n; ++i) bend[i] = std::remainder(heading(i + 1) - heading(i), kTurn);
  bend = smoothed(bend, 0.45 / kStep);
  yaw[0] = heading(0);
  for (std::size_t i = 1; i < n; ++i) yaw[i] = yaw[i - 1] + bend[i - 1];
  Route route;
  route.turn = kTurn * std::round((yaw[n - 1] + bend[n - 1] - yaw[0]) / kTurn);
  const double wander = random.uniform(0.0, kTurn), height = random.uniform(1.4, 1.6);
  const double waves = std::max(1.0, std::round(static_cast<double>(n) * kStep / 4.0));
  for (std::size_t i = 0; i < n; ++i) {
    const double phase = kTurn * static_cast<double>(i) / static_cast<double>(n);
    route.points.push_back({{dense[i].x(), dense[i].y(), height + 0.05 * std::sin(waves * phase)},
                            yaw[i] + 0.25 * std::sin(waves * phase + wander),
                            -0.08 + 0.06 * std::sin(2.0 * waves * phase + wander)});
  }
  return route;
}

}  // namespace sslam::synth
