// SPDX-License-Identifier: BSD-3-Clause
// Lines: segments of one or two octaves, joined where broken, fitted to the full image, with LBD descriptors.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/line_descriptor.hpp>
#include <vector>

#include "sslam/core/parameter.hpp"
#include "sslam/image/segment_detector.hpp"
#include "sslam/image/segment_merger.hpp"
#include "sslam/image/segment_refiner.hpp"
#include "sslam/map/frame.hpp"
#include "sslam/opencv/view_of.hpp"

namespace sslam {

struct LineOptions {
  int octaves = 1;  // 1: half resolution; 2: 0.8 of the full resolution as well
  SegmentDetectorOptions detector;
  double min_length_ratio = 0.04;  // of a segment, over the longer side of the image
  int border = 4;                  // segments that run along the border within this many pixels are artefacts
  int max_lines = 250;             // longest kept
  SegmentMergeOptions merge;
  SegmentRefineOptions refine;

  template <class Self, class Visit>
  static void parameters(Self& self, Visit&& visit) {
    visit("octaves", self.octaves, Unit::kCount, 1, 2,
          "1: half resolution; 2: 0.8 of the full resolution as well");
    visit("min_length_ratio", self.min_length_ratio, Unit::kShare, 0, 1,
          "length of a segment over the longer side of the image");
    visit("border", self.border, Unit::kPixels, 0, kUnbounded,
          "segments that run along the border within this are left out");
    visit("max_lines", self.max_lines, Unit::kCount, 0, 1e6, "longest kept");
    visit_within("detector.", self.detector, visit);
    visit_within("merge.", self.merge, visit);
    visit_within("refine.", self.refine, visit);
  }
};
static_assert(Described<LineOptions>);

class LineExtractor {
 public:
  LineOptions options;

  // Replaces `lines` with the segments of `grey` (8 bit, one channel), longest first, in distorted pixels of
  // that image. The brighter side lies to the left hand of start -> end.
  void extract(const cv::Mat& grey, std::vector<LineFeature<double>>& lines) {
    lines.clear();
    segments_.clear();
    constexpr int kMinSide = 32;
    if (grey.empty() || grey.type() != CV_8UC1 || std::min(grey.cols, grey.rows) < kMinSide) return;
    cv::resize(grey, half_, {(grey.cols + 1) / 2, (grey.rows + 1) / 2}, 0, 0, cv::INTER_AREA);
    detector_.options = options.detector;
    detect(half_, grey.size());
    if (options.octaves > 1) {
      cv::resize(grey, fine_, {}, 0.8, 0.8, cv::INTER_AREA);
      detect(fine_, grey.size());
    }
    const double min_length = options.min_length_ratio * std::max(grey.cols, grey.rows);
    // The first fit brings the pieces of one edge onto one line, so that the second round can join the rest.
    merger_.merge(segments_, options.merge);
    refine(grey, 0.7 * min_length, options.refine.reach);
    merger_.merge(segments_, options.merge);
    refine(grey, min_length, 1);
    for (const RefinedSegment& refined : refined_) {
      if (on_border(refined.segment, grey.size())) continue;
      LineFeature<double> line;
      line.segment = refined.segment;
      line.sigma = refined.sigma;
      lines.push_back(line);
    }
    describe(grey.size(), lines);
  }

 private:
  // Replaces segments_ by what their fit to the image leaves of them; refined_ says the same with
  // uncertainty.
  void refine(const cv::Mat& grey, double min_length, double reach) {
    SegmentRefineOptions refine_options = options.refine;
    refine_options.reach = reach;
    refined_.clear();
    const auto view = view_of<std::uint8_t>(grey);
    for (const auto& segment : segments_) {
      if (segment.length() < 0.8 * min_length) continue;
      const RefinedSegment refined = SegmentRefiner::refine(view, segment, refine_options);
      if (refined.found && refined.segment.length() >= min_length) refined_.push_back(refined);
    }
    std::stable_sort(refined_.begin(), refined_.end(),
                     [](const auto& a, const auto& b) { return a.segment.length() > b.segment.length(); });
    refined_.resize(std::min(refined_.size(), static_cast<std::size_t>(std::max(options.max_lines, 0))));
    segments_.clear();
    for (const RefinedSegment& refined : refined_) segments_.push_back(refined.segment);
  }

