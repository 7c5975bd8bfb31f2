// SPDX-License-Identifier: BSD-3-Clause
// Which image each keyframe of a run's map is of: the map knows numbers and stamps, frames.csv the names.
#pragma once

#include <string>
#include <vector>

#include "cli/results/run_folder.hpp"

namespace sslam::cli {

struct KeyframeImages {
  std::vector<std::string> names;     // by the keyframe's id
  std::vector<bool> known;            // whether frames.csv knows it
  std::vector<std::string> warnings;  // names that will not do
};

// A frame of the video v.mp4 has the name v_000012.png, and a keyframe that frames.csv does not know
// keyframe_000012.png.
[[nodiscard]] KeyframeImages keyframe_images(const RunFolder& run);

}  // namespace sslam::cli
