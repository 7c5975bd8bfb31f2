// SPDX-License-Identifier: BSD-3-Clause
// ORB points: FAST corners of an image pyramid, spread by a grid, localised to a fraction of a pixel, with
// orientation and rotated BRIEF descriptor.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <opencv2/core.hpp>
#include <opencv2/features2d.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "sslam/core/parameter.hpp"
#include "sslam/image/corner_refiner.hpp"
#include "sslam/image/corner_spreader.hpp"
#include "sslam/image/feature_patch.hpp"
#include "sslam/image/image_noise.hpp"
#include "sslam/image/rotated_brief.hpp"
#include "sslam/map/frame.hpp"
#include "sslam/opencv/points/image_pyramid.hpp"
#include "sslam/opencv/view_of.hpp"

namespace sslam {

struct OrbOptions {
  int points = 1200;                         // at most, over all levels
  int levels = 8;                            // of the pyramid
  double ratio = 1.2;                        // size of a level over the size of the next
  int cell = 32;                             // side of a grid cell, pixels of the level
  std::array<float, 3> contrast{20, 10, 5};  // of FAST, grey levels: a cell uses the first that finds enough
  double noise_factor = 4;  // contrast never falls below this many sigma of the image's noise
  int enough = 5;           // corners in a cell
  double candidates = 2;    // FAST corners that are localised, for each point wanted
  int min_distance = 3;     // between two points of a level, pixels of the level
  double sigma = 0.5;       // of a coordinate at level 0, pixels; grows with the level's scale

  template <class Self, class Visit>
  static void parameters(Self& self, Visit&& visit) {
    visit("points", self.points, Unit::kCount, 0, 1e6, "at most, over all levels");
    visit("levels", self.levels, Unit::kCount, 1, 32, "of the pyramid");
    visit("ratio", self.ratio, Unit::kNumber, 1.01, 4, "size of a level over the size of the next");
    visit("cell", self.cell, Unit::kPixels, 8, 10000, "side of a grid cell, of the level");
    visit("contrast.first", self.contrast[0], Unit::kNumber, 1, 255,
          "of FAST, grey levels: a cell uses the first that finds enough");
    visit("contrast.second", self.contrast[1], Unit::kNumber, 1, 255, "where the first finds too few");
    visit("contrast.last", self.contrast[2], Unit::kNumber, 1, 255, "where the second finds too few");
    visit("noise_factor", self.noise_factor, Unit::kNumber, 0, 1000,
          "contrast never falls below so many sigma of the image's noise");
    visit("enough", self.enough, Unit::kCount, 0, 1e6, "corners in a cell");
    visit("candidates", self.candidates, Unit::kNumber, 1, 100,
          "corners that are localised, for each point wanted");
    visit("min_distance", self.min_distance, Unit::kPixels, 0, 1000,
          "between two points of a level, of the level");
    visit("sigma", self.sigma, Unit::kPixels, 0.001, 100,
          "of a coordinate at full resolution, standard deviation");
  }
};
static_assert(Described<OrbOptions>);

class OrbExtractor {
 public:
  OrbOptions options;

  // Replaces `points` with the corners of `grey` (8 bit, one channel), in distorted pixels of that image, and
  // `patches` with what it shows around them. An image too small for a patch gives none.
  void extract(const cv::Mat& grey, std::vector<PointFeature<double>>& points,
               std::vector<FeaturePatch>& patches) {
    points.clear();
    patches.clear();
    if (grey.empty() || grey.type() != CV_8UC1) return;
    pyramid_.build(grey, options.levels, options.ratio, 2 * kBorder + 8);
    double weight = 0;
    for (std::size_t level = 0; level < pyramid_.size(); ++level) weight += 1 / pyramid_.scale(level);
    int left = options.points;
    // Finer levels first; what a level cannot use goes to the coarser ones.
    for (std::size_t level = 0; level < pyramid_.size(); ++level) {
      const double share = 1 / pyramid_.scale(level);
      detect(pyramid_.image(level), static_cast<int>(std::lround(left * share / weight)));
      describe(level, points, patches);
      left -= static_cast<int>(corners_.size());
      weight -= share;
    }
  }

 private:
  static constexpr int kBorder = RotatedBrief::kRadius + 1;  // kept free of corners, pixels of the level
  static_assert(kBorder >= CornerRefiner::kMargin + 2 && kBorder > FeaturePatch::kRadius + 1);

  // Fills corners_ with at most `budget` corners of a level.
  void detect(const cv::Mat& image, int budget) {
    corners_.clear();
    const auto view = view_of<std::uint8_t>(image);
    const float lowest =
        std::max(options.contrast.back(), static_cast<float>(options.noise_factor * image_noise(view)));
    const int rim =
        kBorder - 3 + 1;  // FAST leaves 3 pixels free by itself, and the refinement may move by a pixel
    const cv::Rect inside(rim, rim, image.cols - 2 * rim, image.rows - 2 * rim);
    // One pass serves every contrast: the response of a corner is the highest at which it is found.
    cv::FAST(image(inside), fast_, static_cast<int>(std::floor(lowest)), true);
    for (const cv::KeyPoint& k : fast_)
      corners_.push_back({k.pt.x + static_cast<float>(rim), k.pt.y + static_cast<float>(rim), k.response});
    std::array<float, 3> contrast = options.contrast;
    for (float& c : contrast) c = std::max(c, lowest);
    const int candidates = static_cast<int>(std::lround(options.candidates * budget));
    spreader_.spread(corners_, view.size(), {options.cell, candidates, 0, contrast, options.enough});
    std::erase_if(corners_, [&](Corner& corner) { return !CornerRefiner::refine(view, corner); });
    spreader_.spread(corners_, view.size(), {options.cell, budget, options.min_distance, {}, 0});
  }

  void describe(std::size_t level, std::vector<PointFeature<double>>& points,
                std::vector<FeaturePatch>& patches) {
    if (corners_.empty()) return;
    const cv::Mat& image = pyramid_.image(level);
    cv::GaussianBlur(image, smooth_, {7, 7}, 2, 2, cv::BORDER_REFLECT_101);
    const auto view = view_of<std::uint8_t>(image), smooth = view_of<std::uint8_t>(smooth_);
    for (const Corner& corner : corners_) {
      const int x = static_cast<int>(std::lround(corner.x)), y = static_cast<int>(std::lround(corner.y));
      PointFeature<double> point;
      point.pixel = pyramid_.to_full({corner.x, corner.y}, level);
      point.sigma = options.sigma * pyramid_.scale(level);
      const float angle = brief_.orientation(view, x, y);
      point.angle = angle;
      point.octave = static_cast<std::uint8_t>(level);
      point.descriptor = brief_.describe(smooth, x, y, angle);
      point.patch = static_cast<std::int32_t>(patches.size());
      points.push_back(point);
      patches.push_back(cut_patch(view, corner.x, corner.y));
      patches.back().spacing = pyramid_.spacing(level).cast<float>().asDiagonal();
    }
  }

  ImagePyramid pyramid_;
  CornerSpreader spreader_;
  RotatedBrief brief_;
  std::vector<cv::KeyPoint> fast_;
  std::vector<Corner> corners_;
  cv::Mat smooth_;
};

}  // namespace sslam
