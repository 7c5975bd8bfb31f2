// SPDX-License-Identifier: BSD-3-Clause
// The views of a board in a set of images or in a video: those in which it was found, and no two alike.
#pragma once

#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "cli/calibrate/board.hpp"
#include "cli/shell/progress.hpp"
#include "sslam/io/datasets/dataset.hpp"

namespace sslam::cli {

struct BoardViews {
  std::vector<BoardView> views;
  cv::Size size;                        // of the images
  std::size_t searched = 0;             // images
  std::size_t without = 0;              // of them, without a board
  std::size_t alike = 0;                // of them, with the board where an earlier one has it
  std::vector<std::string> unreadable;  // a line each
};

// Throws Error when the images are not of one size, or none shows the board.
[[nodiscard]] BoardViews find_views(const io::Dataset& dataset, const Board& board, Verbosity verbosity);

}  // namespace sslam::cli
