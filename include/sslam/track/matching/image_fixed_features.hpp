// SPDX-License-Identifier: BSD-3-Clause
// What never moves in the image while the rest does is no part of the world: burnt-in text, the dots of a
// projector, the robot's own parts. It is left out before anything is matched with it.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "sslam/core/median.hpp"
#include "sslam/core/parameter.hpp"
#include "sslam/map/feature_grid.hpp"

namespace sslam {

template <Scalar S>
struct ImageFixedOptions {
  S reach = 1;         // pixels that a feature may be off and still be where it was
  S travel = S(0.05);  // of the image's width, that the rest moves by meanwhile; 0: nothing is left out
  S early_travel =
      S(0.02);       // the same while there is no map: one that is made of such features never recovers
  S step = S(0.01);  // of the width, by which the rest has moved when it is looked at again
  std::size_t min_moved = 15;  // features that must agree, all over the image, on how it has moved

  template <class Self, class Visit>
  static void parameters(Self& self, Visit&& visit) {
    visit("reach", self.reach, Unit::kPixels, 0, 100, "that a feature may be off and still be where it was");
    visit("travel", self.travel, Unit::kShare, 0, 1,
          "of the image's width, that the rest moves by while a feature that is left out stays; 0: none is");
    visit("early_travel", self.early_travel, Unit::kShare, 0, 1, "the same while there is no map");
    visit("step", self.step, Unit::kShare, 0, 1,
          "of the width, by which the rest has moved when it is looked at again");
    visit("min_moved", self.min_moved, Unit::kCount, 1, 1000000,
          "features that must agree on how the image has moved");
  }
};
static_assert(Described<ImageFixedOptions<double>>);

template <Scalar S>
class ImageFixedFeatures {
 public:
  ImageFixedOptions<S> options;

  template <class Self, class Visit>
  static void parameters(Self& self, Visit&& visit) {
    visit_within("", self.options, visit);
  }

  // Erases them from the next frame of the sequence; the answer is how many points and lines that were.
  std::size_t leave_out(Frame<S>& frame, bool early) {
    if (!(options.travel > S(0)) || frame.width <= 0) return 0;
    width_ = frame.width;
    height_ = frame.height;
    ++age_;
    find_stays(frame);
    find_moves(frame);
    mark(frame, (early ? options.early_travel : options.travel) * static_cast<S>(width_));
    const Vec2<S> moved = median_move();
    if (moved.norm() >= options.step * static_cast<S>(width_))
      renew(frame, moved);
    else if (age_ >= kPatience)
      renew(frame, Vec2<S>::Zero());
    return erase_marked(frame);
  }

 private:
  // What is known of the place of a feature of the reference.
  struct Stay {
    Vec2<S> travelled = Vec2<S>::Zero();  // by the rest of the image, while the feature stayed, pixels
    int held = 0;                         // frames since the reference in which it was there
    int missed = 0;                       // looks in a row at which it was not
  };

  static constexpr int kColumns = 6, kRows = 4;  // parts of the image, half of which must have moved
  static constexpr int kCell = 16;               // pixels, of a region that is left out as a whole
  static constexpr int kPatience = 60;           // frames without a motion, until the reference is another
  static constexpr int kMaxMissed = 5;           // looks at which a fixed feature may be hidden

  // stay_[i]: the place of the reference where feature i is, or -1. Descriptors are not compared: what is
  // behind a dot changes.
  void find_stays(const Frame<S>& frame) {
    stay_.assign(frame.points.size(), -1);
    taken_.assign(places_.size(), 0);
    for (std::size_t i = 0; i < frame.points.size(); ++i) {
      const PointFeature<S>& point = frame.points[i];
      S nearest = options.reach;
      grid_.near(point.pixel, options.reach, [&](std::int32_t j) {
        const PointFeature<S>& place = places_[index(j)];
        const S off = (place.pixel - point.pixel).norm();
        if (off > nearest || taken_[index(j)]) return;
        nearest = off;
        stay_[i] = j;
      });
      if (stay_[i] < 0) continue;
      taken_[index(stay_[i])] = 1;
      ++stays_[index(stay_[i])].held;
    }
  }

  // Where the other features were in the reference, by their descriptors.
  void find_moves(const Frame<S>& frame) {
    constexpr S kReach = S(0.1);  // of the width
    constexpr int kClose = 50;    // bits
    moves_.clear();
    for (std::size_t i = 0; i < frame.points.size(); ++i) {
      if (stay_[i] >= 0) continue;
      const PointFeature<S>& point = frame.points[i];
      int best = 257, second = 257;
      std::int32_t match = -1;
      grid_.near(point.pixel, kReach * static_cast<S>(width_), [&](std::int32_t j) {
        if (taken_[index(j)]) return;
        const int bits = hamming(places_[index(j)].descriptor, point.descriptor);
        if (bits < best) {
          second = std::exchange(best, bits);
          match = j;
        } else {
          second = std::min(second, bits);
        }
      });
      if (match < 0 || best > kClose || 10 * best > 8 * second) continue;
      moves_.push_back({point.pixel, point.pixel - places_[index(match)].pixel});
    }
  }

