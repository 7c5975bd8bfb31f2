// SPDX-License-Identifier: BSD-3-Clause
// An image of one channel that somebody else owns.
#pragma once

#include <cassert>
#include <cstddef>

namespace sslam {

struct ImageSize {
  int width = 0, height = 0;  // pixels
};

// Reads pixels and never writes them. Whoever owns them keeps them alive for as long as the view is used.
template <class Pixel>
class ImageView {
 public:
  ImageView() = default;

  // `stride`: from one row to the next, in pixels.
  ImageView(const Pixel* data, ImageSize size, std::ptrdiff_t stride) noexcept
      : data_(data), size_(size), stride_(stride) {
    assert(size.width >= 0 && size.height >= 0 && stride >= size.width);
  }
  // Rows without a gap between them.
  ImageView(const Pixel* data, ImageSize size) noexcept : ImageView(data, size, size.width) {}

  [[nodiscard]] ImageSize size() const noexcept { return size_; }
  [[nodiscard]] int width() const noexcept { return size_.width; }
  [[nodiscard]] int height() const noexcept { return size_.height; }
  [[nodiscard]] std::ptrdiff_t stride() const noexcept { return stride_; }

  [[nodiscard]] const Pixel* row(int y) const noexcept {
    assert(y >= 0 && y < size_.height);
    return data_ + y * stride_;
  }
  [[nodiscard]] const Pixel& at(int x, int y) const noexcept {
    assert(x >= 0 && x < size_.width);
    return row(y)[x];
  }

 private:
  const Pixel* data_ = nullptr;
  ImageSize size_;
  std::ptrdiff_t stride_ = 0;
};

}  // namespace sslam
