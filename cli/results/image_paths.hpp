// SPDX-License-Identifier: BSD-3-Clause
// Where the images of a run's keyframes are, as seen from the folder of an export.
#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <system_error>

#include "cli/input/open_images.hpp"
#include "cli/results/run_folder.hpp"
#include "cli/results/straight_images.hpp"

namespace sslam::cli {

class ImagePaths {
 public:
  // `straight`: those that write_straight_images writes into `out`; else where the run has found them.
  ImagePaths(const RunFolder& run, std::filesystem::path out, bool straight)
      : out_(std::filesystem::absolute(out)), straight_(straight) {
    if (!straight) find_files(run.metrics.at("settings").value("dataset", std::string()));
  }

  // From the export's folder to the image of that name. Empty where it is not there, or its dataset is a
  // video or a bag.
  [[nodiscard]] std::string of(const std::string& name) const {
    if (straight_) return (std::filesystem::path(kStraightFolder) / name).generic_string();
    const auto file = files_.find(name);
    if (file == files_.end()) return {};
    std::error_code ignored;
    return std::filesystem::relative(std::filesystem::absolute(file->second), out_, ignored).generic_string();
  }

 private:
  void find_files(const std::string& dataset) {
    try {
      for (const io::FrameEntry& frame : dataset_at(dataset).frames)
        files_[std::filesystem::path(frame.image).filename().string()] = frame.image;
    } catch (const Error&) {  // an export is of use without the images
    }
  }

  std::filesystem::path out_;
  bool straight_;
  std::map<std::string, std::filesystem::path> files_;  // by their names
};

}  // namespace sslam::cli
