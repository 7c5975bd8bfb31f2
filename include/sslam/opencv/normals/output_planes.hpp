// SPDX-License-Identifier: BSD-3-Clause
// The channels of a network's output, in whatever order its axes come.
#pragma once

#include <cstddef>
#include <opencv2/core.hpp>
#include <vector>

namespace sslam {

// Of NCHW, NHWC, CHW, HWC and, for one channel, HW; a batch is of one image. Planes share the memory of
// `blob` but for those that are mixed pixel by pixel. Empty where the output has no such shape.
[[nodiscard]] inline std::vector<cv::Mat_<float>> output_planes(const cv::Mat& blob, std::size_t channels) {
  if (blob.type() != CV_32F) return {};
  std::vector<int> size(blob.size.p, blob.size.p + blob.dims);
  if (size.size() == 4 && size.front() == 1) size.erase(size.begin());
  const int count = static_cast<int>(channels);
  if (size.size() == 2 && count == 1) size.insert(size.begin(), 1);
  if (size.size() != 3) return {};
  auto* const values = const_cast<float*>(blob.ptr<float>());  // cv::Mat knows no constant memory
  std::vector<cv::Mat_<float>> planes;
  if (size[0] == count) {
    const std::size_t area = static_cast<std::size_t>(size[1]) * static_cast<std::size_t>(size[2]);
    for (std::size_t c = 0; c < channels; ++c) planes.emplace_back(size[1], size[2], values + c * area);
  } else if (size[2] == count) {
    cv::split(cv::Mat(size[0], size[1], CV_32FC(count), values), planes);
  }
  return planes;
}

}  // namespace sslam
