// SPDX-License-Identifier: BSD-3-Clause
#include "cli/kernels.hpp"
#include "cli/presets.hpp"
#include "cli/track_sequence.hpp"
#include "sslam/live/mapping_thread.hpp"

namespace sslam::cli {
namespace {

using Pipeline = live::Structure<double, WallTimer>;

}  // namespace

RunOutcome run_structure_live(FrameStream& stream, const TrackSettings& settings, Progress& progress) {
  Pipeline pipeline;
  return track_sequence(pipeline, stream, settings, progress);
}

RunOutcome run_lines_live(FrameStream& stream, const TrackSettings& settings, Progress& progress) {
  Pipeline pipeline;
  pipeline.mapping.creation.options.use_points = false;
  return track_sequence(pipeline, stream, settings, progress);
}

}  // namespace sslam::cli
