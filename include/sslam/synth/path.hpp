// SPDX-License-Identifier: BSD-3-Clause
// A closed, twice continuously differentiable camera path: a uniform cubic B-spline over a route, at walking
// speed, slowed down where it turns, with the small tremor of a hand.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "sslam/core/random.hpp"
#include "sslam/geometry/se3.hpp"

namespace sslam::synth {

inline constexpr double kTurn = 2.0 * std::numbers::pi;

// World: z up. Yaw turns about z from the x axis, pitch looks up; radians.
struct RoutePoint {
  Vec3<double> position;
  double yaw, pitch;
};

// One lap; the last point leads back to the first, with the yaw larger by `turn` (a multiple of 2 pi).
struct Route {
  std::vector<RoutePoint> points;
  double turn = 0.0;
};

struct PathOptions {
  double speed = 0.5;          // metres per second where the path is straight
  double max_rate_deg = 35.0;  // degrees per second of yaw and pitch, before the tremor
  double tremor = 1.0;         // 1: about 4 mm and 0.2 degrees
  double knot_seconds = 0.4;   // spacing of the spline's knots
  double shake = 0.0;          // faster than the tremor; 1: about 0.5 mm and 0.1 degrees at 4 to 9 Hz
  double stand = 0.0;          // seconds of standing before the first step
};

class ClosedPath {
 public:
  ClosedPath(const Route& route, const PathOptions& options, std::uint64_t seed)
      : turn_(route.turn), stand_(options.stand) {
    const std::vector<double> stamp = schedule(route, options);
    const int knots = std::max(8, static_cast<int>(std::lround(stamp.back() / options.knot_seconds)));
    lap_seconds_ = stamp.back();
    std::size_t segment = 0;
    for (int i = 0; i < knots; ++i) {
      const double at = lap_seconds_ * i / knots;
      while (stamp[segment + 1] < at) ++segment;
      const double share = (at - stamp[segment]) / std::max(stamp[segment + 1] - stamp[segment], 1e-12);
      knots_.push_back((1.0 - share) * values(route, segment) + share * values(route, segment + 1));
    }
    Random random(seed);
    for (std::size_t i = 0; i < sways_.size(); ++i) {
      const bool moves = i % 6 < 3;
      if (i < kTremors) {
        const double size = options.tremor * (moves ? 0.0025 : radians(0.12)) * random.uniform(0.6, 1.4);
        const double hertz = random.uniform(0.4, 2.6);
        sways_[i] = {size / std::max(hertz, 0.8), kTurn * hertz, random.uniform(0.0, 6.28318)};
      } else {
        const double size = options.shake * (moves ? 0.0005 : radians(0.1)) * random.uniform(0.6, 1.4);
        sways_[i] = {size, kTurn * random.uniform(4.0, 9.0), random.uniform(0.0, 6.28318)};
      }
    }
  }

  [[nodiscard]] double lap_seconds() const noexcept { return lap_seconds_; }
  // With the time of standing.
  [[nodiscard]] double first_lap_seconds() const noexcept {
    return lap_seconds_ + (stand_ > 0.0 ? stand_ + 0.5 * kStart : 0.0);
  }

  // The camera at a time in seconds; laps repeat, the tremor does not.
  [[nodiscard]] SE3<double> world_from_cam(double seconds) const {
    Vec<double, 5> state = spline(walked(seconds));
    Vec6<double> sway = Vec6<double>::Zero();
    for (std::size_t i = 0; i < sways_.size(); ++i) {
      sway[static_cast<int>(i % 6)] += sways_[i].size * std::sin(sways_[i].rate * seconds + sways_[i].phase);
    }
    const double yaw = state[3] + sway[3], pitch = state[4] + sway[4], roll = sway[5];
    const Vec3<double> forward(std::cos(yaw) * std::cos(pitch), std::sin(yaw) * std::cos(pitch),
                               std::sin(pitch));
    const Vec3<double> level(std::sin(yaw), -std::cos(yaw), 0.0);
    const Vec3<double> steep(std::cos(yaw) * std::sin(pitch), std::sin(yaw) * std::sin(pitch),
                             -std::cos(pitch));
    Mat3<double> axes;
    axes.col(0) = std::cos(roll) * level + std::sin(roll) * steep;
    axes.col(1) = std::cos(roll) * steep - std::sin(roll) * level;
    axes.col(2) = forward;
    SE3<double> pose;
    pose.rotation = SO3<double>::from_matrix(axes);
    pose.translation = state.head<3>() + sway.head<3>();
    return pose;
  }

 private:
  struct Sway {
    double size, rate, phase;
  };
  static constexpr std::size_t kTremors = 18, kShakes = 12;
  static constexpr double kStart = 1.0;  // seconds from standing to full speed

  // How long the walk would have taken without standing and starting.
  [[nodiscard]] double walked(double seconds) const noexcept {
    if (!(stand_ > 0.0)) return seconds;
    const double since = std::max(0.0, seconds - stand_);
    return since < kStart ? 0.5 * since * since / kStart : since - 0.5 * kStart;
  }

  static Vec<double, 5> values(const Route& route, std::size_t i) {
    const RoutePoint& p = route.points[i % route.points.size()];
    Vec<double, 5> out;
    out << p.position, p.yaw + (i == route.points.size() ? route.turn : 0.0), p.pitch;
    return out;
  }

  // The time at each point of the route and at its return to the first.
  static std::vector<double> schedule(const Route& route, const PathOptions& options) {
    std::vector<double> stamp{0.0};
    const double max_rate = radians(options.max_rate_deg);
    for (std::size_t i = 0; i < route.points.size(); ++i) {
      const Vec<double, 5> step = values(route, i + 1) - values(route, i);
      stamp.push_back(stamp.back() +
                      std::hypot(step.head<3>().norm() / options.speed, step.tail<2>().norm() / max_rate));
    }
    return stamp;
  }

  [[nodiscard]] Vec<double, 5> spline(double seconds) const {
    const int n = static_cast<int>(knots_.size());
    const double place = seconds / lap_seconds_ * n, base = std::floor(place), x = place - base;
    const std::array<double, 4> weight{
        (1.0 - x) * (1.0 - x) * (1.0 - x) / 6.0, (3.0 * x * x * x - 6.0 * x * x + 4.0) / 6.0,
        (-3.0 * x * x * x + 3.0 * x * x + 3.0 * x + 1.0) / 6.0, x * x * x / 6.0};
    Vec<double, 5> sum = Vec<double, 5>::Zero();
    for (int k = 0; k < 4; ++k) {
      const int index = static_cast<int>(base) + k - 1;
      const int lap = index >= 0 ? index / n : -((n - 1 - index) / n);
      Vec<double, 5> knot = knots_[static_cast<std::size_t>(index - lap * n)];
      knot[3] += turn_ * lap;
      sum += weight[k] * knot;
    }
    return sum;
  }

  double turn_, stand_, lap_seconds_ = 0.0;
  std::vector<Vec<double, 5>> knots_;
  std::array<Sway, kTremors + kShakes> sways_;
};

}  // namespace sslam::synth
