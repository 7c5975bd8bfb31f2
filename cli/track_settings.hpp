// SPDX-License-Identifier: BSD-3-Clause
// What the user may change about a preset.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "cli/frame_record.hpp"
#include "cli/frame_view.hpp"

namespace sslam::cli {

// Somebody who looks on: called with each frame once it is tracked, lost ones and all.
using FrameWatcher =
    std::function<void(const FrameRecord&, const FrameViewInput&, const TrackedFrame<double>&)>;

struct TrackSettings {
  std::vector<ParameterValue> overrides;  // of --set, in the units of --list-parameters
  std::uint64_t seed = 1;
  Map<double> map;              // of an earlier run, to go on in; empty: none
  std::size_t view_stride = 0;  // every n-th frame is kept for the report; 0: none
  FrameWatcher watcher;         // empty: none; wants a stream that keeps pictures
};

}  // namespace sslam::cli
