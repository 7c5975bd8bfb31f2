// SPDX-License-Identifier: BSD-3-Clause
// What a System answers to one image: its pose and how it came about, what was found in the image, and what
// each stage took.
#pragma once

#include <array>

#include "sslam/opencv/normals/normal_source.hpp"
#include "sslam/system/input_status.hpp"
#include "sslam/track/contract/normal_need.hpp"
#include "sslam/track/contract/result.hpp"
#include "sslam/track/contract/stage_timer.hpp"

namespace sslam {

// One for each frame of a run, however long it is: times are floats, in milliseconds of wall clock.
struct FrameReport : TrackResult<double> {
  InputStatus input = InputStatus::kOk;
  int points = 0, lines = 0, normals = 0;           // features found
  NormalNeed normal_need = NormalNeed::kNotNeeded;  // why normals were looked for; kNotNeeded: they were not
  NormalStatus normal_status = NormalStatus::kOk;
  std::array<float, kStageCount> stage_ms{};  // of the tracker's stages
  float points_ms = 0, lines_ms = 0, normals_ms = 0;
  float extraction_ms = 0;  // of the front end, with normals that were asked for
  float tracking_ms = 0;    // of the tracker

  [[nodiscard]] float frame_ms() const noexcept { return extraction_ms + tracking_ms; }
};

}  // namespace sslam
