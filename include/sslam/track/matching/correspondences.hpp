// SPDX-License-Identifier: BSD-3-Clause
// The matches of a frame laid out for the pose solvers, and the way back: which of them turned out wrong.
#pragma once

#include <algorithm>
#include <vector>

#include "sslam/core/median.hpp"
#include "sslam/map/map.hpp"
#include "sslam/solver/pose/pose_refinement.hpp"
#include "sslam/track/contract/tracked_frame.hpp"

namespace sslam {

template <Scalar S>
struct Correspondences {
  std::vector<PointObservation<S>> points;
  std::vector<LineObservation<S>> lines;
  std::vector<std::int32_t> point_features;  // feature index of each observation
  std::vector<std::int32_t> line_features;
  std::vector<Vec3<S>> line_midpoints;      // world, of the part that has been seen
  std::vector<std::uint8_t> point_inliers;  // written by the solver
  std::vector<std::uint8_t> line_inliers;

  void gather(const Map<S>& map, const TrackedFrame<S>& frame) {
    points.clear();
    lines.clear();
    point_features.clear();
    line_features.clear();
    line_midpoints.clear();
    for (std::size_t i = 0; i < frame.point_landmarks.size(); ++i) {
      if (frame.point_landmarks[i] == kNone) continue;
      const PointFeature<S>& feature = frame.frame.points[i];
      points.push_back(
          {map.points[map.index(frame.point_landmarks[i])].position, feature.pixel, feature.sigma});
      point_features.push_back(static_cast<std::int32_t>(i));
    }
    for (std::size_t i = 0; i < frame.line_landmarks.size(); ++i) {
      if (frame.line_landmarks[i] == kNone) continue;
      const LineFeature<S>& feature = frame.frame.lines[i];
      const LineLandmark<S>& landmark = map.lines[map.index(frame.line_landmarks[i])];
      lines.push_back({landmark.line, feature.segment, feature.sigma});
      line_midpoints.push_back((landmark.start + landmark.end) / 2);
      line_features.push_back(static_cast<std::int32_t>(i));
    }
    point_inliers.assign(points.size(), 1);
    line_inliers.assign(lines.size(), 1);
  }

  [[nodiscard]] std::size_t size() const noexcept { return points.size() + lines.size(); }
  [[nodiscard]] int point_inlier_count() const { return count(point_inliers); }
  [[nodiscard]] int line_inlier_count() const { return count(line_inliers); }

  // Takes the outliers' matches away from the frame.
  void drop_outliers(TrackedFrame<S>& frame) const {
    for (std::size_t i = 0; i < points.size(); ++i)
      if (!point_inliers[i]) frame.point_landmarks[static_cast<std::size_t>(point_features[i])] = kNone;
    for (std::size_t i = 0; i < lines.size(); ++i)
      if (!line_inliers[i]) frame.line_landmarks[static_cast<std::size_t>(line_features[i])] = kNone;
  }

  // Median depth of the point and line inliers in the camera, 1 when there are none.
  [[nodiscard]] S median_depth(const SE3<S>& cam_from_world) {
    depths_.clear();
    for (std::size_t i = 0; i < points.size(); ++i)
      if (point_inliers[i]) depths_.push_back((cam_from_world * points[i].point_world).z());
    for (std::size_t i = 0; i < lines.size(); ++i)
      if (line_inliers[i]) depths_.push_back((cam_from_world * line_midpoints[i]).z());
    return depths_.empty() ? S(1) : median<S>(depths_);
  }

 private:
  static int count(const std::vector<std::uint8_t>& flags) {
    return static_cast<int>(std::count(flags.begin(), flags.end(), std::uint8_t{1}));
  }
  std::vector<S> depths_;
};

}  // namespace sslam
