// SPDX-License-Identifier: BSD-3-Clause
#include "cli/report/compared_run.hpp"

#include <algorithm>
#include <set>
#include <string>
#include <system_error>

#include "cli/report/frame_rows.hpp"
#include "sslam/core/error.hpp"
#include "sslam/io/evaluation/evaluation.hpp"
#include "sslam/map/vertical.hpp"

namespace sslam::cli {
namespace {

namespace fs = std::filesystem;

std::vector<double> stamps_of_frames(const RunFolder& run) {
  std::vector<double> stamps;
  for_each_stamp(run.frames, [&](double stamp, std::size_t) { stamps.push_back(stamp); });
  if (stamps.empty()) stamps = io::stamps_of(run.trajectory);
  std::sort(stamps.begin(), stamps.end());
  return stamps;
}

ComparedRun read_run(const fs::path& folder) {
  ComparedRun compared{folder, read_run_folder(folder), {}, {}};
  RunFolder& run = compared.run;
  compared.up = up_direction(run.map);
  run.map = {};
  run.colours = {};
  run.surfaces = {};
  run.views = {};
  compared.stamps = stamps_of_frames(run);
  return compared;
}

// As the run was told it; empty where metrics.json does not say.
std::string dataset_of(const RunFolder& run) {
  const auto settings = run.metrics.find("settings");
  if (settings == run.metrics.end() || !settings->is_object()) return {};
  const auto dataset = settings->find("dataset");
  return dataset != settings->end() && dataset->is_string() ? dataset->get<std::string>() : std::string();
}

std::string last_name(const std::string& path) {
  const std::size_t end = path.find_last_not_of('/');
  if (end == std::string::npos) return path;
  const std::size_t slash = path.find_last_of('/', end);
  const std::size_t from = slash == std::string::npos ? 0 : slash + 1;
  return path.substr(from, end + 1 - from);
}

// Whether two ground truths say the same of the moments that both know.
bool agree(const io::Trajectory& a, const io::Trajectory& b) {
  constexpr double kRounding = 1e-4;  // metres, of poses in text files
  const std::vector<double> of_a = io::stamps_of(a), of_b = io::stamps_of(b);
  const auto pairs = io::associate(of_a, of_b);
  return std::all_of(pairs.begin(), pairs.end(), [&](const io::StampPair& pair) {
    return a[pair.a].stamp != b[pair.b].stamp ||
           (a[pair.a].world_from_cam.translation - b[pair.b].world_from_cam.translation).norm() <= kRounding;
  });
}

// "12.5 to 20.25"
std::string span_of(const std::vector<double>& stamps) {
  if (stamps.empty()) return "none";
  return io::exact_decimal(stamps.front()) + " to " + io::exact_decimal(stamps.back());
}

// Throws Error where `b` cannot stand beside `a`.
void demand_same_dataset(const ComparedRun& a, const ComparedRun& b) {
  const std::string of_a = dataset_of(a.run), of_b = dataset_of(b.run);
  const auto refuse = [&](const std::string& why) {
    throw Error(b.folder.string() + ": " + why + "; runs of one dataset can be compared");
  };
  if (!a.run.truth.empty() && !b.run.truth.empty()) {
    if (!agree(a.run.truth, b.run.truth)) refuse("has a different ground truth from " + a.folder.string());
  } else if (!of_a.empty() && !of_b.empty() && last_name(of_a) != last_name(of_b)) {
    refuse("is a run of " + of_b + ", " + a.folder.string() + " is one of " + of_a);
  }
  if (io::associate(a.stamps, b.stamps).size() < kFewestPoses)
    refuse("has no frames of the same times (stamps " + span_of(b.stamps) + ") as " + a.folder.string() +
           " (" + span_of(a.stamps) + ")");
}

void demand_different(const std::vector<fs::path>& folders) {
  std::set<fs::path> known;
  std::error_code ignored;
  for (const fs::path& folder : folders)
    if (!known.insert(fs::weakly_canonical(folder, ignored)).second)
      throw Error(folder.string() + ": is named twice; expected different runs");
}

}  // namespace

std::vector<ComparedRun> read_comparable_runs(const std::vector<fs::path>& folders) {
  demand_different(folders);
  std::vector<ComparedRun> runs;
  for (const fs::path& folder : folders) {
    runs.push_back(read_run(folder));
    if (runs.back().stamps.size() < kFewestPoses)
      throw Error(folder.string() + ": has fewer than " + std::to_string(kFewestPoses) +
                  " frames to compare");
    demand_same_dataset(runs.front(), runs.back());
  }
  return runs;
}

}  // namespace sslam::cli
