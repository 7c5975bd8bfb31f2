// SPDX-License-Identifier: BSD-3-Clause
// The named presets of `sslam run`. Each is one instantiation of the pipeline, compiled in a file of its own.
#pragma once

#include <array>
#include <string>
#include <string_view>

#include "cli/input/frame_stream.hpp"
#include "cli/results/frame_record.hpp"
#include "cli/run/track_settings.hpp"
#include "cli/shell/progress.hpp"

namespace sslam::cli {

[[nodiscard]] RunOutcome run_structure(FrameStream&, const TrackSettings&,
                                       Progress&);                                  // preset_structure.cpp
[[nodiscard]] RunOutcome run_lines(FrameStream&, const TrackSettings&, Progress&);  // preset_structure.cpp
[[nodiscard]] RunOutcome run_structure_live(FrameStream&, const TrackSettings&,
                                            Progress&);                                  // preset_live.cpp
[[nodiscard]] RunOutcome run_lines_live(FrameStream&, const TrackSettings&, Progress&);  // preset_live.cpp
[[nodiscard]] RunOutcome run_paper(FrameStream&, const TrackSettings&, Progress&);       // preset_paper.cpp
[[nodiscard]] RunOutcome run_features(FrameStream&, const TrackSettings&, Progress&);  // preset_features.cpp
[[nodiscard]] RunOutcome run_odometry(FrameStream&, const TrackSettings&, Progress&);  // preset_odometry.cpp

// Of each preset's pipeline, none of them set; beside its run.
[[nodiscard]] ParameterTable structure_parameters();
[[nodiscard]] ParameterTable lines_parameters();
[[nodiscard]] ParameterTable paper_parameters();
[[nodiscard]] ParameterTable features_parameters();
[[nodiscard]] ParameterTable odometry_parameters();

struct Preset {
  std::string_view name;
  std::string_view meaning;
  bool use_points;
  bool use_lines;
  bool use_normals;
  ParameterTable (*parameters)();
  RunOutcome (*run)(FrameStream&, const TrackSettings&, Progress&);
  RunOutcome (*run_live)(FrameStream&, const TrackSettings&, Progress&) = nullptr;  // with --live, if it can
};

inline constexpr std::array<Preset, 6> kPresets{{
    {"structure", "Manhattan rotation, points and lines, local bundle adjustment", true, true, true,
     structure_parameters, run_structure, run_structure_live},
    {"paper", "the same without bundle adjustment, as published", true, true, true, paper_parameters,
     run_paper},
    {"points", "Manhattan rotation from normals, points alone", true, false, true, structure_parameters,
     run_structure, run_structure_live},
    {"lines", "Manhattan rotation, lines, and no points but those that start the map", true, true, true,
     lines_parameters, run_lines, run_lines_live},
    {"features", "no Manhattan world: points and lines, six degrees of freedom", true, true, false,
     features_parameters, run_features},
    {"odometry", "frame to frame, no refinement against the local map", true, true, true, odometry_parameters,
     run_odometry},
}};

}  // namespace sslam::cli
