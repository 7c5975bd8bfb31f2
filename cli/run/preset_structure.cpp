// SPDX-License-Identifier: BSD-3-Clause
#include "cli/run/kernels.hpp"
#include "cli/run/presets.hpp"
#include "cli/run/track_sequence.hpp"

namespace sslam::cli {
namespace {

using Pipeline = presets::Structure<double, WallTimer>;

}  // namespace

ParameterTable structure_parameters() {
  return parameters_of(Pipeline());
}

ParameterTable lines_parameters() {
  Pipeline pipeline;
  pipeline.mapping.creation.options.use_points = false;
  return parameters_of(pipeline);
}

RunOutcome run_structure(FrameStream& stream, const TrackSettings& settings, Progress& progress) {
  return run_pipeline<Pipeline>(stream, settings, progress);
}

RunOutcome run_lines(FrameStream& stream, const TrackSettings& settings, Progress& progress) {
  return run_pipeline<Pipeline>(stream, settings, progress, false);
}

}  // namespace sslam::cli
