// SPDX-License-Identifier: BSD-3-Clause
// A printed calibration board, and where its corners are in an image.
#pragma once

#include <opencv2/aruco/charuco.hpp>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

namespace sslam::cli {

enum class Pattern { kChessboard, kCharuco };

struct BoardSettings {
  Pattern pattern = Pattern::kChessboard;
  int columns = 9, rows = 6;  // chessboard: inner corners; ChArUco: squares
  double square = 0.025;      // side of a square, metres
  double marker = 0;          // side of a marker, metres; 0: three quarters of the square
  std::string dictionary = "4x4_50";
};

// Corners of one image; board and image points belong together.
struct BoardView {
  std::string name;  // of the image
  std::vector<cv::Point3f> board;
  std::vector<cv::Point2f> image;
};

// Names of dictionaries, separated by commas.
[[nodiscard]] std::string dictionary_names();

class Board {
 public:
  // Throws Error when the settings make no board.
  explicit Board(const BoardSettings& settings);

  // Corners in an 8 bit grey image; too few are none.
  [[nodiscard]] BoardView find(const cv::Mat& grey) const;

  // Where find() has found nothing: what else may be there, as a remark to end a line with; empty: nothing
  // either.
  [[nodiscard]] std::string what_else(const cv::Mat& grey) const;

  [[nodiscard]] const BoardSettings& settings() const noexcept { return settings_; }
  // Of a chessboard: none.
  [[nodiscard]] const cv::Ptr<cv::aruco::CharucoBoard>& charuco() const noexcept { return charuco_; }

  // "9x6 inner corners" or "9x6 squares"
  [[nodiscard]] std::string text() const;

 private:
  [[nodiscard]] BoardView find_chessboard(const cv::Mat& grey) const;
  [[nodiscard]] BoardView find_charuco(const cv::Mat& grey) const;
  [[nodiscard]] std::string other_chessboard(const cv::Mat& grey) const;
  [[nodiscard]] std::string other_markers(const cv::Mat& grey) const;

  BoardSettings settings_;
  cv::Ptr<cv::aruco::CharucoBoard> charuco_;
};

}  // namespace sslam::cli
