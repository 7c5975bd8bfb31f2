// SPDX-License-Identifier: BSD-3-Clause
#include "cli/eval/eval_input.hpp"

#include <utility>

#include "cli/results/result_set.hpp"
#include "cli/shell/messages.hpp"
#include "sslam/core/error.hpp"
#include "sslam/io/evaluation/same_clock.hpp"

namespace sslam::cli {
namespace {

// Stamps that are too small to show their unit show it beside the others.
void bring_to_clock(const io::Trajectory& reference, io::Trajectory& poses, const std::string& file,
                    double max_difference, io::Warnings& warnings) {
  const io::StampUnit unit =
      io::unit_on_clock(io::stamps_of(reference), io::stamps_of(poses), max_difference);
  if (unit.is_seconds()) return;
  for (io::StampedPose& pose : poses) pose.stamp /= unit.per_second;
  warnings.push_back(file + ": " + io::unit_note(unit));
}

// Throws Error when one has stamps and the other has none.
io::Trajectory take_estimate(const std::string& file, const EvalSettings& settings, const TruthSource& truth,
                             io::Warnings& warnings) {
  settle_results(file);
  io::PoseFile estimate = load_estimate(file, warnings, settings.times);
  if (estimate.counted != truth.counted) {
    throw Error(
        (truth.counted ? settings.truth : file) +
        ": its poses have no stamps; put their times into times.txt beside it or name them with --times");
  }
  if (estimate.counted && estimate.trajectory.size() + estimate.no_pose < truth.trajectory.size()) {
    warnings.push_back(file +
                       ": has fewer rows than the ground truth, and neither has stamps: rows are compared "
                       "with those of the same number");
  }
  return std::move(estimate.trajectory);
}

// Both with stamps of one clock, as far as names, units and what was asked for tell.
EvalPair take_both(const std::string& file, const EvalSettings& settings, const EvalReference& reference,
                   io::Warnings& warnings) {
  EvalPair both;
  const std::optional<NamedPoses> named = find_named_poses(file);
  if (reference.named) {
    const NameClock clock = named ? clock_of_names(*reference.named) : image_clock(file);
    both.truth = stamped_poses(*reference.named, clock, settings.truth, warnings);
    TruthSource stamped;
    both.estimate = named ? stamped_poses(*named, clock, file, warnings)
                          : take_estimate(file, settings, stamped, warnings);
  } else {
    both.truth = reference.source.trajectory;
    both.estimate = named ? stamped_poses(*named, image_clock(settings.truth), file, warnings)
                          : take_estimate(file, settings, reference.source, warnings);
  }
  for (io::StampedPose& pose : both.estimate) pose.stamp += settings.offset;
  return both;
}

// Brings the estimate to the clock of the truth. Throws Error where the motions do not tell the offset.
io::TimeOffset bring_by_motion(const std::string& file, EvalPair& both) {
  const io::TimeOffset found = io::find_time_offset(both.truth, both.estimate);
  if (!found.problem.empty())
    throw Error(file + ": --find-offset: " + found.problem + "; give the offset with --offset");
  for (io::StampedPose& pose : both.estimate) pose.stamp += found.offset;
  return found;
}

}  // namespace

EvalReference load_reference(const EvalSettings& settings) {
  EvalReference reference;
  settle_results(settings.truth);
  reference.named = find_named_poses(settings.truth);
  if (!reference.named) reference.source = load_truth(settings.truth, settings.axes, settings.times);
  return reference;
}

EvalPair load_pair(const std::string& file, const EvalSettings& settings, const EvalReference& reference) {
  io::Warnings warnings;
  EvalPair both = take_both(file, settings, reference, warnings);
  bring_to_clock(both.truth, both.estimate, file, settings.options.max_difference, warnings);
  bring_to_clock(both.estimate, both.truth, settings.truth, settings.options.max_difference, warnings);
  print_warnings(warnings);
  if (settings.find_offset) both.offset = bring_by_motion(file, both);
  return both;
}

}  // namespace sslam::cli
