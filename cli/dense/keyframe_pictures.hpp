// SPDX-License-Identifier: BSD-3-Clause
// The images of keyframes, packed, for what is made of them once the map is finished.
#pragma once

#include <cstdint>
#include <map>
#include <opencv2/core.hpp>
#include <utility>
#include <vector>

#include "sslam/map/keyframe.hpp"

namespace sslam::cli {

struct KeyframePicture {
  std::vector<unsigned char> image;    // JPEG, as the lens made it, of the size that is worked on
  bool colour = false;                 // it has three channels
  std::vector<unsigned char> mask;     // PNG of the same size: 0 where it is no world; empty: all is used
  std::vector<unsigned char> normals;  // PNG, as small_normal_picture has them; empty: none
  Pinhole<double> normal_pinhole;      // of their pixels
};

class KeyframePictures {
 public:
  // `mask` may be empty. A picture that is none is not noted.
  void note(const Frame<double>& frame, const cv::Mat& picture, const cv::Mat& mask);
  // Of a frame whose picture has been noted; they may be empty.
  void note_normals(const Frame<double>& frame, const cv::Mat& normals,
                    const Pinhole<double>& normal_pinhole);

  // Null where none was noted.
  [[nodiscard]] const KeyframePicture* of(const Frame<double>& frame) const;

 private:
  std::map<std::pair<std::int64_t, double>, KeyframePicture> pictures_;  // by index and stamp of the frame
};

}  // namespace sslam::cli
