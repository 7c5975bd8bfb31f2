// SPDX-License-Identifier: BSD-3-Clause
// The TUM RGB-D layout (Sturm et al., IROS 2012): rgb.txt and depth.txt with rows of `stamp file`, or their
// pairs in associations.txt alone; groundtruth.txt.
#pragma once

#include <algorithm>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "sslam/io/datasets/counts_frames.hpp"
#include "sslam/io/datasets/dataset.hpp"
#include "sslam/io/datasets/dataset_filling.hpp"
#include "sslam/io/datasets/file_list.hpp"
#include "sslam/io/files/plain_text.hpp"
#include "sslam/io/trajectories/read_trajectory.hpp"

namespace sslam::io {

// Pairs depth images with colour images by nearest stamp. Depth images that are not there cost their frames
// the depth, not the run: one warning tells of all of them.
inline void attach_depth(Dataset& dataset, const std::filesystem::path& list,
                         std::vector<StampedFile> files) {
  std::stable_sort(files.begin(), files.end(),
                   [](const auto& a, const auto& b) { return a.stamp < b.stamp; });
  const std::vector<double> stamps = frame_stamps(dataset);
  std::vector<double> depth_stamps;
  depth_stamps.reserve(files.size());
  for (const StampedFile& file : files) depth_stamps.push_back(file.stamp);
  std::size_t absent = 0;
  std::string first_absent;
  const std::vector<StampPair> pairs = associate(stamps, depth_stamps, kMaxStampDifference);
  for (const StampPair& pair : pairs) {
    const std::string& depth = files[pair.b].file;
    std::error_code ignored;
    if (std::filesystem::is_regular_file(depth, ignored)) {
      dataset.frames[pair.a].depth = depth;
    } else if (absent++ == 0) {
      first_absent = depth;
    }
  }
  if (absent == 0) return;
  dataset.warnings.push_back(list.string() + ": names " + first_absent + ", which is not there; " +
                             std::to_string(absent) + " of " + std::to_string(pairs.size()) +
                             " depth images are missing, their frames have no depth");
}

// The comments of the published lists name the recording: "# file: 'rgbd_dataset_freiburg3_....bag'".
[[nodiscard]] inline std::string leading_comments(const std::string& text) {
  std::size_t end = 0;
  while (end < text.size() && text[end] == '#') end = std::min(text.find('\n', end), text.size() - 1) + 1;
  return text.substr(0, end);
}

// The pairs that the TUM tools make of rgb.txt and depth.txt; empty: none. Those that count frames are
// ICL-NUIM's.
[[nodiscard]] inline std::filesystem::path find_associations(const std::filesystem::path& root) {
  const auto named = [](const std::filesystem::path& name) {
    return name.extension() == ".txt" && lower_case(name.string()).find("assoc") != std::string::npos;
  };
  for (const std::filesystem::path& file : list_files(root, named))
    if (!counts_frames(file)) return file;
  return {};
}

[[nodiscard]] inline bool is_tum(const std::filesystem::path& root) {
  std::error_code ignored;
  return std::filesystem::is_regular_file(root / "rgb.txt", ignored) || !find_associations(root).empty();
}

// Whether most names have a part such as depth/.
[[nodiscard]] inline bool name_depth(const std::vector<StampedFile>& files) {
  const auto count = std::count_if(files.begin(), files.end(), [](const StampedFile& file) {
    const std::filesystem::path path = file.file;
    return lower_case((path.parent_path().filename() / path.filename()).string()).find("depth") !=
           std::string::npos;
  });
  return 2 * static_cast<std::size_t>(count) > files.size();
}

[[nodiscard]] inline Dataset read_tum(const std::filesystem::path& root) {
  std::error_code ignored;
  const bool own_list = std::filesystem::is_regular_file(root / "rgb.txt", ignored);
  const std::filesystem::path list = own_list ? root / "rgb.txt" : find_associations(root);
  Dataset dataset;
  dataset.layout = Layout::kTum;
  dataset.root = root;
  dataset.name_hint = leading_comments(read_plain_text(list));
  // ETH3D SLAM: the same layout with `fx fy cx cy` beside it and TUM's depth factor.
  if (const auto calibration = root / "calibration.txt";
      std::filesystem::is_regular_file(calibration, ignored)) {
    dataset.camera_file = calibration;
    dataset.depth_factor = 5000;
  }
  std::vector<StampedFile> partners;
  std::vector<StampedFile> files =
      read_file_list(list, root, dataset.warnings, {}, own_list ? nullptr : &partners);
  // Some tools write the depth image first.
  if (name_depth(files) && !partners.empty() && !name_depth(partners)) std::swap(files, partners);
  take_listed_frames(dataset, std::move(files), list);
  const std::filesystem::path depth = root / "depth.txt";
  if (std::filesystem::exists(depth, ignored)) {
    attach_depth(dataset, depth, read_file_list(depth, root, dataset.warnings));
  } else if (!partners.empty()) {
    attach_depth(dataset, list, std::move(partners));
  }
  attach_truth_file(dataset, root / "groundtruth.txt");
  return dataset;
}

}  // namespace sslam::io
