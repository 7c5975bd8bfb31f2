// SPDX-License-Identifier: BSD-3-Clause
#include "cli/run/kernels.hpp"
#include "cli/run/presets.hpp"
#include "cli/run/track_sequence.hpp"

namespace sslam::cli {

ParameterTable features_parameters() {
  return parameters_of(presets::Features<double, WallTimer>());
}

RunOutcome run_features(FrameStream& stream, const TrackSettings& settings, Progress& progress) {
  presets::Features<double, WallTimer> pipeline;
  return track_sequence(pipeline, stream, settings, progress);
}

}  // namespace sslam::cli
