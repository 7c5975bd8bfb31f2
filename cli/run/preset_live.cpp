// SPDX-License-Identifier: BSD-3-Clause
#include "cli/run/kernels.hpp"
#include "cli/run/presets.hpp"
#include "cli/run/track_sequence.hpp"
#include "sslam/live/mapping_thread.hpp"

namespace sslam::cli {
namespace {

using Pipeline = live::Structure<double, WallTimer>;

}  // namespace

RunOutcome run_structure_live(FrameStream& stream, const TrackSettings& settings, Progress& progress) {
  return run_pipeline<Pipeline>(stream, settings, progress);
}

RunOutcome run_lines_live(FrameStream& stream, const TrackSettings& settings, Progress& progress) {
  return run_pipeline<Pipeline>(stream, settings, progress, false);
}

}  // namespace sslam::cli
