// SPDX-License-Identifier: BSD-3-Clause
// Poses that belong to images by their names, as COLMAP's do, and when those images were taken.
#pragma once

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "cli/input/open_images.hpp"
#include "sslam/io/datasets/name_stamps.hpp"
#include "sslam/io/files/csv_reader.hpp"
#include "sslam/io/trajectories/colmap_images.hpp"

namespace sslam::cli {

using NamedPoses = std::vector<io::NamedPose>;
using NameClock = std::map<std::string, double>;  // stamps by the images' file names

// Of a model of COLMAP: its folder, its images.txt or its images.bin; nothing for anything else. Throws Error
// for a model that is damaged.
[[nodiscard]] inline std::optional<NamedPoses> find_named_poses(const std::filesystem::path& path) {
  std::error_code ignored;
  std::filesystem::path file = path;
  if (std::filesystem::is_directory(path, ignored))
    for (const char* name : {"images.bin", "images.txt"})
      if (std::filesystem::is_regular_file(path / name, ignored)) file = path / name;
  if (!std::filesystem::is_regular_file(file, ignored)) return std::nullopt;
  NamedPoses poses;
  if (file.filename() == "images.bin") {
    poses = io::read_colmap_binary(file);
  } else {
    if (file.extension() != ".txt") return std::nullopt;
    const std::string text = io::read_plain_text(file);
    const std::vector<io::TextRow> rows = io::split_rows(text);
    if (rows.empty() || !io::is_colmap_row(rows.front())) return std::nullopt;
    poses = io::read_colmap_text(file, rows);
  }
  if (poses.empty()) throw Error(file.string() + ": holds no image with a pose");
  return poses;
}

[[nodiscard]] inline std::string file_name_of(const std::string& path) {
  return std::filesystem::path(path).filename().string();
}

// Of the run or the dataset that `path` is, or belongs to; empty where there is none.
[[nodiscard]] inline NameClock image_clock(const std::filesystem::path& path) {
  NameClock clock;
  std::error_code ignored;
  const bool whole = std::filesystem::is_directory(path, ignored);
  const std::filesystem::path folder = whole ? path : path.parent_path();
  try {
    if (std::filesystem::is_regular_file(folder / "frames.csv", ignored)) {
      io::Warnings unsaid;  // eval is about poses
      const io::CsvTable frames = io::read_csv(folder / "frames.csv", unsaid);
      const std::size_t image = frames.column("image"), stamp = frames.column("stamp");
      if (image == frames.columns.size() || stamp == frames.columns.size()) return clock;
      for (std::size_t row = 0; row < frames.rows(); ++row)
        if (const auto value = io::parse_number<double>(frames.cell(row, stamp)))
          clock[std::string(frames.cell(row, image))] = *value;
    } else if (whole || path.filename() == "groundtruth.txt") {
      for (const io::FrameEntry& frame : dataset_at(folder.empty() ? "." : folder).frames)
        clock[file_name_of(frame.image)] = frame.stamp;
    }
  } catch (const Error&) {  // no dataset
  }
  return clock;
}

// Stamps by the names' own order.
[[nodiscard]] inline NameClock clock_of_names(const NamedPoses& poses) {
  NameClock clock;
  for (const io::NamedPose& pose : poses) clock[file_name_of(pose.name)] = 0;
  double place = 0;
  for (auto& [name, stamp] : clock) stamp = place++;
  return clock;
}

// With the stamps of the clock; without one, names that are stamps tell. Throws Error, which names `file`.
[[nodiscard]] inline io::Trajectory stamped_poses(const NamedPoses& poses, const NameClock& clock,
                                                  const std::string& file, io::Warnings& warnings) {
  io::Trajectory trajectory;
  if (clock.empty()) {
    NameClock named;  // in the order of the names, which COLMAP's need not be
    for (const io::NamedPose& pose : poses) named.emplace(file_name_of(pose.name), 0);
    std::vector<std::filesystem::path> names;
    for (const auto& [name, unknown] : named) names.emplace_back(name);
    std::sort(names.begin(), names.end(),
              [](const auto& a, const auto& b) { return io::natural_less(a.string(), b.string()); });
    const io::NameStamps stamps = io::stamps_of_names(names);
    if (stamps.seconds.empty())
      throw Error(file + ": its images have names that are no stamps, such as " + poses.front().name +
                  "; compare it with the folder of a run or of a dataset that has these images");
    for (std::size_t i = 0; i < names.size(); ++i) named[names[i].string()] = stamps.seconds[i];
    for (const io::NamedPose& pose : poses)
      trajectory.push_back({named[file_name_of(pose.name)], pose.world_from_cam});
  } else {
    for (const io::NamedPose& pose : poses)
      if (const auto stamp = clock.find(file_name_of(pose.name)); stamp != clock.end())
        trajectory.push_back({stamp->second, pose.world_from_cam});
    if (trajectory.empty())
      throw Error(file + ": none of its images is among those that it is compared with; its first is " +
                  poses.front().name + ", theirs " + clock.begin()->first);
    if (const std::size_t missing = poses.size() - trajectory.size(); missing > 0)
      warnings.push_back(file + ": " + std::to_string(missing) + " of " + std::to_string(poses.size()) +
                         " images are not among those that it is compared with: left out");
  }
  io::Warnings unsaid;  // COLMAP's order is its own
  io::order_by_stamp(trajectory, file, unsaid);
  return trajectory;
}

}  // namespace sslam::cli
