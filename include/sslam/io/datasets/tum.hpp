// SPDX-License-Identifier: BSD-3-Clause
// The TUM RGB-D layout (Sturm et al., IROS 2012): rgb.txt and depth.txt with rows of `stamp file`,
// groundtruth.txt.
#pragma once

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "sslam/io/datasets/dataset.hpp"
#include "sslam/io/files/text.hpp"

namespace sslam::io {

struct StampedFile {
  double stamp = 0;
  std::string file;
};

// Rows of `stamp file`, file relative to root. Throws Error when nothing usable is in the list.
[[nodiscard]] inline std::vector<StampedFile> read_file_list(const std::filesystem::path& list,
                                                             const std::filesystem::path& root,
                                                             Warnings& warnings) {
  const std::string text = read_text(list);
  const std::vector<TextRow> rows = split_rows(text);
  if (rows.empty()) throw Error(list.string() + ": names no image; expected rows of 'stamp file'");
  BadEntries bad(list);
  std::vector<StampedFile> files;
  for (const TextRow& row : rows) {
    const auto stamp = parse_number<double>(row.cells[0]);
    if (row.cells.size() < 2 || !stamp || !std::isfinite(*stamp)) {
      bad.add(row.line, "expected 'stamp file' with the stamp in seconds");
      continue;
    }
    files.push_back({*stamp, (root / row.cells[1]).string()});
  }
  bad.settle(rows.size(), warnings);
  return files;
}

// Pairs depth images with colour images by nearest stamp. Depth images that are not there cost their frames
// the depth, not the run: one warning tells of all of them.
inline void attach_depth(Dataset& dataset, const std::filesystem::path& list) {
  std::vector<StampedFile> files = read_file_list(list, dataset.root, dataset.warnings);
  std::stable_sort(files.begin(), files.end(),
                   [](const auto& a, const auto& b) { return a.stamp < b.stamp; });
  const std::vector<double> stamps = frame_stamps(dataset);
  std::vector<double> depth_stamps;
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

[[nodiscard]] inline bool is_tum(const std::filesystem::path& root) {
  std::error_code ignored;
  return std::filesystem::is_regular_file(root / "rgb.txt", ignored);
}

[[nodiscard]] inline Dataset read_tum(const std::filesystem::path& root) {
  const std::filesystem::path list = root / "rgb.txt";
  Dataset dataset;
  dataset.layout = Layout::kTum;
  dataset.root = root;
  dataset.name_hint = leading_comments(read_text(list));
  for (StampedFile& file : read_file_list(list, root, dataset.warnings)) {
    FrameEntry frame;
    frame.stamp = file.stamp;
    frame.image = std::move(file.file);
    dataset.frames.push_back(std::move(frame));
  }
  drop_bad_frames(dataset, list);
  std::error_code ignored;
  if (std::filesystem::exists(root / "depth.txt", ignored)) attach_depth(dataset, root / "depth.txt");
  const std::filesystem::path truth = root / "groundtruth.txt";
  if (std::filesystem::exists(truth, ignored)) {
    attach_ground_truth(dataset, read_trajectory(truth, dataset.warnings), truth);
  }
  return dataset;
}

}  // namespace sslam::io
