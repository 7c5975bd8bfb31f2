// SPDX-License-Identifier: BSD-3-Clause
#include "cli/results/run_folder.hpp"

#include <exception>

#include "cli/results/json_file.hpp"
#include "cli/results/result_set.hpp"
#include "cli/results/scale_record.hpp"
#include "cli/results/truth_source.hpp"
#include "cli/results/view_file.hpp"
#include "cli/shell/messages.hpp"
#include "sslam/io/maps/map_file.hpp"

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
    settle_results(folder_);
    run_.name = folder_name(folder_);
    const bool has_metrics =
        take("metrics.json", [&](const fs::path& path) { run_.metrics = read_json_object(path); });
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
    if (!run_.map.empty() && has(kColourFile))
      take(kColourFile, [&](const fs::path& path) { run_.colours = read_colours(path, run_.map); });
    if (has(kModelFile)) take(kModelFile, [&](const fs::path& path) { run_.surfaces = read_glb(path); });
    if (has(kTruthFile)) take_poses(kTruthFile, run_.truth);
    if (has(kViewFile))
      take(kViewFile, [&](const fs::path& path) { run_.views = read_views(path, run_.problems); });
    for (std::string& line : foreign_files(folder_, checksums())) run_.problems.push_back(std::move(line));
    return std::move(run_);
  }

 private:
  // Of the files of the run, as it wrote them; older programs did not note them.
  [[nodiscard]] nlohmann::ordered_json checksums() const {
    return run_.metrics.value("files", nlohmann::ordered_json());
  }

  // Whether an optional file is there, or should be.
  [[nodiscard]] bool has(const char* name) const {
    std::error_code ignored;
    return fs::exists(folder_ / name, ignored) || checksums().contains(name);
  }

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
    take(name, [&](const fs::path& path) { poses = load_stamped(path, run_.problems); });
  }

  fs::path folder_;
  RunFolder run_;
};

}  // namespace

std::string folder_name(const fs::path& folder) {
  std::error_code ignored;
  return fs::weakly_canonical(folder, ignored).filename().string();
}

Map<double> load_run_map(const fs::path& file) {
  const fs::path folder = file.parent_path();
  settle_results(folder);
  Map<double> map = io::load_map(file);
  std::error_code ignored;
  if (!fs::is_regular_file(folder / "metrics.json", ignored)) return map;
  try {
    const auto checksums = read_json_object(folder / "metrics.json").value("files", nlohmann::ordered_json());
    const std::string name = file.filename().string();
    if (checksums.contains(name)) print_warnings(foreign_files(folder, {{name, checksums[name]}}));
  } catch (const Error&) {  // what stands beside a map need not be a run
  }
  return map;
}

bool is_metric_map(const fs::path& file) {
  const fs::path metrics = file.parent_path() / "metrics.json";
  std::error_code ignored;
  if (file.empty() || !fs::is_regular_file(metrics, ignored)) return false;
  try {
    return is_metric(read_json_object(metrics));
  } catch (const Error&) {
    return false;
  }
}

MapColours load_map_colours(const fs::path& file, const Map<double>& map) {
  const fs::path colours = file.parent_path() / kColourFile;
  std::error_code ignored;
  if (!fs::is_regular_file(colours, ignored)) return {};
  try {
    return read_colours(colours, map);
  } catch (const std::exception& problem) {
    print_warning(std::string(problem.what()) + ": points and lines are grey");
    return {};
  }
}

RunFolder read_run_folder(const fs::path& folder) {
  return Reader(folder).read();
}

}  // namespace sslam::cli
