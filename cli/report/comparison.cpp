// SPDX-License-Identifier: BSD-3-Clause
#include "cli/report/comparison.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "cli/report/packed.hpp"
#include "cli/report/report_data.hpp"
#include "cli/results/run_folder.hpp"
#include "cli/results/scale_record.hpp"
#include "sslam/core/error.hpp"
#include "sslam/io/evaluation/evaluation.hpp"
#include "sslam/map/vertical.hpp"

namespace sslam::cli {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::size_t kFewest = 3;  // poses that an alignment needs

struct ComparedRun {
  fs::path folder;
  RunFolder run;               // without its map and pictures
  Vec3<double> up;             // of its map, a unit vector
  std::vector<double> stamps;  // of all its frames, increasing
};

std::optional<double> stamp_in(const io::CsvTable& frames, std::size_t row, std::size_t column) {
  const auto stamp = io::parse_number<double>(frames.cell(row, column));
  return stamp && std::isfinite(*stamp) ? std::optional(*stamp) : std::nullopt;
}

std::vector<double> stamps_of_frames(const RunFolder& run) {
  std::vector<double> stamps;
  const std::size_t column = run.frames.column("stamp");
  for (std::size_t row = 0; row < run.frames.rows() && column < run.frames.columns.size(); ++row)
    if (const auto stamp = stamp_in(run.frames, row, column)) stamps.push_back(*stamp);
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
    if (!agree(a.run.truth, b.run.truth)) refuse("has another ground truth than " + a.folder.string());
  } else if (!of_a.empty() && !of_b.empty() && last_name(of_a) != last_name(of_b)) {
    refuse("is a run of " + of_b + ", " + a.folder.string() + " is one of " + of_a);
  }
  if (io::associate(a.stamps, b.stamps).size() < kFewest)
    refuse("has no frames of the same times (stamps " + span_of(b.stamps) + ") as " + a.folder.string() +
           " (" + span_of(a.stamps) + ")");
}

// What the runs are laid over.
struct CommonWorld {
  io::Trajectory poses;
  std::size_t run = 0;  // whose they are
  bool truth = false;   // they are its ground truth
  bool metric = false;
  Vec3<double> up = -Vec3<double>::UnitY();

  [[nodiscard]] bool empty() const noexcept { return poses.empty(); }
};

// The axis that is nearest to where the cameras have their upper side, on average; that itself where none is
// near.
Vec3<double> up_of(const io::Trajectory& poses) {
  constexpr double kNear = 0.85;  // cosine
  Vec3<double> up = Vec3<double>::Zero();
  for (const io::StampedPose& pose : poses) up -= pose.world_from_cam.rotation * Vec3<double>::UnitY();
  if (up.norm() < 1e-9) return -Vec3<double>::UnitY();
  up.normalize();
  Eigen::Index axis = 0;
  if (up.cwiseAbs().maxCoeff(&axis) < kNear) return up;
  return (up[axis] > 0 ? 1.0 : -1.0) * Vec3<double>::Unit(axis);
}

CommonWorld choose_reference(const std::vector<ComparedRun>& runs) {
  for (std::size_t i = 0; i < runs.size(); ++i)
    if (runs[i].run.truth.size() >= kFewest)
      return {runs[i].run.truth, i, true, true, up_of(runs[i].run.truth)};
  for (std::size_t i = 0; i < runs.size(); ++i)
    if (runs[i].run.trajectory.size() >= kFewest)
      return {runs[i].run.trajectory, i, false, is_metric(runs[i].run.metrics), runs[i].up};
  return {};
}

Json figures_of(const io::Statistics& s, double factor = 1) {
  return {{"rmse", factor * s.rmse}, {"median", factor * s.median}, {"max", factor * s.max}};
}

// Rows of frames.csv by their stamps, and arrays over them.
class FrameRows {
 public:
  explicit FrameRows(const io::CsvTable& frames) : count_(frames.rows()) {
    const std::size_t column = frames.column("stamp");
    for (std::size_t row = 0; row < count_ && column < frames.columns.size(); ++row)
      if (const auto stamp = stamp_in(frames, row, column)) row_of_[*stamp] = row;
  }

  [[nodiscard]] std::vector<double> empty(std::size_t size) const {
    return std::vector<double>(size * count_, std::numeric_limits<double>::quiet_NaN());
  }
  [[nodiscard]] std::optional<std::size_t> row_of(double stamp) const {
    const auto found = row_of_.find(stamp);
    return found == row_of_.end() ? std::nullopt : std::optional(found->second);
  }

 private:
  std::size_t count_;
  std::map<double, std::size_t> row_of_;
};

