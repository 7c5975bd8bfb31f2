// SPDX-License-Identifier: BSD-3-Clause
#include "cli/kernels.hpp"
#include "cli/presets.hpp"
#include "cli/track_sequence.hpp"

namespace sslam::cli {

RunOutcome run_features(FrameStream& stream, const TrackSettings& settings, Progress& progress) {
  presets::Features<double, WallTimer> pipeline;
  return track_sequence(pipeline, stream, settings, progress);
}

}  // namespace sslam::cli
