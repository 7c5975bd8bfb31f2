// SPDX-License-Identifier: BSD-3-Clause
// The plan of a floor: corridors side by side, rooms on both sides of each, and where there are several
// corridors, one across that joins them. Its tour enters every room and ends where it began.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "sslam/core/random.hpp"
#include "sslam/synth/rooms.hpp"

namespace sslam::synth {

// Along a corridor, whose own x runs from its entrance and y across it; a room lies beyond y = kCorridor on
// the left, below y = 0 on the right.
struct PlannedRoom {
  Vec2<double> low, high;  // of its bounding box, world
  double door;             // x of the middle of its door
  bool left;
};

struct PlannedCorridor {
  Vec2<double> low, high;
  std::vector<PlannedRoom> rooms;  // left ones first, each side from the entrance on
};

struct FloorPlan {
  static constexpr double kWall = 0.12;     // depth of a wall, metres
  static constexpr double kCorridor = 1.8;  // width
  static constexpr double kHalfDoor = 0.5;  // of a passage
  static constexpr double kDoorHeight = 2.1;
  static constexpr int kRoomsOfCorridor = 10;  // at most

  std::vector<PlannedCorridor> corridors;  // along x, from the lowest y on
  Vec2<double> cross_low, cross_high;      // of the corridor across; of no meaning where there is one alone

  [[nodiscard]] bool has_cross() const noexcept { return corridors.size() > 1; }
};

[[nodiscard]] inline FloorPlan plan_floor(int rooms, Random& random) {
  constexpr double kDeepest = 4.8, kWall = FloorPlan::kWall, kWide = FloorPlan::kCorridor;
  FloorPlan plan;
  const int corridors = (rooms + FloorPlan::kRoomsOfCorridor - 1) / FloorPlan::kRoomsOfCorridor;
  for (int c = 0; c < corridors; ++c) {
    const int here = rooms * (c + 1) / corridors - rooms * c / corridors;
    const double base = c * (kWide + 2.0 * kDeepest + 3.0 * kWall);
    PlannedCorridor corridor{{0.0, base}, {0.0, base + kWide}, {}};
    for (const bool left : {true, false}) {
      double x = 0.0;
      for (int i = 0; i < (left ? (here + 1) / 2 : here / 2); ++i) {
        const double right = x + random.uniform(3.6, 4.2), deep = random.uniform(4.0, kDeepest);
        const double near = left ? base + kWide + kWall : base - kWall;
        const double far = left ? near + deep : near - deep;
        corridor.rooms.push_back({{x, std::min(near, far)},
                                  {right, std::max(near, far)},
                                  x + (right - x) * random.uniform(0.42, 0.58),
                                  left});
        corridor.high.x() = std::max(corridor.high.x(), right);
        x = right + kWall;
      }
    }
    plan.corridors.push_back(corridor);
  }
  constexpr double kHall = 3.0;  // before the first corridor
  plan.cross_low = {-kWall - kWide, plan.corridors.front().low.y() - kHall};
  plan.cross_high = {-kWall, plan.corridors.back().high.y()};
  return plan;
}

// From a corridor along x, its right wall at y = 0, through a door on the left, once around the room, and out
// again.
[[nodiscard]] inline Outline room_visit(double door, double deep, double near, double middle, double far) {
  const double centre = 0.5 * (near + far) + 0.1, r = 0.75;
  return {{door - 0.5, 0.55 * deep},  {door, deep - 0.4},       {door, near + 0.5},
          {middle + r, centre - 0.3}, {middle + r, centre + r}, {middle - r, centre + r},
          {middle - r, centre - 0.3}, {door, near + 0.5},       {door, deep - 0.4},
          {door + 0.5, 0.55 * deep}};
}

// Outwards along each corridor into the rooms on the left, back into those on the right; then once more into
// the first room. The way is closed.
class TourPlanner {
 public:
  explicit TourPlanner(const FloorPlan& plan) : plan_(plan) {}

  [[nodiscard]] Outline tour() {
    const double across = 0.5 * (plan_.cross_low.x() + plan_.cross_high.x());
    if (plan_.has_cross()) way_.emplace_back(across + kLane, plan_.cross_low.y() + 0.9);
    for (const PlannedCorridor& corridor : plan_.corridors) {
      enter(corridor, across + kLane);
      for (const PlannedRoom& room : corridor.rooms)
        if (room.left) visit(corridor, room);
      way_.emplace_back(corridor.high.x() - 0.8, corridor.low.y() + 0.6 * FloorPlan::kCorridor);
      way_.emplace_back(corridor.high.x() - 0.8, corridor.low.y() + 0.4 * FloorPlan::kCorridor);
      for (std::size_t i = corridor.rooms.size(); i-- > 0;)
        if (!corridor.rooms[i].left) visit(corridor, corridor.rooms[i]);
      leave(corridor, across + kLane);
    }
    const PlannedCorridor& first = plan_.corridors.front();
    enter(first, across - kLane);
    visit(first, first.rooms.front());
    leave(first, across - kLane);
    if (plan_.has_cross()) way_.emplace_back(across - kLane, plan_.cross_low.y() + 0.9);
    return way_;
  }

 private:
  static constexpr double kLane = 0.2;  // off the middle, on the way there to one side and back to the other

  // Without a corridor across, the way turns at the near end.
  void enter(const PlannedCorridor& corridor, double from) {
    const double middle = corridor.low.y() + 0.5 * FloorPlan::kCorridor;
    if (!plan_.has_cross()) return way_.emplace_back(0.8, middle + 0.1), void();
    way_.emplace_back(from, middle);
    way_.emplace_back(-0.5 * FloorPlan::kWall, middle);
    way_.emplace_back(0.8, middle);
  }
  void leave(const PlannedCorridor& corridor, double to) {
    const double middle = corridor.low.y() + 0.5 * FloorPlan::kCorridor;
    if (!plan_.has_cross()) return way_.emplace_back(0.8, middle - 0.1), void();
    way_.emplace_back(0.8, middle);
    way_.emplace_back(-0.5 * FloorPlan::kWall, middle);
    way_.emplace_back(to, middle);
  }

  // Rooms on the right are met on the way back: the same half a turn on.
  void visit(const PlannedCorridor& corridor, const PlannedRoom& room) {
    constexpr double kDeep = FloorPlan::kCorridor, kNear = kDeep + FloorPlan::kWall;
    const double middle = 0.5 * (room.low.x() + room.high.x()), far = kNear + room.high.y() - room.low.y();
    if (room.left) {
      for (const Vec2<double>& p : room_visit(room.door, kDeep, kNear, middle, far))
        way_.emplace_back(p.x(), corridor.low.y() + p.y());
    } else {
      for (const Vec2<double>& p : room_visit(room.door, kDeep, kNear, 2.0 * room.door - middle, far))
        way_.emplace_back(2.0 * room.door - p.x(), corridor.high.y() - p.y());
    }
  }

  const FloorPlan& plan_;
  Outline way_;
};

}  // namespace sslam::synth