// The path in the reference's world, and the errors of its frames.
void lay_over(const CommonWorld& reference, const ComparedRun& compared, bool itself, Json& data) {
  const io::Trajectory& estimate = compared.run.trajectory;
  const FrameRows rows(compared.run.frames);
  Sim3<double> reference_from_run;
  std::vector<double> path = rows.empty(3), position = rows.empty(1), rotation = position;
  if (!itself) {
    const bool own = reference.truth && !compared.run.truth.empty();
    const io::PairedPoses paired =
        io::pair_poses(own ? compared.run.truth : reference.poses, estimate, io::kMaxStampDifference);
    reference_from_run =
        io::align(io::positions_of(paired.estimate), io::positions_of(paired.truth), io::Alignment::kSim3);
    const std::vector<double> distances = io::position_errors(paired, reference_from_run),
                              angles = io::rotation_errors(paired, io::rotation_offset(paired));
    for (std::size_t i = 0; i < distances.size(); ++i) {
      const auto row = rows.row_of(paired.estimate[i].stamp);
      if (!row) continue;
      position[*row] = distances[i];
      rotation[*row] = degrees(angles[i]);
    }
    data["errors"] = {{"position_m", floats(position)}, {"rotation_deg", floats(rotation)}};
    data["figures"] = {{"position", figures_of(io::statistics_of(distances))},
                       {"rotation", figures_of(io::statistics_of(angles), degrees(1.0))}};
  }
  for (const io::StampedPose& pose : estimate) {
    const Vec3<double> place = reference_from_run * pose.world_from_cam.translation;
    if (const auto row = rows.row_of(pose.stamp))
      std::copy(place.begin(), place.end(), path.begin() + static_cast<std::ptrdiff_t>(3 * *row));
  }
  data["path"] = floats(path);
}

// Of each run a name that no other has.
std::vector<std::string> labels_of(const std::vector<ComparedRun>& runs) {
  std::map<std::string, int> count;
  for (const ComparedRun& one : runs) ++count[one.run.name];
  std::vector<std::string> labels;
  labels.reserve(runs.size());
  for (const ComparedRun& one : runs)
    labels.push_back(count[one.run.name] == 1 ? one.run.name : one.folder.lexically_normal().string());
  return labels;
}

// From the page to the run's own report; empty where there is none.
std::string link_to(const fs::path& folder, const fs::path& page) {
  std::error_code error;
  const fs::path report = folder / kReportFile;
  if (!fs::exists(report, error)) return {};
  const fs::path from = fs::weakly_canonical(fs::absolute(page, error), error).parent_path();
  return fs::weakly_canonical(report, error).lexically_relative(from).generic_string();
}

Json truth_json(const io::Trajectory& truth) {
  std::vector<double> positions, stamps;
  for (const io::StampedPose& pose : truth) {
    const Vec3<double>& place = pose.world_from_cam.translation;
    positions.insert(positions.end(), place.begin(), place.end());
    stamps.push_back(pose.stamp);
  }
  return {{"positions", floats(positions)}, {"stamps", packed<double>("f64", stamps)}};
}

void demand_different(const std::vector<fs::path>& folders) {
  std::set<fs::path> known;
  std::error_code ignored;
  for (const fs::path& folder : folders)
    if (!known.insert(fs::weakly_canonical(folder, ignored)).second)
      throw Error(folder.string() + ": is named twice; expected different runs");
}

}  // namespace

Comparison compare_runs(const std::vector<fs::path>& folders, const fs::path& page) {
  demand_different(folders);
  std::vector<ComparedRun> runs;
  for (const fs::path& folder : folders) {
    runs.push_back(read_run(folder));
    if (runs.back().stamps.size() < kFewest)
      throw Error(folder.string() + ": has fewer than " + std::to_string(kFewest) + " frames to compare");
    demand_same_dataset(runs.front(), runs.back());
  }
  const CommonWorld reference = choose_reference(runs);
  const std::vector<std::string> labels = labels_of(runs);
  Comparison comparison;
  Json list = Json::array();
  for (std::size_t i = 0; i < runs.size(); ++i) {
    ComparedRun& one = runs[i];
    Json data = report_data(one.run);
    data.erase("truth");
    data.erase("errors");
    data["label"] = labels[i];
    data["link"] = link_to(one.folder, page);
    try {
      if (!one.run.trajectory.empty()) lay_over(reference, one, !reference.truth && i == reference.run, data);
    } catch (const Error& error) {
      data["note"] = std::string("its path is not shown: ") + error.what();
    }
    comparison.warnings.insert(comparison.warnings.end(), one.run.problems.begin(), one.run.problems.end());
    list.push_back(std::move(data));
  }
  Json& data = comparison.data;
  data["reference"] = reference.empty() ? "none" : reference.truth ? "truth" : "run";
  data["reference_label"] = labels[reference.run];
  data["unit"] = reference.metric ? "m" : "map units";
  data["up"] = {reference.up.x(), reference.up.y(), reference.up.z()};
  if (reference.truth) data["truth"] = truth_json(reference.poses);
  data["runs"] = std::move(list);
  return comparison;
}

}  // namespace sslam::cli
