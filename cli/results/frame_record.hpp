// SPDX-License-Identifier: BSD-3-Clause
// What a run keeps of each frame, and of the whole: the material of every file that `sslam run` writes.
#pragma once

#include <array>
#include <chrono>
#include <string>
#include <vector>

#include "sslam/core/parameter_table.hpp"
#include "sslam/io/trajectories/trajectory.hpp"
#include "sslam/map/map.hpp"
#include "sslam/opencv/normals/normal_source.hpp"
#include "sslam/track/contract/result.hpp"
#include "sslam/track/contract/stage_timer.hpp"

namespace sslam::cli {

// A StageTimer by the steady clock, in milliseconds.
class WallTimer {
 public:
  void begin() noexcept {
    milliseconds.fill(0);
    start_ = last_ = Clock::now();
  }
  void end(Stage stage) noexcept {
    const auto now = Clock::now();
    milliseconds[static_cast<std::size_t>(stage)] +=
        std::chrono::duration<float, std::milli>(now - last_).count();
    last_ = now;
  }
  [[nodiscard]] float total() const noexcept {
    return std::chrono::duration<float, std::milli>(Clock::now() - start_).count();
  }

  std::array<float, kStageCount> milliseconds{};

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point start_{}, last_{};
};
static_assert(StageTimer<WallTimer>);

// One for each frame of the run, however long it is: times are floats.
struct FrameRecord {
  TrackResult<double> result;
  std::string image;                       // file name, for people
  int points = 0, lines = 0, normals = 0;  // features found
  NormalStatus normal_status = NormalStatus::kOk;
  std::array<float, kStageCount> stage_ms{};  // of the tracker's stages
  float points_ms = 0, lines_ms = 0, normals_ms = 0;
  float extraction_ms = 0;  // wall clock of the front end
  float tracking_ms = 0;    // wall clock of the tracker

  [[nodiscard]] float frame_ms() const noexcept { return extraction_ms + tracking_ms; }
};

struct RunOutcome {
  std::vector<FrameRecord> frames;
  io::Trajectory trajectory;  // by the keyframes' final poses, world from camera
  io::Trajectory keyframes;   // those that this run added to the map
  Map<double> map;
  int world = 0;                 // that the map is of
  std::size_t maps_apart = 0;    // that were left, and never joined with this one
  std::size_t frames_apart = 0;  // that were tracked in them
  std::vector<Parameter> parameters;
  std::vector<std::string> warnings;
  std::vector<std::string> views;  // frames as encode_frame_view gives them
  double wall_seconds = 0;         // of the whole loop
  int keyframes_not_made = 0;      // live: frames that mapping was too far behind for
  bool interrupted = false;
};

}  // namespace sslam::cli
