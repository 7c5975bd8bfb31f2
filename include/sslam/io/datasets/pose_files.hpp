// SPDX-License-Identifier: BSD-3-Clause
// Ground truth with a file a frame: a 4x4 matrix from camera to world.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "sslam/io/datasets/dataset.hpp"
#include "sslam/io/datasets/dataset_filling.hpp"
#include "sslam/io/files/bad_entries.hpp"
#include "sslam/io/files/plain_text.hpp"
#include "sslam/io/files/text.hpp"
#include "sslam/io/trajectories/pose_row.hpp"

namespace sslam::io {

// Nothing when the file does not hold a rigid motion, with the reason in `why`: empty where the matrix means
// that there is no pose.
[[nodiscard]] inline std::optional<SE3<double>> read_pose_matrix(const std::filesystem::path& path,
                                                                 std::string& why) {
  std::vector<double> v;
  const std::string text = read_plain_text(path);
  for (const TextRow& row : split_rows(text))
    for (const std::string_view cell : row.cells)
      if (const auto number = parse_cell(cell)) v.push_back(*number);
  if (v.size() == 12) v.insert(v.end(), {0, 0, 0, 1});  // without its last row
  std::optional<SE3<double>> pose;
  why.clear();
  if (v.size() != 16) {
    why = "expected a 4x4 matrix, found " + std::to_string(v.size()) + " numbers";
  } else if (!means_no_pose(v)) {
    pose = pose_of_matrix(v, why);
  }
  if (!why.empty()) why = path.filename().string() + ": " + why;
  return pose;
}

// Gives frames their poses, and keeps count of those that are none.
class PoseFiles {
 public:
  explicit PoseFiles(std::filesystem::path folder) : folder_(std::move(folder)), bad_(folder_) {}

  // Nothing happens where there is no such file. Call in order of the stamps.
  void attach(Dataset& dataset, FrameEntry& frame, const std::filesystem::path& file) {
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(file, ignored)) return;
    ++files_;
    std::string why;
    if (const auto world_from_cam = read_pose_matrix(file, why)) {
      frame.truth = static_cast<std::ptrdiff_t>(dataset.ground_truth.size());
      dataset.ground_truth.push_back({frame.stamp, *world_from_cam});
    } else if (why.empty()) {
      ++no_pose_;
    } else {
      bad_.add(why);
    }
  }

  // Call once, when all frames have been seen.
  void settle(Dataset& dataset) const {
    if (no_pose_ > 0) dataset.warnings.push_back(no_pose_note(folder_, no_pose_, files_));
    attach_or_leave_out(dataset, [&] {
      bad_.settle(files_ - no_pose_, dataset.warnings);
      if (files_ > 0 && files_ == no_pose_)
        leave_truth_out(dataset, folder_.string() + ": none of its poses is one");
    });
  }

 private:
  std::filesystem::path folder_;
  BadEntries bad_;
  std::size_t files_ = 0, no_pose_ = 0;
};

}  // namespace sslam::io
