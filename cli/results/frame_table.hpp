// SPDX-License-Identifier: BSD-3-Clause
// The rows of frames.csv.
#pragma once

#include <string>
#include <vector>

#include "cli/results/frame_record.hpp"

namespace sslam::cli {

[[nodiscard]] std::vector<std::string> frame_columns();
[[nodiscard]] std::vector<std::string> frame_cells(const FrameRecord& frame);  // one for each column

}  // namespace sslam::cli
