// SPDX-License-Identifier: BSD-3-Clause
// What the user may change about a preset.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "cli/results/frame_record.hpp"
#include "cli/results/frame_view.hpp"
#include "sslam/track/worlds/trajectory_log.hpp"

namespace sslam::cli {

// A frame that was just tracked, and the run as it stands then.
struct WatchedFrame {
  const FrameRecord& record;
  const FrameViewInput& view;
  const TrackedFrame<double>& frame;
  const Map<double>& map;
  const TrajectoryLog<double>& trajectory;
};

// Somebody who looks on: called with each frame once it is tracked, lost ones and all.
using FrameWatcher = std::function<void(const WatchedFrame&)>;

struct TrackSettings {
  ParameterTable parameters;  // with what --set changes
  std::uint64_t seed = 1;
  Map<double> map;                     // of an earlier run, to go on in; empty: none
  std::size_t view_stride = 0;         // every n-th frame is kept for the report; 0: none
  std::vector<FrameWatcher> watchers;  // want a stream that keeps pictures
};

}  // namespace sslam::cli
