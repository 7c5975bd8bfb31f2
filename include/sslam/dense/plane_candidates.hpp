// SPDX-License-Identifier: BSD-3-Clause
// Planes that a map's points and lines may lie on: across the Manhattan axes where their offsets crowd, and
// in any direction where many lie on one plane.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "sslam/core/random.hpp"
#include "sslam/dense/dense_view.hpp"
#include "sslam/dense/map_samples.hpp"
#include "sslam/dense/plane_fit.hpp"
#include "sslam/geometry/squareness.hpp"
#include "sslam/map/plane_extent.hpp"
#include "sslam/solver/modes/offset_modes.hpp"

namespace sslam::dense {

// Lengths are parts of the median scene depth.
struct CandidateOptions {
  double tolerance = 0.008;           // of a sample from its plane, either way
  std::size_t min_samples = 8;        // of a plane across an axis
  double min_contrast = 2.5;          // of its samples over what their surroundings make expect
  std::size_t min_free_samples = 24;  // of a plane in any direction
  double min_spread = 0.05;  // standard deviation of the samples in the plane, where they spread least
  double axis_tilt = kWallTilt<double>;  // standard deviation of a wall against its axis
  double max_tilt = radians(3.0);        // of a line against the plane that it lies on
  std::size_t most = 60;                 // planes
  int tries = 400;                       // for each plane in any direction
  double near = 0.5;                     // how far apart three samples are that make one
};

struct PlaneCandidate {
  PlaneFit fit;
  std::int8_t axis = kNone;  // number of the Manhattan axis that it is normal to, or kNone
  std::size_t samples = 0;   // that lie on it
  BoundedPlane bounded;      // the plane, and the rectangle that all but a few of them cover
};

class CandidateFinder {
 public:
  CandidateFinder(const Map<double>& map, double median_depth, const CandidateOptions& options)
      : map_(map), depth_(median_depth), options_(options), samples_(sample_map(map, 0.08 * median_depth)) {}

  // The strongest first. The same map gives the same planes.
  [[nodiscard]] std::vector<PlaneCandidate> find() {
    free_.assign(samples_.size(), true);
    for (std::size_t f = 0; f < map_.world_from_manhattan.size(); ++f)
      for (int a = 0; a < 3; ++a)
        if (const auto axis = static_cast<std::int8_t>(3 * f + static_cast<std::size_t>(a));
            stands_for_itself(map_.world_from_manhattan, axis))
          find_across(axis);
    find_free();
    std::stable_sort(found_.begin(), found_.end(),
                     [](const auto& a, const auto& b) { return a.samples > b.samples; });
    drop_doubles();
    if (found_.size() > options_.most) found_.resize(options_.most);
    return found_;
  }

 private:
  struct Entry {
    double offset;
    std::size_t sample;
  };

