// SPDX-License-Identifier: BSD-3-Clause
// One pose in one row of numbers, in the layouts that programs write; camera to world.
#pragma once

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sslam/geometry/se3.hpp"
#include "sslam/io/files/text.hpp"

namespace sslam::io {

enum class RowLayout {
  kTum,            // stamp tx ty tz qx qy qz qw
  kWFirst,         // stamp tx ty tz qw qx qy qz, and more: the tables of EuRoC
  kMatrix,         // the upper three rows of a 4x4 matrix, or all four, without a stamp: KITTI
  kStampedMatrix,  // the same behind a stamp
  kUnstamped,      // tx ty tz qx qy qz qw: TartanAir, the vertices of g2o
  kAxisAngle,      // stamp rx ry rz tx ty tz, world to camera, turned by |r| radians about r: ARKitScenes
};

[[nodiscard]] constexpr bool has_stamp(RowLayout layout) noexcept {
  return layout != RowLayout::kMatrix && layout != RowLayout::kUnstamped;
}

inline constexpr std::string_view kPoseRows =
    "'stamp tx ty tz qx qy qz qw' (TUM), a table of EuRoC (8 or 17 columns), 'tx ty tz qx qy qz qw', "
    "or a 3x4 or 4x4 matrix a row";

// What programs write where they have no number.
[[nodiscard]] inline bool says_nothing(std::string_view cell) {
  constexpr std::array<std::string_view, 8> kWords{"none", "null",    "na",      "n/a",
                                                   "lost", "1.#qnan", "-1.#ind", "1.#inf"};
  std::string lower(cell);
  for (char& c : lower) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  if (lower.starts_with("nan") || lower.starts_with("-nan")) return true;  // and such as -nan(ind)
  return std::find(kWords.begin(), kWords.end(), lower) != kWords.end();
}

// The number, not a number where the cell says so in a word, nothing where it is something else.
[[nodiscard]] inline std::optional<double> parse_cell(std::string_view cell) {
  if (says_nothing(cell)) return std::numeric_limits<double>::quiet_NaN();
  return parse_number<double>(cell);
}

// Whether the numbers of a pose mean that there is none: not finite, or all zero.
[[nodiscard]] inline bool means_no_pose(std::span<const double> pose) noexcept {
  const auto finite = [](double value) { return std::isfinite(value); };
  const auto zero = [](double value) { return value == 0; };
  return !std::all_of(pose.begin(), pose.end(), finite) || std::all_of(pose.begin(), pose.end(), zero);
}

[[nodiscard]] inline std::string no_pose_note(const std::filesystem::path& source, std::size_t count,
                                              std::size_t total) {
  return source.string() + ": " + std::to_string(count) + " of " + std::to_string(total) +
         " poses mean 'no pose here' (not finite, or all zero): left out";
}

// q: x, y, z, w. Nothing, with the reason in `why`, when it is far from unit length; published ones are
// rounded.
[[nodiscard]] inline std::optional<SE3<double>> pose_of(const Vec3<double>& position,
                                                        const std::array<double, 4>& q, std::string& why) {
  constexpr double kTolerance = 0.1;
  const double norm = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  if (std::abs(norm - 1) > kTolerance) {
    why = "the quaternion's length is " + std::to_string(norm) + ", expected 1";
    return std::nullopt;
  }
  SE3<double> pose;
  pose.translation = position;
  pose.rotation = SO3<double>::from_quaternion(q[3] / norm, q[0] / norm, q[1] / norm, q[2] / norm);
  return pose;
}

// v: 12 or 16 numbers, row by row.
[[nodiscard]] inline std::optional<SE3<double>> pose_of_matrix(std::span<const double> v, std::string& why) {
  constexpr double kTolerance = 0.05;
  Mat3<double> rotation;
  rotation << v[0], v[1], v[2], v[4], v[5], v[6], v[8], v[9], v[10];
  const double deviation = (rotation * rotation.transpose() - Mat3<double>::Identity()).cwiseAbs().maxCoeff();
  const bool last_row = v.size() < 16 || (v[12] == 0 && v[13] == 0 && v[14] == 0 && v[15] == 1);
  if (!(deviation < kTolerance) || rotation.determinant() < 0) {
    why = "its upper left 3x3 part is not a rotation";
  } else if (!last_row) {
    why = "its last row is not 0 0 0 1";
  } else {
    SE3<double> pose;
    pose.rotation = SO3<double>::from_matrix(rotation);
    pose.translation = Vec3<double>(v[3], v[7], v[11]);
    return pose;
  }
  return std::nullopt;
}

struct PoseRow {
  std::optional<double> stamp;  // none in the layouts without
  std::optional<SE3<double>> pose;
  bool no_pose = false;  // the row means that there is none
};

// Nothing, with the reason in `why`, for a row that cannot be read. `width`: the cells of the file's rows.
[[nodiscard]] inline std::optional<PoseRow> parse_pose_row(const TextRow& row, RowLayout layout,
                                                           std::size_t width, std::string& why) {
  PoseRow result;
  const bool stamped = has_stamp(layout);
  const std::size_t from = stamped ? 1 : 0;
  if (stamped) {
    result.stamp = parse_number<double>(row.cells[0]);
    if (!result.stamp || !std::isfinite(*result.stamp)) {
      why = "the stamp '" + std::string(row.cells[0]) + "' is not a finite number";
      return std::nullopt;
    }
    // Some programs leave the rest of the row out, or say in a word that they are lost.
    result.no_pose = row.cells.size() == 1 || (row.cells.size() == 2 && says_nothing(row.cells[1]));
    if (result.no_pose) return result;
  }
  if (row.cells.size() != width) {
    why = "expected " + std::to_string(width) + " numbers, found " + std::to_string(row.cells.size());
    return std::nullopt;
  }
  const bool matrix = layout == RowLayout::kMatrix || layout == RowLayout::kStampedMatrix;
  std::vector<double> v;
  const bool turn = layout == RowLayout::kAxisAngle;
  for (std::size_t i = from; i < (matrix || turn ? width : from + 7); ++i) {
    const std::optional<double> number = parse_cell(row.cells[i]);
    if (!number) {
      why = "'" + std::string(row.cells[i]) + "' is not a number";
      return std::nullopt;
    }
    v.push_back(*number);
  }
  result.no_pose = means_no_pose(v) || (!matrix && !turn && means_no_pose(std::span(v).last(4)));
  if (result.no_pose) return result;
  if (matrix) {
    result.pose = pose_of_matrix(v, why);
  } else if (turn) {
    const SE3<double> cam_from_world{SO3<double>::exp({v[0], v[1], v[2]}), {v[3], v[4], v[5]}};
    result.pose = cam_from_world.inverse();
  } else {
    const bool w_first = layout == RowLayout::kWFirst;
    const std::array<double, 4> q =
        w_first ? std::array{v[4], v[5], v[6], v[3]} : std::array{v[3], v[4], v[5], v[6]};
    result.pose = pose_of({v[0], v[1], v[2]}, q, why);
  }
  if (!result.pose) return std::nullopt;
  return result;
}

}  // namespace sslam::io
