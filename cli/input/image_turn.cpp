// SPDX-License-Identifier: BSD-3-Clause
#include "cli/input/image_turn.hpp"

namespace sslam::cli {

cv::Size turned_size(cv::Size stored, ImageTurn turn) {
  return swaps_sides(turn) ? cv::Size(stored.height, stored.width) : stored;
}

cv::Mat turned_image(const cv::Mat& stored, ImageTurn turn) {
  cv::Mat image;
  switch (turn) {
    case 2:
      cv::flip(stored, image, 1);
      break;
    case 3:
      cv::rotate(stored, image, cv::ROTATE_180);
      break;
    case 4:
      cv::flip(stored, image, 0);
      break;
    case 5:
      cv::transpose(stored, image);
      break;
    case 6:
      cv::rotate(stored, image, cv::ROTATE_90_CLOCKWISE);
      break;
    case 7:
      cv::transpose(stored, image);
      cv::rotate(image, image, cv::ROTATE_180);
      break;
    case 8:
      cv::rotate(stored, image, cv::ROTATE_90_COUNTERCLOCKWISE);
      break;
    default:
      return stored;
  }
  return image;
}

const char* turn_text(ImageTurn turn) {
  switch (turn) {
    case 2:
      return "mirrored left to right";
    case 3:
      return "turned by 180 degrees";
    case 4:
      return "mirrored top to bottom";
    case 5:
      return "mirrored and turned by 270 degrees clockwise";
    case 6:
      return "turned by 90 degrees clockwise";
    case 7:
      return "mirrored and turned by 90 degrees clockwise";
    case 8:
      return "turned by 270 degrees clockwise";
    default:
      return "upright";
  }
}

}  // namespace sslam::cli
