// SPDX-License-Identifier: BSD-3-Clause
// Photographs of a calibration board by a camera that is known.
#pragma once

#include <cmath>
#include <opencv2/aruco/charuco.hpp>
#include <opencv2/calib3d.hpp>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "support/fisheye_room.hpp"

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

inline constexpr int kFine = 2;  // rays a pixel, in each direction

// Where the rays of an image begin, row by row.
[[nodiscard]] inline std::vector<cv::Point2d> fine_pixels(cv::Size size) {
  std::vector<cv::Point2d> pixels;
  for (int y = 0; y < size.height * kFine; ++y)
    for (int x = 0; x < size.width * kFine; ++x)
      pixels.emplace_back((x + 0.5) / kFine - 0.5, (y + 0.5) / kFine - 0.5);
  return pixels;
}

// The board's middle lies at `middle` in camera axes; the rotation turns it about that, as a Rodrigues
// vector. Each pixel is the mean of its rays; one that is zero, or that meets the board's plane behind the
// camera, sees nothing.
[[nodiscard]] inline cv::Mat seen_by(const std::vector<cv::Vec3d>& rays, cv::Size size,
                                     const BoardPicture& board, const cv::Vec3d& turn,
                                     const cv::Vec3d& middle) {
  cv::Matx33d rotation;
  cv::Rodrigues(turn, rotation);
  const cv::Vec3d across(rotation.col(0).val), down(rotation.col(1).val), normal(rotation.col(2).val);
  const cv::Point2d picture_middle(0.5 * (board.image.cols - 1), 0.5 * (board.image.rows - 1));
  cv::Mat map(size.height * kFine, size.width * kFine, CV_32FC2, cv::Scalar(-1e4, -1e4));
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const double along = middle.dot(normal) / rays[i].dot(normal);
    if (!(along > 0) || !std::isfinite(along)) continue;
    const cv::Vec3d on_board = rays[i] * along - middle;
    const cv::Point2d at =
        picture_middle + board.pixels_per_metre * cv::Point2d(on_board.dot(across), on_board.dot(down));
    map.at<cv::Vec2f>(static_cast<int>(i) / map.cols, static_cast<int>(i) % map.cols) = cv::Point2f(at);
  }
  cv::Mat fine, image;
  cv::remap(board.image, fine, map, cv::noArray(), cv::INTER_LINEAR, cv::BORDER_CONSTANT, cv::Scalar(120));
  cv::resize(fine, image, size, 0, 0, cv::INTER_AREA);
  return image;
}

// Of a pinhole with its lens: for seen_by. They take longer than an image, so tests share them.
[[nodiscard]] inline std::vector<cv::Vec3d> lens_rays(const TrueCamera& camera) {
  std::vector<cv::Point2d> straight;
  cv::undistortPoints(fine_pixels(camera.size), straight, camera.matrix(), camera.lens, cv::noArray(),
                      cv::noArray(),
                      cv::TermCriteria(cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 40, 1e-9));
  std::vector<cv::Vec3d> rays;
  for (const cv::Point2d& ray : straight) rays.emplace_back(ray.x, ray.y, 1);
  return rays;
}

// Of a fisheye, as far as 85 degrees off its axis: for seen_by.
[[nodiscard]] inline std::vector<cv::Vec3d> fisheye_rays(const WideLens& lens) {
  std::vector<cv::Vec3d> rays;
  const double oblong = lens.pinhole.fx / lens.pinhole.fy;
  for (const cv::Point2d& pixel : fine_pixels({lens.width, lens.height})) {
    const cv::Point2d out(pixel.x - lens.pinhole.cx, (pixel.y - lens.pinhole.cy) * oblong);
    const double radius = cv::norm(out), angle = angle_at(lens, radius, radians(85.0));
    const bool seen = radius > 0 && angle < radians(84.9);
    const double share = seen ? std::sin(angle) / radius : 0;
    rays.push_back(seen ? cv::Vec3d(out.x * share, out.y * share, std::cos(angle)) : cv::Vec3d());
  }
  return rays;
}

}  // namespace sslam::testing
