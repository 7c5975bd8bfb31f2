// SPDX-License-Identifier: BSD-3-Clause
#include "cli/batch/results.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "cli/batch/run_mark.hpp"
#include "cli/results/json_file.hpp"
#include "cli/results/run_folder.hpp"
#include "cli/results/truth_source.hpp"
#include "sslam/core/types.hpp"
#include "sslam/io/evaluation/evaluation.hpp"
#include "sslam/io/files/text.hpp"

namespace sslam::cli {
namespace {

namespace fs = std::filesystem;

std::vector<double> read_stamps(const fs::path& file) {
  std::vector<double> stamps;
  const std::string text = io::read_text(file);
  for (const io::TextRow& row : io::split_rows(text))
    if (const auto stamp = io::parse_number<double>(row.cells.front())) stamps.push_back(*stamp);
  return stamps;
}

// An estimate without the trajectory says why.
void take_trajectory(const fs::path& file, Estimate& estimate) {
  io::Warnings ignored;
  try {
    estimate.trajectory = load_stamped(file, ignored);
  } catch (const Error& error) {
    estimate.failed = estimate.broken = true;
    estimate.reason = error.what();
  }
}

std::optional<double> frame_rate_of(const fs::path& run_folder) {
  try {
    return read_json_object(run_folder / "metrics.json").at("times").at("frames_per_second").get<double>();
  } catch (const std::exception&) {
    return std::nullopt;  // of another version
  }
}

Estimate read_run(const fs::path& folder, const Plan& plan, const PlannedRun& run) {
  Estimate estimate;
  estimate.title = run.title;
  for (const std::string& part : plan.parts) {
    const fs::path place = folder / part / run.folder;
    const auto mark = read_mark(place);
    if (!mark || mark->arguments != run.arguments) continue;
    estimate.done = true;
    estimate.seconds = mark->seconds;
    estimate.failed = mark->end != RunEnd::kTracked;
    estimate.broken = mark->end == RunEnd::kBroken;
    estimate.reason = mark->reason;
    estimate.frames = run.frames;
    estimate.report.clear();
    std::error_code ignored;
    if (fs::exists(place / kReportFile, ignored)) estimate.report = place / kReportFile;
    if (!estimate.failed) {
      take_trajectory(place / "trajectory.txt", estimate);
      estimate.frame_rate = frame_rate_of(place);
    }
    if (!estimate.broken) break;  // else another part may have the run in one piece
  }
  return estimate;
}

void add_methods(const fs::path& folder, const Plan& plan, const std::string& suffix, Results& results) {
  for (const std::string& method : plan.methods) {
    ResultColumn column{method + suffix, plan.min_tracked};
    for (const PlannedRun& run : plan.runs)
      if (run.method == method) column.by_sequence[run.sequence].push_back(read_run(folder, plan, run));
    results.columns.push_back(std::move(column));
  }
}

void add_references(const fs::path& folder, const Plan& plan, Results& results) {
  for (const PlannedReference& reference : plan.references) {
    ResultColumn column{reference.name, reference.min_tracked};
    for (const auto& [sequence, files] : reference.trajectories) {
      for (const std::string& file : files) {
        Estimate estimate;
        estimate.title = sequence + ", " + reference.name + ", " + fs::path(file).filename().string();
        estimate.done = true;
        take_trajectory(folder / file, estimate);
        column.by_sequence[sequence].push_back(std::move(estimate));
      }
    }
    results.columns.push_back(std::move(column));
  }
}

// A trajectory against the truth, both as they are or cut to some frames.
std::optional<io::Evaluation> evaluation_of(const io::Trajectory& truth, const io::Trajectory& estimate,
                                            std::string& why) {
  if (truth.empty()) return std::nullopt;
  try {
    return io::evaluate(truth, estimate, {});
  } catch (const Error& error) {
    why = error.what();
    return std::nullopt;
  }
}

void judge(const ResultSequence& sequence, double min_tracked, Estimate& estimate) {
  if (!estimate.done || estimate.failed) return;
  const std::vector<double>& frames = sequence.frames_of(estimate).stamps;
  const auto tracked = io::associate(frames, io::stamps_of(estimate.trajectory)).size();
  estimate.share =
      static_cast<double>(tracked) / static_cast<double>(std::max<std::size_t>(1, frames.size()));
  if (estimate.share < min_tracked) {
    char text[64];
    std::snprintf(text, sizeof text, "tracked %.1f %% of the frames, less than %.1f %%", 100 * estimate.share,
                  100 * min_tracked);
    estimate.failed = true;
    estimate.reason = text;
  }
  std::string why;
  if (const auto found = evaluation_of(sequence.truth, estimate.trajectory, why)) {
    estimate.ate = found->position.rmse;
    estimate.rotation = degrees(found->rotation_own_offset.rmse);
  }
  if (!why.empty() && !estimate.failed) {
    estimate.failed = true;
    estimate.reason = why;
  }
}

// Which poses belong to the frames: pose[f] is an index into the trajectory, or its size.
std::vector<std::size_t> poses_of_frames(const std::vector<double>& frames,
                                         const io::Trajectory& trajectory) {
  std::vector<std::size_t> pose(frames.size(), trajectory.size());
  for (const io::StampPair& pair : io::associate(frames, io::stamps_of(trajectory))) pose[pair.a] = pair.b;
  return pose;
}

// Calls visit(estimate) for those from this start of the sequence that count.
template <class Visit>
void for_good(Results& results, const ResultSequence& sequence, const ResultFrames& start, Visit visit) {
  for (ResultColumn& column : results.columns)
    if (const auto found = column.by_sequence.find(sequence.name); found != column.by_sequence.end())
      for (Estimate& estimate : found->second)
        if (estimate.done && !estimate.failed && &sequence.frames_of(estimate) == &start) visit(estimate);
}

void evaluate_common(Results& results, const ResultSequence& sequence, ResultFrames& start) {
  std::vector<bool> common(start.stamps.size(), true);
  std::size_t estimates = 0;
  for_good(results, sequence, start, [&](const Estimate& estimate) {
    ++estimates;
    const auto pose = poses_of_frames(start.stamps, estimate.trajectory);
    for (std::size_t f = 0; f < pose.size(); ++f)
      if (pose[f] == estimate.trajectory.size()) common[f] = false;
  });
  start.common =
      estimates == 0 ? 0 : static_cast<std::size_t>(std::count(common.begin(), common.end(), true));
  for_good(results, sequence, start, [&](Estimate& estimate) {
    const auto pose = poses_of_frames(start.stamps, estimate.trajectory);
    io::Trajectory kept;
    for (std::size_t f = 0; f < pose.size(); ++f)
      if (common[f]) kept.push_back(estimate.trajectory[pose[f]]);
    std::string ignored;  // too few frames in common: no figure
    if (kept.empty()) return;
    if (const auto found = evaluation_of(sequence.truth, kept, ignored))
      estimate.common_ate = found->position.rmse;
  });
}

ResultSequence read_sequence(const fs::path& folder, const Plan& plan, const std::string& name) {
  const fs::path part = folder / plan.parts.front();
  ResultSequence sequence{name, {}, {}};
  for (const PlannedRun& run : plan.runs) {
    const auto same = [&](const ResultFrames& start) { return start.file == run.frames; };
    if (run.sequence == name && std::none_of(sequence.starts.begin(), sequence.starts.end(), same))
      sequence.starts.push_back({run.frames, read_stamps(part / run.frames)});
  }
  io::Warnings ignored;
  std::error_code none;
  const fs::path truth = part / truth_file_of(name);
  if (fs::exists(truth, none)) sequence.truth = load_stamped(truth, ignored);
  return sequence;
}

// Names alone: either may be a link.
fs::path relative_to(const fs::path& folder, const fs::path& file) {
  return fs::absolute(file).lexically_normal().lexically_relative(
      fs::absolute(folder / "").lexically_normal());
}

}  // namespace

Results read_results(const fs::path& folder, const std::vector<fs::path>& earlier) {
  const Plan plan = read_plan(folder);
  Results results;
  results.name = plan.name;
  results.min_tracked = plan.min_tracked;
  for (const std::string& name : plan.sequences)
    results.sequences.push_back(read_sequence(folder, plan, name));
  add_methods(folder, plan, "", results);
  add_references(folder / plan.parts.front(), plan, results);
  for (const fs::path& other : earlier) {
    const fs::path clean = fs::absolute(other).lexically_normal();
    const fs::path last = clean.has_filename() ? clean.filename() : clean.parent_path().filename();
    add_methods(other, read_plan(other), " (" + last.string() + ")", results);
  }
  for (ResultSequence& sequence : results.sequences) {
    for (ResultColumn& column : results.columns)
      if (const auto found = column.by_sequence.find(sequence.name); found != column.by_sequence.end())
        for (Estimate& estimate : found->second) {
          judge(sequence, column.min_tracked, estimate);
          if (!estimate.report.empty()) estimate.report = relative_to(folder, estimate.report);
        }
    for (ResultFrames& start : sequence.starts) evaluate_common(results, sequence, start);
  }
  return results;
}

}  // namespace sslam::cli
