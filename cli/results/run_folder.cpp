// SPDX-License-Identifier: BSD-3-Clause
#include "cli/results/run_folder.hpp"

#include <exception>

#include "cli/results/view_file.hpp"
#include "sslam/io/maps/map_file.hpp"
#include "sslam/io/trajectories/read_trajectory.hpp"

namespace sslam::cli {
namespace {

namespace fs = std::filesystem;

class Reader {
 public:
  explicit Reader(fs::path folder) : folder_(std::move(folder)) {}

  [[nodiscard]] RunFolder read() {
    std::error_code error;
    if (!fs::is_directory(folder_, error))
      throw Error(folder_.string() + ": " + (fs::exists(folder_, error) ? "is no folder" : "no such folder") +
                  "; expected the one that `sslam run --out` has written to");
    run_.name = folder_name(folder_);
    const bool has_metrics = take("metrics.json", [&](const fs::path& path) { read_metrics(path); });
    const bool has_frames =
        take("frames.csv", [&](const fs::path& path) { run_.frames = io::read_csv(path, run_.problems); });
    if (!has_metrics && !has_frames)
      throw Error(folder_.string() + ": holds no run that can be read (" + run_.problems.front() + ")");
    // A run that tracked nothing has no poses to read, and no map.
    if (!counted_none("keyframes")) take_poses("keyframes.txt", run_.keyframes);
    if (!counted_none("tracked")) {
      take_poses("trajectory.txt", run_.trajectory);
      take("map.sslam", [&](const fs::path& path) { run_.map = io::load_map(path); });
    }
    if (fs::exists(folder_ / kTruthFile, error)) take_poses(kTruthFile, run_.truth);
    if (fs::exists(folder_ / kViewFile, error))
      take(kViewFile, [&](const fs::path& path) { run_.views = read_views(path, run_.problems); });
    return std::move(run_);
  }

 private:
  [[nodiscard]] bool counted_none(const char* name) const {
    const auto count = run_.metrics.find(name);
    return count != run_.metrics.end() && *count == 0;
  }

  // Whether the file is there and sound; if not, the reason is noted.
  template <class Read>
  bool take(const char* name, Read read_file) {
    const fs::path path = folder_ / name;
    std::error_code error;
    if (!fs::exists(path, error)) {
      run_.problems.push_back(path.string() + ": is missing");
      return false;
    }
    try {
      read_file(path);
      return true;
    } catch (const std::exception& problem) {
      run_.problems.emplace_back(problem.what());
      return false;
    }
  }

  void take_poses(const char* name, io::Trajectory& poses) {
    take(name, [&](const fs::path& path) { poses = io::read_trajectory(path, run_.problems); });
  }

  void read_metrics(const fs::path& path) {
    auto metrics = nlohmann::ordered_json::parse(io::read_text(path), nullptr, false);
    if (!metrics.is_object()) throw Error(path.string() + ": is no JSON object; cut off?");
    run_.metrics = std::move(metrics);
  }

  fs::path folder_;
  RunFolder run_;
};

}  // namespace

std::string folder_name(const fs::path& folder) {
  std::error_code ignored;
  return fs::weakly_canonical(folder, ignored).filename().string();
}

RunFolder read_run_folder(const fs::path& folder) {
  return Reader(folder).read();
}

}  // namespace sslam::cli
