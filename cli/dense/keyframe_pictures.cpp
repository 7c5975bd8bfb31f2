// SPDX-License-Identifier: BSD-3-Clause
#include "cli/dense/keyframe_pictures.hpp"

#include <opencv2/imgcodecs.hpp>

namespace sslam::cli {

void KeyframePictures::note(const Frame<double>& frame, const cv::Mat& picture, const cv::Mat& normals,
                            const Pinhole<double>& normal_pinhole) {
  constexpr int kQuality = 95;
  if (picture.empty() || picture.depth() != CV_8U) return;
  KeyframePicture& kept = pictures_[{frame.index, frame.stamp}];
  cv::imencode(".jpg", picture, kept.image, {cv::IMWRITE_JPEG_QUALITY, kQuality});
  kept.colour = picture.channels() >= 3;
  kept.normal_pinhole = normal_pinhole;
  if (!normals.empty()) cv::imencode(".png", normals, kept.normals);
}

const KeyframePicture* KeyframePictures::of(const Keyframe<double>& keyframe) const {
  const auto found = pictures_.find({keyframe.frame.index, keyframe.frame.stamp});
  return found == pictures_.end() ? nullptr : &found->second;
}

}  // namespace sslam::cli
