// SPDX-License-Identifier: BSD-3-Clause
// Between numpy's images and OpenCV's.
#pragma once

#include <cstdint>
#include <memory>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "bindings/arrays.hpp"
#include "sslam/core/error.hpp"

namespace sslam::python {

using PixelArray = nb::ndarray<nb::ro, nb::device::cpu>;

[[nodiscard]] inline int type_of(const nb::dlpack::dtype& type, int channels) {
  if (type == nb::dtype<std::uint8_t>()) return CV_8UC(channels);
  if (type == nb::dtype<std::uint16_t>()) return CV_16UC(channels);
  if (type == nb::dtype<float>()) return CV_32FC(channels);
  throw nb::type_error("array: expected uint8, uint16 or float32");
}

// The caller's pixels, (H, W) or (H, W, C): rows may have gaps between them, pixels and channels may not.
[[nodiscard]] inline cv::Mat mat_of(const std::optional<PixelArray>& array) {
  if (!array) return {};
  const int channels = array->ndim() == 3 ? static_cast<int>(array->shape(2)) : 1;
  const bool close = (array->ndim() == 2 || (array->ndim() == 3 && array->stride(2) == 1)) &&
                     array->stride(1) == channels &&
                     array->stride(0) >= static_cast<std::int64_t>(array->shape(1)) * channels;
  if (!close) throw nb::value_error("array: expected rows of pixels without gaps between them");
  // OpenCV takes no pointer to const; nothing writes through this one.
  auto* const pixels = const_cast<void*>(static_cast<const void*>(array->data()));
  return cv::Mat(static_cast<int>(array->shape(0)), static_cast<int>(array->shape(1)),
                 type_of(array->dtype(), channels), pixels,
                 static_cast<std::size_t>(array->stride(0)) * array->itemsize());
}

// In OpenCV's order of channels; the image itself where it is not in another.
[[nodiscard]] inline cv::Mat bgr_of(const cv::Mat& image, bool rgb) {
  cv::Mat bgr = image;
  if (rgb && image.channels() > 1)
    cv::cvtColor(image, bgr, image.channels() == 4 ? cv::COLOR_RGBA2BGRA : cv::COLOR_RGB2BGR);
  return bgr;
}

// Empty: None.
[[nodiscard]] inline nb::object image_array(cv::Mat image) {
  if (image.empty()) return nb::none();
  auto kept = std::make_unique<cv::Mat>(image.isContinuous() ? std::move(image) : image.clone());
  const auto rows = static_cast<std::size_t>(kept->rows), columns = static_cast<std::size_t>(kept->cols);
  const auto channels = static_cast<std::size_t>(kept->channels());
  const int depth = kept->depth();
  void* const data = kept->data;
  const nb::capsule owner(kept.release(), [](void* all) noexcept { delete static_cast<cv::Mat*>(all); });
  std::vector<std::size_t> shape{rows, columns};
  if (channels > 1) shape.push_back(channels);
  const auto cast = [&]<class T>(T) {
    return nb::cast(Made<T>(static_cast<T*>(data), shape.size(), shape.data(), owner));
  };
  if (depth == CV_8U) return cast(std::uint8_t{});
  if (depth == CV_16U) return cast(std::uint16_t{});
  if (depth == CV_32F) return cast(float{});
  throw Error("image: has pixels of a type that numpy gets none of");
}

}  // namespace sslam::python