  // Adds the segments of the image, which is a smaller one of the size `full`, in pixels of that.
  void detect(const cv::Mat& image, cv::Size full) {
    found_.clear();
    detector_.detect(view_of<std::uint8_t>(image), found_);
    const Vec2<double> scale(static_cast<double>(full.width) / image.cols,
                             static_cast<double>(full.height) / image.rows);
    const auto to_full = [&](const Vec2<double>& p) -> Vec2<double> {
      return (p.array() + 0.5) * scale.array() - 0.5;
    };
    for (const Segment2<double>& s : found_) {
      const Segment2<double> segment{to_full(s.start), to_full(s.end)};
      if (segment.length() > 4) segments_.push_back(segment);
    }
  }

  [[nodiscard]] bool on_border(const Segment2<double>& s, cv::Size size) const noexcept {
    const double b = options.border;
    const auto both = [](double p, double q, double low, double high) {
      return (p < low && q < low) || (p > high && q > high);
    };
    return both(s.start.x(), s.end.x(), b, size.width - 1 - b) ||
           both(s.start.y(), s.end.y(), b, size.height - 1 - b);
  }

  // LBD on the half image: its bands then reach as far as those of a full image would with twice their width.
  void describe(cv::Size full, std::vector<LineFeature<double>>& lines) {
    if (lines.empty()) return;  // OpenCV's LBD prints on an empty list
    const double sx = static_cast<double>(half_.cols) / full.width,
                 sy = static_cast<double>(half_.rows) / full.height;
    keylines_.clear();
    for (std::size_t i = 0; i < lines.size(); ++i) {
      const auto& s = lines[i].segment;
      const auto x = [sx](const Vec2<double>& p) { return static_cast<float>((p.x() + 0.5) * sx - 0.5); };
      const auto y = [sy](const Vec2<double>& p) { return static_cast<float>((p.y() + 0.5) * sy - 0.5); };
      cv::line_descriptor::KeyLine k;
      k.startPointX = k.sPointInOctaveX = x(s.start);
      k.startPointY = k.sPointInOctaveY = y(s.start);
      k.endPointX = k.ePointInOctaveX = x(s.end);
      k.endPointY = k.ePointInOctaveY = y(s.end);
      const float dx = k.endPointX - k.startPointX, dy = k.endPointY - k.startPointY;
      k.pt = {k.startPointX + dx / 2, k.startPointY + dy / 2};
      k.angle = std::atan2(dy, dx);
      k.lineLength = std::hypot(dx, dy);
      k.numOfPixels = std::max(1, static_cast<int>(k.lineLength));
      k.response = k.lineLength / static_cast<float>(std::max(half_.cols, half_.rows));
      k.size = std::abs(dx * dy);
      k.octave = 0;
      k.class_id = static_cast<int>(i);
      keylines_.push_back(k);
    }
    lbd_->compute(half_, keylines_, descriptors_);
    for (std::size_t i = 0; i < keylines_.size(); ++i)
      std::memcpy(lines[static_cast<std::size_t>(keylines_[i].class_id)].descriptor.words.data(),
                  descriptors_.ptr(static_cast<int>(i)), sizeof(Descriptor::words));
  }

  static cv::Ptr<cv::line_descriptor::BinaryDescriptor> make_lbd() {
    cv::line_descriptor::BinaryDescriptor::Params params;
    params.widthOfBand_ = 5;
    return cv::line_descriptor::BinaryDescriptor::createBinaryDescriptor(params);
  }

  SegmentDetector detector_;
  cv::Ptr<cv::line_descriptor::BinaryDescriptor> lbd_ = make_lbd();
  cv::Mat half_, fine_, descriptors_;
  std::vector<Segment2<double>> found_, segments_;
  std::vector<RefinedSegment> refined_;
  SegmentMerger merger_;
  std::vector<cv::line_descriptor::KeyLine> keylines_;
};

}  // namespace sslam
