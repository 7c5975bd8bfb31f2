// SPDX-License-Identifier: BSD-3-Clause
// Finds line segments: regions of one level-line direction, each as long and thin as a segment is (Grompone
// von Gioi, Jakubowicz, Morel, Randall, LSD: a Line Segment Detector, IPOL 2012, without its validation by
// the number of false alarms).
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

#include "sslam/core/parameter.hpp"
#include "sslam/geometry/line2.hpp"
#include "sslam/image/level_lines.hpp"

namespace sslam {

struct SegmentDetectorOptions {
  double gradient_error = 1;         // bound on it, grey levels a pixel: lower finds fainter edges
  double max_angle = radians(22.5);  // between the level lines of a region and their mean
  double min_density = 0.7;          // of a region in its rectangle: less is a curve, or two edges

  template <class Self, class Visit>
  static void parameters(Self& self, Visit&& visit) {
    visit("gradient_error", self.gradient_error, Unit::kNumber, 0.01, 255,
          "grey levels a pixel: lower finds fainter edges");
    visit("max_angle", self.max_angle, Unit::kDegrees, 1, 60,
          "between the level lines of a region and their mean");
    visit("min_density", self.min_density, Unit::kShare, 0, 1,
          "of a region in its rectangle: less is a curve, or two edges");
  }
};
static_assert(Described<SegmentDetectorOptions>);

class SegmentDetector {
 public:
  SegmentDetectorOptions options;

  // Adds the segments of the grey `image` in its pixels. The brighter side lies to the left hand
  // of start -> end (x right, y down).
  void detect(ImageView<std::uint8_t> image, std::vector<Segment2<double>>& segments) {
    // Below this slope the error of the gradient turns its direction by more than the tolerance.
    const double tolerance = options.max_angle;
    level_lines_.compute(image, static_cast<float>(options.gradient_error / std::sin(tolerance)));
    taken_.assign(level_lines_.size(), 1);
    for (const int place : level_lines_.places()) taken_[index(place)] = 0;
    const std::size_t least = smallest_region(image.size());
    for (const int seed : level_lines_.places()) {
      if (taken_[index(seed)]) continue;
      grow(seed, tolerance);
      if (region_.size() < least) continue;
      Rectangle rectangle = enclose();
      if (density(rectangle) < options.min_density && !thin_out(tolerance, rectangle)) continue;
      const Vec2<double> middle = level_lines_.pixel(seed);
      segments.push_back({middle + rectangle.start(), middle + rectangle.stop()});
    }
  }

 private:
  struct Member {
    int place;
    float slope;
    Vec2<double> off;  // pixels from the seed
  };
  struct Rectangle {
    Vec2<double> centre, along;  // pixels from the seed; unit
    double begin = 0, end = 0;   // extent along it, from the centre
    double width = 1;

    [[nodiscard]] Vec2<double> start() const { return centre + begin * along; }
    [[nodiscard]] Vec2<double> stop() const { return centre + end * along; }
  };

  [[nodiscard]] static std::size_t index(int place) noexcept { return static_cast<std::size_t>(place); }

  // Of so many places, or more, whose level lines agree by chance, less than one region is expected in an
  // image of noise: width, height and place of a rectangle are (w h)^(5/2) choices, each with 11 tolerances.
  [[nodiscard]] std::size_t smallest_region(ImageSize size) const noexcept {
    const double tests = 2.5 * (std::log10(size.width) + std::log10(size.height)) + std::log10(11.0);
    return static_cast<std::size_t>(-tests / std::log10(options.max_angle / std::numbers::pi));
  }