  void find_across(std::int8_t axis) {
    const Vec3<double> normal = map_.axis(axis);
    std::vector<Entry> entries;
    for (std::size_t i = 0; i < samples_.size(); ++i)
      if (along(samples_[i], normal) && sigma_along(map_, samples_[i], normal) < 2 * tolerance())
        entries.push_back({normal.dot(samples_[i].place), i});
    std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
      return a.offset != b.offset ? a.offset < b.offset : a.sample < b.sample;
    });
    std::vector<double> offsets;
    for (;;) {
      offsets.clear();
      for (const Entry& e : entries) offsets.push_back(e.offset);
      const OffsetMode<double> mode = offset_mode<double>(offsets, 2 * tolerance());
      if (mode.size() < options_.min_samples) return;
      const bool stands_out = mode.contrast >= options_.min_contrast;
      std::vector<std::size_t> members;
      for (std::size_t i = mode.first; i < mode.last; ++i) members.push_back(entries[i].sample);
      if (stands_out) add({normal, offsets[(mode.first + mode.last) / 2]}, axis, members, options_.axis_tilt);
      entries.erase(entries.begin() + static_cast<std::ptrdiff_t>(mode.first),
                    entries.begin() + static_cast<std::ptrdiff_t>(mode.last));
    }
  }

  // Three samples near one another, of those that no strong plane across an axis explains.
  void find_free() {
    for (const PlaneCandidate& candidate : found_)
      if (candidate.samples >= options_.min_free_samples) take(candidate.fit.plane);
    Random random(7);
    for (;;) {
      std::vector<std::size_t> open;
      for (std::size_t i = 0; i < samples_.size(); ++i)
        if (free_[i] && samples_[i].sigma < 3 * tolerance()) open.push_back(i);
      if (open.size() < options_.min_free_samples) return;
      std::vector<std::size_t> best;
      Plane3<double> best_plane;
      for (int t = 0; t < options_.tries; ++t) {
        Plane3<double> plane;
        if (!draw(open, random, plane)) continue;
        std::vector<std::size_t> members = members_of(plane, open);
        if (members.size() > best.size()) {
          best = std::move(members);
          best_plane = plane;
        }
      }
      if (best.size() < options_.min_free_samples) return;
      add(best_plane, kNone, best, std::numeric_limits<double>::infinity());
      for (const std::size_t i : best) free_[i] = false;
    }
  }

  [[nodiscard]] bool draw(const std::vector<std::size_t>& open, Random& random, Plane3<double>& plane) const {
    const auto pick = [&] { return open[random.below(static_cast<std::uint32_t>(open.size()))]; };
    const Vec3<double> a = samples_[pick()].place;
    std::array<Vec3<double>, 2> others;
    for (Vec3<double>& other : others) {
      int left = 30;
      do other = samples_[pick()].place;
      while ((other - a).norm() > options_.near * depth_ && --left > 0);
    }
    const Vec3<double> n = (others[0] - a).cross(others[1] - a);
    if (!(n.norm() > 0.01 * depth_ * depth_)) return false;
    plane = {n.normalized(), n.normalized().dot(a)};
    return true;
  }

  [[nodiscard]] std::vector<std::size_t> members_of(const Plane3<double>& plane,
                                                    const std::vector<std::size_t>& among) const {
    std::vector<std::size_t> members;
    for (const std::size_t i : among)
      if (std::abs(plane.offset(samples_[i].place)) < tolerance() && along(samples_[i], plane.normal))
        members.push_back(i);
    return members;
  }

  // Whether the sample's line, if it is of one, may lie in a plane with this normal.
  [[nodiscard]] bool along(const MapSample& sample, const Vec3<double>& normal) const {
    return std::abs(sample.direction.dot(normal)) < std::sin(options_.max_tilt);
  }

  void take(const Plane3<double>& plane) {
    for (std::size_t i = 0; i < samples_.size(); ++i)
      if (std::abs(plane.offset(samples_[i].place)) < tolerance() && along(samples_[i], plane.normal))
        free_[i] = false;
  }

  void add(const Plane3<double>& start, std::int8_t axis, const std::vector<std::size_t>& members,
           double tilt) {
    std::vector<PlaneSample> samples;
    samples.reserve(members.size());
    for (const std::size_t i : members)
      samples.push_back(
          {samples_[i].place, std::max(sigma_along(map_, samples_[i], start.normal), 0.2 * tolerance())});
    PlaneCandidate candidate;
    candidate.fit = fit_plane(samples, start, tilt);
    candidate.axis = axis;
    candidate.samples = members.size();
    PlaneExtent<double> extent(candidate.fit.plane.normal);
    for (const std::size_t i : members) extent.add(samples_[i].place);
    candidate.bounded.plane = candidate.fit.plane;
    candidate.bounded.basis = plane_basis(map_, candidate.fit.plane.normal);
    bound(members, candidate.bounded);
    if (candidate.fit.determined && extent.least_spread() > options_.min_spread * depth_)
      found_.push_back(candidate);
  }

  // Without the outermost fiftieth to either side, which may be on the plane by chance.
  void bound(const std::vector<std::size_t>& members, BoundedPlane& bounded) const {
    std::vector<double> along;
    for (int k = 0; k < 2; ++k) {
      along.clear();
      for (const std::size_t i : members) along.push_back(bounded.basis.col(k).dot(samples_[i].place));
      std::sort(along.begin(), along.end());
      bounded.low[k] = along[along.size() / 50];
      bounded.high[k] = along[along.size() - 1 - along.size() / 50];
    }
  }

  // Of two that all but coincide where the weaker one has its samples, the stronger one stays.
  void drop_doubles() {
    std::vector<PlaneCandidate> kept;
    for (const PlaneCandidate& candidate : found_) {
      const BoundedPlane& plane = candidate.bounded;
      const auto same = [&](const PlaneCandidate& other) {
        const Plane3<double>& stronger = other.fit.plane;
        if (std::abs(stronger.normal.dot(plane.plane.normal)) < std::cos(options_.max_tilt)) return false;
        for (const Vec2<double>& corner : {plane.low, plane.high})
          if (std::abs(stronger.offset(plane.place(corner))) > 1.5 * tolerance()) return false;
        return true;
      };
      if (std::none_of(kept.begin(), kept.end(), same)) kept.push_back(candidate);
    }
    found_ = std::move(kept);
  }

  [[nodiscard]] double tolerance() const { return options_.tolerance * depth_; }

  const Map<double>& map_;
  double depth_;
  CandidateOptions options_;
  std::vector<MapSample> samples_;
  std::vector<bool> free_;  // by sample: no plane explains it yet
  std::vector<PlaneCandidate> found_;
};

}  // namespace sslam::dense
