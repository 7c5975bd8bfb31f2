// SPDX-License-Identifier: BSD-3-Clause
// Trajectories in the TUM format, one pose a row: `stamp tx ty tz qx qy qz qw`, camera to world.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <optional>
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

// The same motion seen in a world and a camera with y turned over: t' = S t, R' = S R S, S = diag(1, -1, 1).
// It takes the y-up poses of ICL-NUIM to our y-down axes, and back. In the quaternion x and z change sign,
// since the axis of a rotation is a pseudovector.
[[nodiscard]] inline SE3<double> mirror_y(const SE3<double>& pose) {
  const auto q = pose.rotation.quaternion();
  SE3<double> mirrored;
  mirrored.rotation = SO3<double>::from_quaternion(q.w(), -q.x(), q.y(), -q.z());
  mirrored.translation = Vec3<double>(pose.translation.x(), -pose.translation.y(), pose.translation.z());
  return mirrored;
}

inline void mirror_y(Trajectory& trajectory) {
  for (StampedPose& pose : trajectory) pose.world_from_cam = mirror_y(pose.world_from_cam);
}

// One row, or nothing with the reason in `why`.
[[nodiscard]] inline std::optional<StampedPose> parse_pose(const TextRow& row, std::string& why) {
  if (row.cells.size() != 8) {
    why = "expected 8 numbers 'stamp tx ty tz qx qy qz qw', found " + std::to_string(row.cells.size());
    return std::nullopt;
  }
  double v[8];
  for (std::size_t i = 0; i < 8; ++i) {
    const std::optional<double> number = parse_number<double>(row.cells[i]);
    if (!number || !std::isfinite(*number)) {
      why = "'" + std::string(row.cells[i]) + "' is not a finite number";
      return std::nullopt;
    }
    v[i] = *number;
  }
  // Published quaternions are rounded; one far from unit length is something else.
  constexpr double kTolerance = 0.1;
  const double norm = std::sqrt(v[4] * v[4] + v[5] * v[5] + v[6] * v[6] + v[7] * v[7]);
  if (std::abs(norm - 1) > kTolerance) {
    why = "the quaternion's length is " + std::to_string(norm) + ", expected 1";
    return std::nullopt;
  }
  StampedPose pose;
  pose.stamp = v[0];
  pose.world_from_cam.translation = Vec3<double>(v[1], v[2], v[3]);
  pose.world_from_cam.rotation =
      SO3<double>::from_quaternion(v[7] / norm, v[4] / norm, v[5] / norm, v[6] / norm);
  return pose;
}

// Sorts by stamp and keeps the first of each run of equal stamps; says so when there was anything to do.
inline void order_by_stamp(Trajectory& trajectory, const std::filesystem::path& source, Warnings& warnings) {
  const auto earlier = [](const StampedPose& a, const StampedPose& b) { return a.stamp < b.stamp; };
  const auto out_of_order = std::is_sorted_until(trajectory.begin(), trajectory.end(), earlier);
  if (out_of_order != trajectory.end()) {
    warnings.push_back(source.string() + ": stamps go backwards at " + exact_decimal(out_of_order->stamp) +
                       ": poses sorted by stamp");
    std::stable_sort(trajectory.begin(), trajectory.end(), earlier);
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

// Poses in increasing order of stamp. Throws Error when the file cannot be read or holds no trajectory; adds
// to warnings what was skipped.
[[nodiscard]] inline Trajectory read_trajectory(const std::filesystem::path& path, Warnings& warnings) {
  const std::string text = read_text(path);
  const std::vector<TextRow> rows = split_rows(text);
  if (rows.empty())
    throw Error(path.string() + ": holds no pose; expected rows of 'stamp tx ty tz qx qy qz qw'");
  Trajectory trajectory;
  trajectory.reserve(rows.size());
  BadEntries bad(path);
  std::string why;
  for (const TextRow& row : rows) {
    if (const auto pose = parse_pose(row, why)) {
      trajectory.push_back(*pose);
    } else {
      bad.add(row.line, why);
    }
  }
  bad.settle(rows.size(), warnings);
  order_by_stamp(trajectory, path, warnings);
  return trajectory;
}

// Stamps as exact_decimal gives them, the rest with nine decimals. Throws Error when it cannot be written.
inline void write_trajectory(const std::filesystem::path& path, std::span<const StampedPose> trajectory) {
  OutputFile file(path);
  file.stream() << "# stamp tx ty tz qx qy qz qw (camera to world)\n";
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
