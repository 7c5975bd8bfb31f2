// SPDX-License-Identifier: BSD-3-Clause
// Trajectories as programs write them, told by their rows: TUM, EuRoC, KITTI with its times, 4x4 matrices,
// also with the heads of Open3D, the vertices of g2o, the .traj files of ARKitScenes.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sslam/core/file_kind.hpp"
#include "sslam/io/files/bad_entries.hpp"
#include "sslam/io/files/dated_rows.hpp"
#include "sslam/io/files/decimal_commas.hpp"
#include "sslam/io/files/files.hpp"
#include "sslam/io/files/plain_text.hpp"
#include "sslam/io/files/stamp_unit.hpp"
#include "sslam/io/files/text.hpp"
#include "sslam/io/trajectories/pose_columns.hpp"
#include "sslam/io/trajectories/pose_groups.hpp"
#include "sslam/io/trajectories/pose_row.hpp"
#include "sslam/io/trajectories/pose_times.hpp"
#include "sslam/io/trajectories/trajectory.hpp"
#include "sslam/io/trajectories/transforms.hpp"

namespace sslam::io {

namespace trajectory_detail {

// Whether w stands before x where a head of the file names the quaternion's parts; nothing where none does.
[[nodiscard]] inline std::optional<bool> names_w_first(std::string_view head) {
  const std::string names = lower_case(std::string(head));
  for (const auto& [w, x] :
       {std::pair{"qw", "qx"}, {"q_w", "q_x"}, {"q_rs_w", "q_rs_x"}, {"tion.w", "tion.x"}})
    if (const auto at = names.find(w); at != std::string::npos) return at < names.find(x);
  return std::nullopt;
}

// Whether the last four of seven numbers are a quaternion, or mean that there is no pose.
[[nodiscard]] inline bool ends_as_quaternion(const TextRow& row) {
  std::array<double, 4> q{};
  for (std::size_t i = 0; i < 4; ++i) q[i] = parse_cell(row.cells[3 + i]).value_or(2);
  std::string ignored;
  return means_no_pose(q) || pose_of(Vec3<double>::Zero(), q, ignored);
}

// The number of cells that most rows have, among those of a layout if there are any.
[[nodiscard]] inline std::size_t usual_width(const std::vector<TextRow>& rows) {
  constexpr std::array<std::size_t, 6> kKnown{8, 12, 13, 16, 17, 7};
  std::size_t width = rows.front().cells.size(), most = 0;
  for (const std::size_t known : kKnown) {
    const auto count = static_cast<std::size_t>(std::count_if(
        rows.begin(), rows.end(), [known](const TextRow& row) { return row.cells.size() == known; }));
    if (count > most) {
      most = count;
      width = known;
    }
  }
  return width;
}

// Rows of Python: [0.1, 1, 2, 3] or (0.1, 1, 2, 3).
inline void blank_brackets(std::string& text) {
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    const std::size_t first = text.find_first_not_of(" \t", at);
    if (first < end && (text[first] == '[' || text[first] == '('))
      for (std::size_t i = first; i < end; ++i)
        if (std::string_view("[]()").find(text[i]) != std::string_view::npos) text[i] = ' ';
    at = end + 1;
  }
}

// What stands behind the numbers of a row: "# such a remark".
inline void drop_remarks(std::vector<TextRow>& rows) {
  for (TextRow& row : rows) {
    const auto remark = std::find_if(row.cells.begin(), row.cells.end(),
                                     [](std::string_view cell) { return cell.starts_with('#'); });
    row.cells.erase(remark, row.cells.end());
  }
}

// The tables of EuRoC count nanoseconds and separate by commas.
[[nodiscard]] inline bool looks_like_euroc(const TextRow& row) {
  constexpr double kNanosecondsToday = 1e17;
  return row.text.find(',') != std::string_view::npos &&
         parse_number<double>(row.cells.front()).value_or(0) > kNanosecondsToday;
}

[[nodiscard]] inline bool ends_as_matrix(const TextRow& row) {
  const auto& c = row.cells;
  return c.size() == 17 && parse_number<double>(c[13]) == 0.0 && parse_number<double>(c[14]) == 0.0 &&
         parse_number<double>(c[15]) == 0.0 && parse_number<double>(c[16]) == 1.0;
}

// `head`: what stands above the first row. Throws Error for rows of no known layout.
[[nodiscard]] inline RowLayout layout_of(const std::vector<TextRow>& rows, std::size_t width,
                                         std::string_view head, const std::filesystem::path& path,
                                         Warnings& warnings) {
  if (pose_columns_detail::name_euler_angles(head))
    throw Error(path.string() +
                ": has rotations as roll, pitch and yaw, in an order that nothing tells; expected "
                "quaternions, in rows of " +
                std::string(kPoseRows));
  if (width == 12 || width == 16) return RowLayout::kMatrix;
  if (width == 7 && path.extension() == ".traj") return RowLayout::kAxisAngle;
  if (width == 13 || std::any_of(rows.begin(), rows.end(), ends_as_matrix)) return RowLayout::kStampedMatrix;
  if (width == 7 && std::all_of(rows.begin(), rows.end(), [](const TextRow& row) {
        return row.cells.size() != 7 || ends_as_quaternion(row);
      }))
    return RowLayout::kUnstamped;
  const std::optional<bool> named = names_w_first(head);
  if (width != 8 && width != 17)
    throw Error(path.string() + ": line " + std::to_string(rows.front().line) + ": has " +
                std::to_string(width) + " columns; expected rows of " + std::string(kPoseRows));
  if (named) return *named ? RowLayout::kWFirst : RowLayout::kTum;
  if (width == 8 && !looks_like_euroc(rows.front())) return RowLayout::kTum;
  warnings.push_back(path.string() +
                     ": nothing names its columns; read as EuRoC's, the quaternion's w first");
  return RowLayout::kWFirst;
}

}  // namespace trajectory_detail

