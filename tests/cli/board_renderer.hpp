// SPDX-License-Identifier: BSD-3-Clause
// Photographs of a calibration board by a camera that is known.
#pragma once

#include <opencv2/aruco/charuco.hpp>
#include <opencv2/calib3d.hpp>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

namespace sslam::testing {

// A picture of a board in its plane, with its scale.
struct BoardPicture {
  cv::Mat image;
  double pixels_per_metre = 0;
};

// columns x rows inner corners.
[[nodiscard]] inline BoardPicture chessboard_picture(int columns, int rows, double square) {
  constexpr int kPixels = 60;  // a square
  cv::Mat image((rows + 3) * kPixels, (columns + 3) * kPixels, CV_8UC1, cv::Scalar(235));
  for (int row = 0; row <= rows; ++row)
    for (int column = 0; column <= columns; ++column)
      if ((row + column) % 2 == 0)
        image(cv::Rect((column + 1) * kPixels, (row + 1) * kPixels, kPixels, kPixels)).setTo(25);
  return {image, kPixels / square};
}

// columns x rows squares.
[[nodiscard]] inline BoardPicture charuco_picture(int columns, int rows, double square) {
  constexpr int kPixels = 80, kMargin = 80;
  const auto board = cv::aruco::CharucoBoard::create(
      columns, rows, static_cast<float>(square), static_cast<float>(0.75 * square),
      cv::aruco::getPredefinedDictionary(cv::aruco::DICT_4X4_50));
  cv::Mat image;
  board->draw({columns * kPixels + 2 * kMargin, rows * kPixels + 2 * kMargin}, image, kMargin);
  return {image, kPixels / square};
}

struct TrueCamera {
  cv::Size size{640, 480};
  double fx = 520, fy = 515, cx = 330.5, cy = 236.0;
  cv::Mat_<double> lens = (cv::Mat_<double>(1, 5) << -0.12, 0.05, 0.0008, -0.0006, 0);

  [[nodiscard]] cv::Mat_<double> matrix() const {
    return (cv::Mat_<double>(3, 3) << fx, 0, cx, 0, fy, cy, 0, 0, 1);
  }
};

// The board's middle lies at `middle` in camera axes; the rotation turns it about that, as a Rodrigues
// vector. Each pixel is the mean of four rays.
[[nodiscard]] inline cv::Mat photograph(const TrueCamera& camera, const BoardPicture& board,
                                        const cv::Vec3d& turn, const cv::Vec3d& middle) {
  constexpr int kFine = 2;
  std::vector<cv::Point2d> pixels, rays;
  for (int y = 0; y < camera.size.height * kFine; ++y)
    for (int x = 0; x < camera.size.width * kFine; ++x)
      pixels.emplace_back((x + 0.5) / kFine - 0.5, (y + 0.5) / kFine - 0.5);
  cv::undistortPoints(pixels, rays, camera.matrix(), camera.lens, cv::noArray(), cv::noArray(),
                      cv::TermCriteria(cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 40, 1e-9));
  cv::Matx33d rotation;
  cv::Rodrigues(turn, rotation);
  const cv::Vec3d across(rotation.col(0).val), down(rotation.col(1).val), normal(rotation.col(2).val);
  const cv::Point2d picture_middle(0.5 * (board.image.cols - 1), 0.5 * (board.image.rows - 1));
  cv::Mat map(camera.size.height * kFine, camera.size.width * kFine, CV_32FC2);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const cv::Vec3d ray(rays[i].x, rays[i].y, 1);
    const cv::Vec3d on_board = ray * (middle.dot(normal) / ray.dot(normal)) - middle;
    const cv::Point2d at =
        picture_middle + board.pixels_per_metre * cv::Point2d(on_board.dot(across), on_board.dot(down));
    map.at<cv::Vec2f>(static_cast<int>(i) / map.cols, static_cast<int>(i) % map.cols) = cv::Point2f(at);
  }
  cv::Mat fine, image;
  cv::remap(board.image, fine, map, cv::noArray(), cv::INTER_LINEAR, cv::BORDER_CONSTANT, cv::Scalar(120));
  cv::resize(fine, image, camera.size, 0, 0, cv::INTER_AREA);
  return image;
}

}  // namespace sslam::testing
