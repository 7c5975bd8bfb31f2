// SPDX-License-Identifier: BSD-3-Clause
// Ground truth of a body that carries the camera: a matrix in a YAML file says where the camera sits on it.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sslam/core/error.hpp"
#include "sslam/io/datasets/dataset_filling.hpp"
#include "sslam/io/files/plain_text.hpp"
#include "sslam/io/files/text.hpp"
#include "sslam/io/trajectories/pose_row.hpp"

namespace sslam::io {

// The matrix behind a key of a YAML file, as one list or as a list of rows. Throws Error when it is no pose.
[[nodiscard]] inline SE3<double> read_yaml_pose(const std::filesystem::path& file, std::string_view key) {
  std::string text = read_plain_text(file);
  const std::string problem = file.string() + ": " + std::string(key);
  const std::size_t at = text.find(std::string(key) + ":");
  const std::size_t open = at == std::string::npos ? at : text.find('[', at);
  if (open == std::string::npos) throw Error(problem + " is missing; expected a 4x4 matrix");
  text.erase(0, open);
  for (char& c : text)
    if (c == '[' || c == ']' || c == '\n') c = ' ';
  std::vector<double> v;
  for (const std::string_view cell : split_cells(text)) {
    if (cell == "-") continue;
    const auto number = parse_number<double>(cell);
    if (!number || v.size() == 16) break;
    v.push_back(*number);
  }
  std::string why = "expected a 4x4 matrix, found " + std::to_string(v.size()) + " numbers";
  const auto pose = v.size() == 16 ? pose_of_matrix(v, why) : std::nullopt;
  if (!pose) throw Error(problem + ": " + why);
  return *pose;
}

// The body's poses become the camera's.
inline void attach_body_truth(Dataset& dataset, Trajectory body, const SE3<double>& body_from_cam,
                              const std::filesystem::path& source) {
  for (StampedPose& pose : body) pose.world_from_cam = pose.world_from_cam * body_from_cam;
  attach_ground_truth(dataset, std::move(body), source);
}

}  // namespace sslam::io