  // The region around the seed whose level lines lie within `tolerance`, radians, of the mean of those
  // before.
  void grow(int seed, double tolerance) {
    const auto cosine = static_cast<float>(std::cos(tolerance));
    const float least = cosine * cosine;
    const Vec2<double> middle = level_lines_.pixel(seed);
    region_.clear();
    add(seed, middle);
    sum_ = level_lines_.direction(seed);
    for (std::size_t i = 0; i < region_.size(); ++i) {
      for (const int place : level_lines_.around(region_[i].place)) {
        if (taken_[index(place)]) continue;
        const Vec2<float>& direction = level_lines_.direction(place);
        const float dot = sum_.dot(direction);
        if (dot <= 0 || dot * dot < least * sum_.squaredNorm()) continue;
        add(place, middle);
        sum_ += direction;
      }
    }
  }

  void add(int place, const Vec2<double>& middle) {
    taken_[index(place)] = 1;
    region_.push_back({place, level_lines_.slope(place), level_lines_.pixel(place) - middle});
  }

  // The rectangle along the principal axis of the region, weighted by slope.
  [[nodiscard]] Rectangle enclose() const {
    double weight = 0, x = 0, y = 0, xx = 0, xy = 0, yy = 0;
    for (const Member& m : region_) {
      const double wx = m.slope * m.off.x(), wy = m.slope * m.off.y();
      weight += m.slope;
      x += wx;
      y += wy;
      xx += wx * m.off.x();
      xy += wx * m.off.y();
      yy += wy * m.off.y();
    }
    Rectangle rectangle;
    rectangle.centre = Vec2<double>(x, y) / weight;
    rectangle.along = principal_axis(xx - x * x / weight, xy - x * y / weight, yy - y * y / weight,
                                     Vec2<double>(sum_.cast<double>()));
    double low = 0, high = 0;
    for (const Member& m : region_) {
      const Vec2<double> off = m.off - rectangle.centre;
      const double along = rectangle.along.dot(off);
      const double across = cross(rectangle.along, off);
      rectangle.begin = std::min(rectangle.begin, along);
      rectangle.end = std::max(rectangle.end, along);
      low = std::min(low, across);
      high = std::max(high, across);
    }
    rectangle.width = std::max(1.0, high - low);
    return rectangle;
  }

  [[nodiscard]] double density(const Rectangle& r) const noexcept {
    return static_cast<double>(region_.size()) / ((r.end - r.begin) * r.width);
  }

  // Too much has joined: once more from the same seed with the tolerance that its surroundings show, and if
  // that is not enough, only what lies near the seed. False where nothing straight is left.
  [[nodiscard]] bool thin_out(double tolerance, Rectangle& rectangle) {
    const double spread = spread_around_seed(rectangle.width);
    for (const Member& m : region_) taken_[index(m.place)] = 0;
    grow(region_.front().place, std::min(tolerance, 2 * spread));
    if (region_.size() < 2) return false;
    rectangle = enclose();
    double reach = std::max(rectangle.start().squaredNorm(), rectangle.stop().squaredNorm());
    while (density(rectangle) < options.min_density) {
      reach *= 0.75 * 0.75;
      std::erase_if(region_, [&](const Member& m) {
        const bool far = m.off.squaredNorm() > reach;
        if (far) taken_[index(m.place)] = 0;
        return far;
      });
      if (region_.size() < 2) return false;
      rectangle = enclose();
    }
    return true;
  }

  // Standard deviation, radians, of the level lines of the region within `reach` pixels of the seed.
  [[nodiscard]] double spread_around_seed(double reach) const {
    const Vec2<float>& direction = level_lines_.direction(region_.front().place);
    double sum = 0, squares = 0;
    int count = 0;
    for (const Member& m : region_) {
      if (m.off.squaredNorm() >= reach * reach) continue;
      const Vec2<float>& other = level_lines_.direction(m.place);
      const double turn = std::atan2(cross(direction, other), direction.dot(other));
      sum += turn;
      squares += turn * turn;
      ++count;
    }
    const double mean = sum / count;
    return std::sqrt(std::max(0.0, squares / count - mean * mean));
  }

  LevelLines level_lines_;
  std::vector<std::uint8_t> taken_;
  std::vector<Member> region_;             // the seed first
  Vec2<float> sum_ = Vec2<float>::Zero();  // of the region's directions
};

}  // namespace sslam
