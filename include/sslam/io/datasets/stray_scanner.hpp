// SPDX-License-Identifier: BSD-3-Clause
// Scans of the app Stray Scanner: a video rgb.mp4, depth/NNNNNN.png by the numbers of its frames, and ARKit's
// poses in odometry.csv. The camera stands in camera_matrix.csv.
#pragma once

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "sslam/io/datasets/colour_depth.hpp"
#include "sslam/io/datasets/dataset.hpp"
#include "sslam/io/datasets/dataset_filling.hpp"
#include "sslam/io/datasets/video.hpp"
#include "sslam/io/files/files.hpp"
#include "sslam/io/files/plain_text.hpp"
#include "sslam/io/files/text.hpp"
#include "sslam/io/trajectories/read_trajectory.hpp"

namespace sslam::io {

[[nodiscard]] inline bool is_stray_scan(const std::filesystem::path& root) {
  return !first_file({root / "rgb.mp4"}).empty() && !first_file({root / "odometry.csv"}).empty();
}

[[nodiscard]] inline Dataset read_stray_scan(const std::filesystem::path& root) {
  return read_video(root / "rgb.mp4");
}

namespace stray_scanner_detail {

// By stamp, as the table's second column has them. Empty: another table.
[[nodiscard]] inline std::map<double, std::int64_t> frame_numbers(const std::filesystem::path& file) {
  std::map<double, std::int64_t> numbers;
  const std::string text = read_plain_text(file);
  const std::vector<TextRow> rows = split_rows(text);
  if (rows.empty() || rows.front().cells.size() < 2 ||
      lower_case(std::string(rows.front().cells[1])) != "frame")
    return numbers;
  for (const TextRow& row : rows) {
    const auto stamp = parse_number<double>(row.cells[0]);
    const auto number = row.cells.size() > 1 ? parse_number<std::int64_t>(row.cells[1]) : std::nullopt;
    if (stamp && number) numbers.emplace(*stamp, *number);
  }
  return numbers;
}

}  // namespace stray_scanner_detail

// What lies beside the video of a scan, once its frames are known: poses and depth by their numbers.
inline void complete_stray_scan(Dataset& dataset) {
  constexpr double kMillimetres = 1000;
  const std::filesystem::path folder = dataset.root.parent_path(), odometry = folder / "odometry.csv";
  if (dataset.root.filename() != "rgb.mp4" || !is_stray_scan(folder)) return;
  std::map<std::int64_t, FrameEntry*> frames;
  for (FrameEntry& frame : dataset.frames) frames.emplace(frame.index, &frame);
  dataset.depth_factor = kMillimetres;
  bool any_depth = false;
  for (const std::filesystem::path& depth : list_files(folder / "depth", is_image_name)) {
    const auto frame = frames.find(parse_number<std::int64_t>(depth.stem().string()).value_or(-1));
    if (frame == frames.end()) continue;
    frame->second->depth = depth.string();
    any_depth = true;
  }
  if (!any_depth) tell_unread_depth(dataset, folder / "depth");
  attach_or_leave_out(dataset, [&] {
    const std::map<double, std::int64_t> numbers = stray_scanner_detail::frame_numbers(odometry);
    Trajectory truth;
    for (const StampedPose& pose : read_pose_file(odometry, dataset.warnings, kNoTimes).trajectory) {
      const auto number = numbers.find(pose.stamp);
      const auto frame = frames.find(number == numbers.end() ? std::llround(pose.stamp) : number->second);
      if (frame != frames.end() && (numbers.empty() || number != numbers.end()))
        truth.push_back({frame->second->stamp, pose.world_from_cam});
    }
    order_by_stamp(truth, odometry, dataset.warnings);
    attach_ground_truth(dataset, std::move(truth), odometry);
  });
}

}  // namespace sslam::io
