// SPDX-License-Identifier: BSD-3-Clause
#include "cli/report/comparison.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "cli/report/compared_run.hpp"
#include "cli/report/frame_rows.hpp"
#include "cli/report/packed.hpp"
#include "cli/report/report_data.hpp"
#include "cli/report/truth_data.hpp"
#include "cli/results/run_folder.hpp"
#include "cli/results/scale_record.hpp"
#include "sslam/core/error.hpp"
#include "sslam/io/evaluation/evaluation.hpp"

namespace sslam::cli {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

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
    if (runs[i].run.truth.size() >= kFewestPoses)
      return {runs[i].run.truth, i, true, true, up_of(runs[i].run.truth)};
  for (std::size_t i = 0; i < runs.size(); ++i)
    if (runs[i].run.trajectory.size() >= kFewestPoses)
      return {runs[i].run.trajectory, i, false, is_metric(runs[i].run.metrics), runs[i].up};
  return {};
}

Json figures_of(const io::Statistics& s, double factor = 1) {
  return {{"rmse", factor * s.rmse}, {"median", factor * s.median}, {"max", factor * s.max}};
}

// The path in the reference's world, and the errors of its frames.
void lay_over(const CommonWorld& reference, const ComparedRun& compared, bool itself, Json& data) {
  const io::Trajectory& estimate = compared.run.trajectory;
  const FrameRows rows(compared.run.frames);
  Sim3<double> reference_from_run;
  std::vector<double> path = rows.empty(3);
  if (!itself) {
    const bool own = reference.truth && !compared.run.truth.empty();
    const io::PairedPoses paired =
        io::pair_poses(own ? compared.run.truth : reference.poses, estimate, io::kMaxStampDifference);
    reference_from_run =
        io::align(io::positions_of(paired.estimate), io::positions_of(paired.truth), io::Alignment::kSim3);
    const std::vector<double> distances = io::position_errors(paired, reference_from_run),
                              angles = io::rotation_errors(paired, io::rotation_offset(paired));
    data["errors"] = error_data(rows, paired.estimate, distances, angles);
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

}  // namespace

Comparison compare_runs(const std::vector<fs::path>& folders, const fs::path& page) {
  std::vector<ComparedRun> runs = read_comparable_runs(folders);
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
  if (reference.truth) data["truth"] = truth_data(reference.poses);
  data["runs"] = std::move(list);
  return comparison;
}

}  // namespace sslam::cli
