// SPDX-License-Identifier: BSD-3-Clause
#include "cli/results/run_health.hpp"

#include <sys/resource.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "cli/shell/messages.hpp"

namespace sslam::cli {
namespace {

using Json = nlohmann::ordered_json;

// Of this process since it began.
std::int64_t peak_memory() {
  rusage usage{};
  constexpr std::int64_t kUnit = 1024;  // bytes, on Linux
  return getrusage(RUSAGE_SELF, &usage) == 0 ? usage.ru_maxrss * kUnit : 0;
}

std::size_t skipped(const RunOutcome& outcome) {
  return outcome.frames_taken - std::min(outcome.frames_taken, outcome.frames.size());
}

// More than a tenth of the frames.
bool often_lost(const RunOutcome& outcome) {
  const auto lost = std::count_if(outcome.frames.begin(), outcome.frames.end(),
                                  [](const FrameRecord& frame) { return frame.state == State::kLost; });
  return 10 * static_cast<std::size_t>(lost) > outcome.frames.size();
}

bool has_normal_faults(const RunOutcome& outcome) {
  return std::any_of(outcome.frames.begin(), outcome.frames.end(), [](const FrameRecord& frame) {
    return frame.normal_status != NormalStatus::kOk && frame.normal_status != NormalStatus::kNoEvidence;
  });
}

bool is_contradicted(const std::optional<CalibrationRecord>& calibration) {
  return calibration && calibration->last.verdict == CameraVerdict::kDiffers && !calibration->replaced;
}

Json reasons_json(const RunOutcome& outcome) {
  const std::pair<const char*, bool> known[] = {
      {"interrupted", outcome.interrupted},
      {"resumed", !outcome.resumed_at.empty()},
      {"frames dropped", outcome.frames_dropped > 0},
      {"stream lost", outcome.stream_losses > 0},
      {"frames skipped", skipped(outcome) > 0},
      {"track lost", often_lost(outcome)},
      {"maps apart", outcome.apart.maps > 0},
      {"mapping behind", outcome.keyframes_not_made > 0},
      {"normals unusable", has_normal_faults(outcome)},
      {"calibration contradicted", is_contradicted(outcome.calibration)},
      {"scale not found", !outcome.scale.problem.empty()},
      {"no checkpoints", !outcome.checkpoint_problem.empty()},
  };
  Json reasons = Json::array();
  for (const auto& [reason, holds] : known)
    if (holds) reasons.push_back(reason);
  return reasons;
}

Json warnings_json(const RunOutcome& outcome) {
  Json warnings = Json::array();
  for (const WarningKind& kind : kinds_of(outcome.warnings))
    warnings.push_back({{"text", *kind.first}, {"count", kind.count}});
  return warnings;
}

}  // namespace

Json health_json(const RunOutcome& outcome) {
  const Json reasons = reasons_json(outcome);
  return {{"degraded", !reasons.empty()},       {"reasons", reasons},
          {"frames", outcome.frames.size()},    {"frames_dropped", outcome.frames_dropped},
          {"frames_skipped", skipped(outcome)}, {"warnings", warnings_json(outcome)},
          {"peak_memory_bytes", peak_memory()}};
}

}  // namespace sslam::cli
