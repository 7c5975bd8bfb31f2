// SPDX-License-Identifier: BSD-3-Clause
#include "cli/kernels.hpp"
#include "cli/presets.hpp"
#include "cli/track_sequence.hpp"

namespace sslam::cli {

RunOutcome run_paper(FrameStream& stream, const TrackSettings& settings, Progress& progress) {
  presets::Paper<double, WallTimer> pipeline;
  return track_sequence(pipeline, stream, settings, progress);
}

}  // namespace sslam::cli
