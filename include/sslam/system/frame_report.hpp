// SPDX-License-Identifier: BSD-3-Clause
// The result of a System for one image: the pose and how it was found, the features of the image, and the
// time of each stage.
#pragma once

#include <array>

#include "sslam/opencv/normals/normal_source.hpp"
#include "sslam/system/input_status.hpp"
#include "sslam/track/contract/normal_need.hpp"
#include "sslam/track/contract/result.hpp"
#include "sslam/track/contract/stage_timer.hpp"

namespace sslam {

// A run keeps one for each frame, so it is small: times are floats, in milliseconds of wall clock.
struct FrameReport : TrackResult<double> {
  InputStatus input = InputStatus::kOk;
  int points = 0, lines = 0, normals = 0;           // features found
  NormalNeed normal_need = NormalNeed::kNotNeeded;  // why normals were computed; kNotNeeded: they were not
  NormalStatus normal_status = NormalStatus::kOk;
  std::array<float, kStageCount> stage_ms{};  // of the tracker's stages
  float points_ms = 0, lines_ms = 0, normals_ms = 0;
  float extraction_ms = 0;  // of the front end, with normals on demand
  float tracking_ms = 0;    // of the tracker

  [[nodiscard]] float frame_ms() const noexcept { return extraction_ms + tracking_ms; }
};

}  // namespace sslam