  // By which the image has moved since the reference; zero where most moves, over most of the image, do not
  // agree: a camera at rest before which somebody walks, wrong matches, a roll.
  [[nodiscard]] Vec2<S> median_move() {
    if (moves_.size() < options.min_moved) return Vec2<S>::Zero();
    const auto middle_of = [this](int axis) {
      values_.clear();
      for (const Move& move : moves_) values_.push_back(move.by[axis]);
      return median<S>(values_);
    };
    const Vec2<S> middle(middle_of(0), middle_of(1));
    const S near = std::max(3 * options.reach, middle.norm() / 2);
    std::array<int, kColumns * kRows> parts{};
    std::size_t agree = 0;
    for (const Move& move : moves_)
      if ((move.by - middle).norm() < near) {
        ++parts[part_of(move.at)];
        ++agree;
      }
    const auto moving = std::count_if(parts.begin(), parts.end(), [](int count) { return count > 0; });
    const bool enough = agree >= options.min_moved && 5 * agree >= 3 * moves_.size();
    return enough && 2 * moving >= kColumns * kRows ? middle : Vec2<S>(Vec2<S>::Zero());
  }

  // Features at places that have stayed while the image travelled so far, and what lies among them.
  void mark(const Frame<S>& frame, S travel) {
    fixed_.assign(frame.points.size(), 0);
    cells_.assign(static_cast<std::size_t>(columns() * (height_ / kCell + 1)), {0, 0});
    for (std::size_t i = 0; i < frame.points.size(); ++i) {
      fixed_[i] = stay_[i] >= 0 && stays_[index(stay_[i])].travelled.norm() >= travel;
      auto& [marked, all] = cells_[cell_of(frame.points[i].pixel)];
      marked += fixed_[i];
      ++all;
    }
    for (std::size_t i = 0; i < frame.points.size(); ++i)
      if (is_fixed(frame.points[i].pixel)) fixed_[i] = 1;
  }

  // This frame is the reference from now on. Places that were held most of the time stay as they were.
  void renew(const Frame<S>& frame, const Vec2<S>& moved) {
    std::size_t kept = 0;
    const S travel = options.travel * static_cast<S>(width_);
    for (std::size_t j = 0; j < places_.size(); ++j) {
      Stay stay = stays_[j];
      const bool held = 10 * stay.held >= 7 * age_;
      stay.missed = held ? 0 : stay.missed + 1;
      if (held) stay.travelled += moved;
      stay.held = 0;
      if (!held && (stay.travelled.norm() < travel || stay.missed > kMaxMissed)) continue;
      places_[kept] = places_[j];
      stays_[kept++] = stay;
    }
    places_.resize(kept);
    stays_.resize(kept);
    for (std::size_t i = 0; i < frame.points.size(); ++i) {
      if (stay_[i] >= 0) continue;
      places_.push_back(frame.points[i]);
      stays_.emplace_back();
    }
    grid_.build(places_, width_, height_);
    age_ = 0;
  }

  std::size_t erase_marked(Frame<S>& frame) const {
    std::size_t i = 0;
    const std::size_t points =
        std::erase_if(frame.points, [&](const PointFeature<S>&) { return fixed_[i++] != 0; });
    if (points == 0) return 0;
    return points + std::erase_if(frame.lines, [&](const LineFeature<S>& line) { return is_fixed(line); });
  }

  // Within regions most of whose points are fixed.
  [[nodiscard]] bool is_fixed(const Vec2<S>& pixel) const {
    const auto [marked, all] = cells_[cell_of(pixel)];
    return marked >= 2 && 3 * marked >= 2 * all;
  }
  [[nodiscard]] bool is_fixed(const LineFeature<S>& line) const {
    constexpr int kSteps = 8;
    int inside = 0;
    for (int k = 0; k <= kSteps; ++k) {
      const S share = static_cast<S>(k) / kSteps;
      inside += is_fixed(Vec2<S>(line.segment.start + share * (line.segment.end - line.segment.start)));
    }
    return 3 * inside > 2 * (kSteps + 1);
  }

  [[nodiscard]] static std::size_t index(std::int32_t i) noexcept { return static_cast<std::size_t>(i); }
  [[nodiscard]] int columns() const noexcept { return width_ / kCell + 1; }
  [[nodiscard]] std::size_t cell_of(const Vec2<S>& pixel) const noexcept {
    const int u = std::clamp(static_cast<int>(pixel.x()) / kCell, 0, width_ / kCell);
    const int v = std::clamp(static_cast<int>(pixel.y()) / kCell, 0, height_ / kCell);
    return static_cast<std::size_t>(v * columns() + u);
  }
  [[nodiscard]] std::size_t part_of(const Vec2<S>& pixel) const noexcept {
    const int u =
        std::clamp(static_cast<int>(pixel.x() * kColumns / static_cast<S>(width_)), 0, kColumns - 1);
    const int v = std::clamp(static_cast<int>(pixel.y() * kRows / static_cast<S>(height_)), 0, kRows - 1);
    return static_cast<std::size_t>(v * kColumns + u);
  }

  struct Move {
    Vec2<S> at, by;  // pixels
  };

  int width_ = 0, height_ = 0;
  int age_ = kPatience;                  // frames since the reference
  std::vector<PointFeature<S>> places_;  // of the reference
  std::vector<Stay> stays_;              // one for each of them
  FeatureGrid<S> grid_;                  // over them
  std::vector<std::int32_t> stay_;
  std::vector<std::uint8_t> taken_, fixed_;
  std::vector<Move> moves_;
  std::vector<S> values_;
  std::vector<std::pair<int, int>> cells_;  // features that are fixed, and all
};

}  // namespace sslam
