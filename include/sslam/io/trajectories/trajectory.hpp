// SPDX-License-Identifier: BSD-3-Clause
// Trajectories: poses with stamps, put in order, and written in the TUM format, one pose a row:
// `stamp tx ty tz qx qy qz qw`, camera to world.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "sslam/geometry/se3.hpp"
#include "sslam/io/files/bad_entries.hpp"
#include "sslam/io/files/output_file.hpp"
#include "sslam/io/files/text.hpp"

namespace sslam::io {

struct StampedPose {
  double stamp = 0;  // seconds, or the dataset's own unit
  SE3<double> world_from_cam;
};

using Trajectory = std::vector<StampedPose>;

// What a file of poses holds.
struct PoseFile {
  Trajectory trajectory;    // by increasing stamp, in seconds
  bool counted = false;     // its rows have no stamps and no times: the stamps are their numbers, from 0
  std::size_t no_pose = 0;  // rows that mean "no pose here", left out
};

[[nodiscard]] inline std::vector<double> stamps_of(const Trajectory& trajectory) {
  std::vector<double> stamps;
  stamps.reserve(trajectory.size());
  for (const StampedPose& pose : trajectory) stamps.push_back(pose.stamp);
  return stamps;
}

// A stamp a row. Throws Error when it cannot be written.
inline void write_stamps(const std::filesystem::path& path, std::span<const double> stamps) {
  OutputFile file(path);
  for (const double stamp : stamps) file.stream() << exact_decimal(stamp) << '\n';
  file.commit();
}

[[nodiscard]] inline std::vector<Vec3<double>> positions_of(const Trajectory& trajectory) {
  std::vector<Vec3<double>> positions;
  positions.reserve(trajectory.size());
  for (const StampedPose& pose : trajectory) positions.push_back(pose.world_from_cam.translation);
  return positions;
}

// The same motion seen in a world and a camera with one axis (0: x) turned over: t' = S t, R' = S R S, where
// S is the identity but for -1 at this axis. In the quaternion the other two change sign, since the axis of a
// rotation is a pseudovector.
[[nodiscard]] inline SE3<double> mirrored(const SE3<double>& pose, int axis) {
  const auto q = pose.rotation.quaternion();
  Vec3<double> turn(-q.x(), -q.y(), -q.z());
  turn[axis] *= -1;
  SE3<double> other;
  other.rotation = SO3<double>::from_quaternion(q.w(), turn[0], turn[1], turn[2]);
  other.translation = pose.translation;
  other.translation[axis] *= -1;
  return other;
}

// Takes the y-up poses of ICL-NUIM to our y-down axes, and back.
[[nodiscard]] inline SE3<double> mirror_y(const SE3<double>& pose) {
  return mirrored(pose, 1);
}

inline void mirror_y(Trajectory& trajectory) {
  for (StampedPose& pose : trajectory) pose.world_from_cam = mirror_y(pose.world_from_cam);
}

[[nodiscard]] inline bool is_earlier(const StampedPose& a, const StampedPose& b) noexcept {
  return a.stamp < b.stamp;
}

// Of equal stamps, in the order in which they came.
inline void sort_by_stamp(Trajectory& trajectory) {
  std::stable_sort(trajectory.begin(), trajectory.end(), is_earlier);
}

// Sorts by stamp and keeps the first of each run of equal stamps; says so when there was anything to do.
inline void order_by_stamp(Trajectory& trajectory, const std::filesystem::path& source, Warnings& warnings) {
  const auto out_of_order = std::is_sorted_until(trajectory.begin(), trajectory.end(), is_earlier);
  if (out_of_order != trajectory.end()) {
    warnings.push_back(source.string() + ": stamps go backwards at " + exact_decimal(out_of_order->stamp) +
                       ": poses sorted by stamp");
    sort_by_stamp(trajectory);
  }
  const auto same = [](const StampedPose& a, const StampedPose& b) { return a.stamp == b.stamp; };
  const std::size_t before = trajectory.size();
  const auto repeated = std::adjacent_find(trajectory.begin(), trajectory.end(), same);
  if (repeated == trajectory.end()) return;
  const double stamp = repeated->stamp;
  trajectory.erase(std::unique(trajectory.begin(), trajectory.end(), same), trajectory.end());
  warnings.push_back(source.string() + ": " + std::to_string(before - trajectory.size()) +
                     " repeated stamps, the first at " + exact_decimal(stamp) +
                     ": the first pose of each is kept");
}

// Stamps as exact_decimal gives them, the rest with nine decimals. `comment`: a line more for the head of the
// file; empty: none. Throws Error when it cannot be written.
inline void write_trajectory(const std::filesystem::path& path, std::span<const StampedPose> trajectory,
                             const std::string& comment = {}) {
  OutputFile file(path);
  file.stream() << "# stamp tx ty tz qx qy qz qw (camera to world)\n";
  if (!comment.empty()) file.stream() << "# " << comment << '\n';
  char numbers[256];
  for (const StampedPose& pose : trajectory) {
    const auto q = pose.world_from_cam.rotation.quaternion();
    const Vec3<double>& t = pose.world_from_cam.translation;
    std::snprintf(numbers, sizeof numbers, " %.9f %.9f %.9f %.9f %.9f %.9f %.9f\n", t.x(), t.y(), t.z(),
                  q.x(), q.y(), q.z(), q.w());
    file.stream() << exact_decimal(pose.stamp) << numbers;
  }
  file.commit();
}

}  // namespace sslam::io
