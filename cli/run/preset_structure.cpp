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
  return parameters_of(make_pipeline<Pipeline>(false));
}

RunOutcome run_structure(FrameStream& stream, const TrackSettings& settings, Progress& progress) {
  return run_pipeline<Pipeline>(stream, settings, progress);
}

RunOutcome run_lines(FrameStream& stream, const TrackSettings& settings, Progress& progress) {
  return run_pipeline<Pipeline>(stream, settings, progress, false);
}

}  // namespace sslam::cli
