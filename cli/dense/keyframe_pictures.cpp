// SPDX-License-Identifier: BSD-3-Clause
#include "cli/dense/keyframe_pictures.hpp"

#include <opencv2/imgcodecs.hpp>

namespace sslam::cli {

void KeyframePictures::note(const Frame<double>& frame, const cv::Mat& picture, const cv::Mat& mask) {
  constexpr int kQuality = 95;
  if (picture.empty() || picture.depth() != CV_8U) return;
  KeyframePicture& kept = pictures_[{frame.index, frame.stamp}];
  cv::imencode(".jpg", picture, kept.image, {cv::IMWRITE_JPEG_QUALITY, kQuality});
  kept.colour = picture.channels() >= 3;
  if (!mask.empty()) cv::imencode(".png", mask, kept.mask);
}

void KeyframePictures::note_normals(const Frame<double>& frame, const cv::Mat& normals,
                                    const Pinhole<double>& normal_pinhole) {
  const auto found = pictures_.find({frame.index, frame.stamp});
  if (found == pictures_.end() || normals.empty()) return;
  found->second.normal_pinhole = normal_pinhole;
  cv::imencode(".png", normals, found->second.normals);
}

const KeyframePicture* KeyframePictures::of(const Frame<double>& frame) const {
  const auto found = pictures_.find({frame.index, frame.stamp});
  return found == pictures_.end() ? nullptr : &found->second;
}

}  // namespace sslam::cli