// transforms.json: without timestamps its files in their natural order have the times, or are counted.
[[nodiscard]] inline PoseFile read_transforms_poses(const std::filesystem::path& path, Warnings& warnings,
                                                    std::filesystem::path times) {
  const Transforms transforms = read_transforms(path, warnings);
  transforms.bad_poses.settle(transforms.frames.size(), warnings);
  PoseFile result;
  result.no_pose = transforms.no_pose;
  std::vector<double> clock;
  if (!transforms.stamped) {
    if (times.empty()) times = trajectory_detail::find_times(path);
    if (!times.empty()) clock = read_times(times, warnings);
    result.counted = clock.empty();
    if (!result.counted && clock.size() != transforms.frames.size())
      throw Error(times.string() + ": has " + std::to_string(clock.size()) + " times for the " +
                  std::to_string(transforms.frames.size()) + " frames of " + path.string() +
                  "; expected one a frame");
  }
  for (std::size_t i = 0; i < transforms.frames.size(); ++i) {
    const TransformsFrame& frame = transforms.frames[i];
    const double place = clock.empty() ? static_cast<double>(i) : clock[i];
    if (frame.world_from_cam)
      result.trajectory.push_back({transforms.stamped ? frame.stamp : place, *frame.world_from_cam});
  }
  if (result.trajectory.empty())
    throw Error(path.string() + ": holds no pose; expected a transform_matrix in its frames");
  if (result.no_pose > 0) warnings.push_back(no_pose_note(path, result.no_pose, transforms.frames.size()));
  const StampUnit unit = stamp_unit_of(stamps_of(result.trajectory), StampsOf::kOther);
  if (!result.counted && !unit.is_seconds()) {
    for (StampedPose& pose : result.trajectory) pose.stamp /= unit.per_second;
    warnings.push_back(path.string() + ": " + unit_note(unit));
  }
  order_by_stamp(result.trajectory, path, warnings);
  return result;
}

