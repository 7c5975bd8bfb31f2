// SPDX-License-Identifier: BSD-3-Clause
// What the user may change about a preset.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "cli/frame_record.hpp"

namespace sslam::cli {

struct TrackSettings {
  std::vector<ParameterValue> overrides;  // of --set, in the units of --list-parameters
  std::uint64_t seed = 1;
  Map<double> map;              // of an earlier run, to go on in; empty: none
  std::size_t view_stride = 0;  // every n-th frame is kept for the report; 0: none
};

}  // namespace sslam::cli
