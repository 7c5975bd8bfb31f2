// SPDX-License-Identifier: BSD-3-Clause
// What a run keeps of each frame, and of the whole: the material of every file that `sslam run` writes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cli/results/calibration_record.hpp"
#include "cli/results/map_colours.hpp"
#include "cli/results/scale_record.hpp"
#include "sslam/io/trajectories/trajectory.hpp"
#include "sslam/map/map.hpp"
#include "sslam/system/engine.hpp"
#include "sslam/system/frame_report.hpp"

namespace sslam::cli {

struct DenseResult;

struct FrameRecord : FrameReport {
  std::string image;     // file name, for people
  bool bridged = false;  // its pose in the trajectory lies between two others', turned as its features say
};

struct RunOutcome {
  std::vector<FrameRecord> frames;
  io::Trajectory trajectory;  // by the keyframes' final poses, world from camera
  io::Trajectory keyframes;   // those that this run added to the map
  Map<double> map;
  MapColours colours;  // of the map's points and lines
  int world = 0;       // that the map is of
  MapsApart apart;
  std::vector<Parameter> parameters;
  std::vector<std::string> warnings;
  std::vector<std::string> views;        // frames as encode_frame_view gives them
  double wall_seconds = 0;               // of the whole run
  double processor_seconds = 0;          // the same of all threads
  double final_pass_seconds = 0;         // of it, what followed the last frame
  double read_out = 0;                   // seconds of a rolling shutter; 0: none is known
  int keyframes_not_made = 0;            // live: frames that mapping was too far behind for
  std::size_t frames_dropped = 0;        // of a stream: they came while the tracker was busy
  std::size_t stream_losses = 0;         // times that the stream broke and came back
  std::size_t frames_taken = 0;          // images that were asked for, also those that could not be read
  std::uint64_t checkpoints = 0;         // that were written
  double checkpoint_seconds = 0;         // what they took, of the whole run
  std::string checkpoint_problem;        // why there are no more; empty: nothing is wrong
  std::vector<std::int64_t> resumed_at;  // frames at which it went on after it had been stopped
  bool interrupted = false;
  std::shared_ptr<const DenseResult> dense;      // null where it was not asked for
  ScaleRecord scale;                             // its factor is in poses and map
  std::optional<CalibrationRecord> calibration;  // nothing where it was not to be looked at
};

}  // namespace sslam::cli