// Throws Error when the file cannot be read or holds no trajectory; adds to warnings what was skipped or
// changed. `times`: of a file without stamps; empty: looked for beside it.
[[nodiscard]] inline PoseFile read_pose_file(const std::filesystem::path& path, Warnings& warnings,
                                             std::filesystem::path times = {}) {
  std::string text = read_plain_text(path);
  if (const std::string kind = file_kind(text); !kind.empty())
    throw Error(path.string() + ": " + kind + "; expected rows of poses in plain text");
  if (is_transforms_text(text)) return read_transforms_poses(path, warnings, std::move(times));
  trajectory_detail::blank_brackets(text);
  text = with_decimal_points(with_seconds(std::move(text), path, warnings));
  std::vector<TextRow> rows = split_rows(text);
  if (!rows.empty() && is_header(rows.front())) rows.erase(rows.begin());
  if (rows.empty())
    throw Error(path.string() + ": holds no pose; expected rows of " + std::string(kPoseRows));
  const std::string_view head(text.data(), static_cast<std::size_t>(rows.front().text.data() - text.data()));
  trajectory_detail::drop_remarks(rows);
  const std::size_t named = order_columns(rows, head);
  std::vector<double> numbers = trajectory_detail::take_log_heads(rows);
  if (numbers.empty()) numbers = trajectory_detail::take_vertices(rows);
  if (rows.empty())
    throw Error(path.string() + ": holds no pose; expected rows of " + std::string(kPoseRows));
  trajectory_detail::refuse_positions(rows, path);
  trajectory_detail::join_matrices(rows);
  const std::size_t width = named > 0 ? named : trajectory_detail::usual_width(rows);
  const RowLayout layout =
      named > 0 ? RowLayout::kTum : trajectory_detail::layout_of(rows, width, head, path, warnings);
  PoseFile result;
  std::vector<double> clock;
  if (!has_stamp(layout)) {
    if (times.empty()) times = trajectory_detail::find_times(path);
    if (!times.empty() && times != kNoTimes) clock = read_times(times, warnings);
    result.counted = clock.empty();
    if (!result.counted && clock.size() != rows.size())
      throw Error(times.string() + ": has " + std::to_string(clock.size()) + " times for the " +
                  std::to_string(rows.size()) + " poses of " + path.string() + "; expected one a pose");
  }
  BadEntries bad(path);
  std::string why;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto row = parse_pose_row(rows[i], layout, width, why);
    if (!row) {
      bad.add(rows[i].line, why);
    } else if (row->no_pose) {
      ++result.no_pose;
    } else {
      const double counted = numbers.empty() ? static_cast<double>(i) : numbers[i];
      const double place = clock.empty() ? counted : clock[i];
      result.trajectory.push_back({row->stamp.value_or(place), *row->pose});
    }
  }
  const std::size_t total = rows.size();
  if (result.no_pose == total)
    throw Error(path.string() + ": holds no pose: all " + std::to_string(total) +
                " rows say that there is none");
  bad.settle(total - result.no_pose, warnings);
  if (result.no_pose > 0) warnings.push_back(no_pose_note(path, result.no_pose, total));
  if (const StampUnit unit = stamp_unit_of(stamps_of(result.trajectory), StampsOf::kOther);
      !unit.is_seconds() && !result.counted) {
    for (StampedPose& pose : result.trajectory) pose.stamp /= unit.per_second;
    warnings.push_back(path.string() + ": " + unit_note(unit));
  }
  order_by_stamp(result.trajectory, path, warnings);
  return result;
}

// Poses by increasing stamp, as read_pose_file; stamps there must be.
[[nodiscard]] inline Trajectory read_trajectory(const std::filesystem::path& path, Warnings& warnings) {
  PoseFile file = read_pose_file(path, warnings);
  if (file.counted)
    throw Error(path.string() +
                ": its poses have no stamps; put their times into times.txt beside it, one a row");
  return std::move(file.trajectory);
}

}  // namespace sslam::io
