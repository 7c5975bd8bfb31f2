// SPDX-License-Identifier: BSD-3-Clause
#include <cstdio>
#include <string>

#include "cli/run/kernels.hpp"
#include "cli/run/presets.hpp"
#include "cli/run/track_sequence.hpp"

namespace sslam::cli {
namespace {

using Pipeline = presets::Structure<double, WallTimer>;

}  // namespace

std::string describe_parameters() {
  Pipeline pipeline;
  std::string text;
  visit_parameters(pipeline, [&](const char* name, const auto& value, Unit unit, const char* meaning) {
    const bool angle = unit == Unit::kDegrees;
    char line[256];
    std::snprintf(line, sizeof line, "%-34s %8g %-7s %s\n", name,
                  static_cast<double>(value) * (angle ? detail::kDegreesPerRadian : 1),
                  angle ? "degrees" : (unit == Unit::kPixels ? "pixels" : ""), meaning);
    text += line;
  });
  return text;
}

RunOutcome run_structure(FrameStream& stream, const TrackSettings& settings, Progress& progress) {
  return run_pipeline<Pipeline>(stream, settings, progress);
}

RunOutcome run_lines(FrameStream& stream, const TrackSettings& settings, Progress& progress) {
  return run_pipeline<Pipeline>(stream, settings, progress, false);
}

}  // namespace sslam::cli
