// SPDX-License-Identifier: BSD-3-Clause
// Chooses among the FAST corners of one image: a threshold for each cell of a grid, lower where texture is
// poor, and then as even a share for each cell as the supply allows.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <opencv2/core.hpp>
#include <opencv2/features2d.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

namespace sslam {

struct CornerGridOptions {
  int cell = 32;                             // side of a grid cell, pixels of the level
  std::array<int, 3> thresholds{20, 10, 5};  // FAST contrast, grey levels: tried from high to low
  int enough = 3;                            // corners at which a cell needs no lower threshold
  double noise_factor = 4;                   // the threshold never falls below this many sigma of noise
  int min_distance = 3;                      // between two corners, pixels of the level
  int border = 16;                           // kept free, pixels of the level
};

// Standard deviation of the noise of an 8 bit image, grey levels: the median absolute response of a mask that
// is blind to constant and linear brightness (Immerkaer, 1996) on a subset of the pixels.
[[nodiscard]] inline double image_noise(const cv::Mat& image) {
  constexpr int kStep = 3;
  std::array<int, 256> histogram{};
  int total = 0;
  for (int y = 1; y + 1 < image.rows; y += kStep) {
    const std::uint8_t* a = image.ptr<std::uint8_t>(y - 1);
    const std::uint8_t* b = image.ptr<std::uint8_t>(y);
    const std::uint8_t* c = image.ptr<std::uint8_t>(y + 1);
    for (int x = 1; x + 1 < image.cols; x += kStep, ++total) {
      const int response =
          a[x - 1] + a[x + 1] + c[x - 1] + c[x + 1] + 4 * b[x] - 2 * (a[x] + c[x] + b[x - 1] + b[x + 1]);
      ++histogram[static_cast<std::size_t>(std::min(std::abs(response), 255))];
    }
  }
  if (total == 0) return 0;
  int below = 0;
  std::size_t bin = 0;
  while (below + histogram[bin] < (total + 1) / 2) below += histogram[bin++];
  const double median =
      histogram[bin] == 0 ? 0 : static_cast<double>(bin) - 0.5 + (0.5 * total - below) / histogram[bin];
  return std::max(0.0, median) * 1.4826 / 6;  // the mask multiplies sigma by 6
}

class CornerGrid {
 public:
  // Appends to `chosen` at most `budget` corners of `image` (8 bit grey), by cell and falling contrast.
  void choose(const cv::Mat& image, int budget, const CornerGridOptions& options,
              std::vector<cv::KeyPoint>& chosen) {
    const int lowest = std::max(options.thresholds.back(),
                                static_cast<int>(std::ceil(options.noise_factor * image_noise(image))));
    const cv::Rect inside(options.border - 3, options.border - 3, image.cols - 2 * options.border + 6,
                          image.rows - 2 * options.border + 6);
    if (inside.width < 7 || inside.height < 7 || budget <= 0) return;
    // One pass serves every threshold: the response of a corner is the highest at which it is found.
    cv::FAST(image(inside), corners_, lowest, true);
    for (auto& corner : corners_) corner.pt += cv::Point2f(inside.tl());
    sort_into_cells(image.size(), options);
    thin_out(image.size(), options, lowest);
    share(budget, chosen);
  }

 private:
  [[nodiscard]] std::size_t cell_of(const cv::Point2f& p, int cell) const noexcept {
    return static_cast<std::size_t>(static_cast<int>(p.y) / cell * columns_ + static_cast<int>(p.x) / cell);
  }

  void sort_into_cells(cv::Size size, const CornerGridOptions& options) {
    columns_ = (size.width + options.cell - 1) / options.cell;
    const int rows = (size.height + options.cell - 1) / options.cell;
    starts_.assign(static_cast<std::size_t>(columns_ * rows) + 1, 0);
    for (const auto& corner : corners_) ++starts_[cell_of(corner.pt, options.cell) + 1];
    std::partial_sum(starts_.begin(), starts_.end(), starts_.begin());
    cursor_.assign(starts_.begin(), starts_.end() - 1);
    sorted_.resize(corners_.size());
    for (const auto& corner : corners_) sorted_[cursor_[cell_of(corner.pt, options.cell)]++] = corner;
    for (std::size_t c = 0; c + 1 < starts_.size(); ++c)
      std::sort(sorted_.begin() + starts_[c], sorted_.begin() + starts_[c + 1],
                [](const auto& a, const auto& b) {
                  if (a.response != b.response) return a.response > b.response;
                  return a.pt.y != b.pt.y ? a.pt.y < b.pt.y : a.pt.x < b.pt.x;
                });
  }

  // Keeps, in place, the corners of each cell that pass its threshold and lie apart from stronger ones.
  void thin_out(cv::Size size, const CornerGridOptions& options, int lowest) {
    taken_.create(size, CV_8U);
    taken_.setTo(0);
    counts_.assign(starts_.size() - 1, 0);
    for (std::size_t c = 0; c + 1 < starts_.size(); ++c) {
      const int threshold = cell_threshold(c, options, lowest);
      for (int i = starts_[c]; i < starts_[c + 1]; ++i) {
        const cv::KeyPoint corner = sorted_[static_cast<std::size_t>(i)];
        if (corner.response < static_cast<float>(threshold)) break;
        const int x = static_cast<int>(corner.pt.x), y = static_cast<int>(corner.pt.y),
                  r = options.min_distance;
        if (taken_.at<std::uint8_t>(y, x)) continue;
        const cv::Rect around = cv::Rect(x - r, y - r, 2 * r + 1, 2 * r + 1) & cv::Rect({}, size);
        taken_(around).setTo(1);
        sorted_[static_cast<std::size_t>(starts_[c] + counts_[c]++)] = corner;
      }
    }
  }

  [[nodiscard]] int cell_threshold(std::size_t c, const CornerGridOptions& options,
                                   int lowest) const noexcept {
    for (const int threshold : options.thresholds) {
      const int nth = starts_[c] + options.enough - 1;
      if (nth < starts_[c + 1] &&
          sorted_[static_cast<std::size_t>(nth)].response >= static_cast<float>(threshold))
        return std::max(threshold, lowest);
    }
    return lowest;
  }

  // The largest share that every cell may take, filled or not, without passing the budget; the remainder goes
  // to the strongest corners that are next in line.
  void share(int budget, std::vector<cv::KeyPoint>& chosen) {
    int low = 0, high = budget + 1;
    while (high - low > 1) {
      const int middle = (low + high) / 2;
      int total = 0;
      for (const int count : counts_) total += std::min(count, middle);
      (total <= budget ? low : high) = middle;
    }
    next_.clear();
    int total = 0;
    for (std::size_t c = 0; c < counts_.size(); ++c) {
      const int take = std::min(counts_[c], low);
      const auto first = sorted_.begin() + starts_[c];
      chosen.insert(chosen.end(), first, first + take);
      total += take;
      if (counts_[c] > low) next_.push_back(*(first + low));
    }
    std::stable_sort(next_.begin(), next_.end(),
                     [](const auto& a, const auto& b) { return a.response > b.response; });
    const auto rest = std::min(next_.size(), static_cast<std::size_t>(budget - total));
    chosen.insert(chosen.end(), next_.begin(), next_.begin() + static_cast<std::ptrdiff_t>(rest));
  }

  int columns_ = 0;
  std::vector<cv::KeyPoint> corners_, sorted_, next_;
  std::vector<int> starts_, cursor_, counts_;
  cv::Mat taken_;
};

}  // namespace sslam
