// SPDX-License-Identifier: BSD-3-Clause
// What the front end takes in for one frame: the image, and whatever else a normal source may want.
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <string>
#include <utility>

namespace sslam {

struct ImageInput {
  std::int64_t index = -1;     // position in the dataset
  double stamp = 0;            // seconds
  std::string name;            // of the image file, without folder and extension: finds stored normals
  cv::Mat image;               // 8 bit: grey, BGR or BGRA
  cv::Mat mask;                // 8 bit, of the image's size; 0: no points and lines there; empty: all is used
  cv::Mat depth;               // registered to the image; 16 bit or float; 0: no measurement; empty: none
  double depth_factor = 5000;  // value of one metre in a 16 bit depth image; float depth is in metres
};

// The same in pixels of its own, into buffers that serve again.
inline void keep_copy(const ImageInput& from, ImageInput& to) {
  cv::Mat image = std::move(to.image), mask = std::move(to.mask), depth = std::move(to.depth);
  from.image.copyTo(image);
  from.mask.copyTo(mask);
  from.depth.copyTo(depth);
  to = {from.index, from.stamp, from.name, image, mask, depth, from.depth_factor};
}

}  // namespace sslam
