// SPDX-License-Identifier: BSD-3-Clause
#include "cli/presets.hpp"
#include "cli/stages.hpp"
#include "cli/track_sequence.hpp"

namespace sslam::cli {

RunOutcome run_odometry(FrameStream& stream, const TrackSettings& settings, Progress& progress) {
  presets::Odometry<double, LocalBundleAdjustment, WallTimer> pipeline;
  return track_sequence(pipeline, stream, settings, progress);
}

}  // namespace sslam::cli
