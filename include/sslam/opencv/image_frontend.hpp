// SPDX-License-Identifier: BSD-3-Clause
// From an image to a Frame: points and lines in two threads, undistorted, and normals from whatever source is
// plugged in.
#pragma once

#include <Eigen/LU>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <memory>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "sslam/map/frame.hpp"
#include "sslam/opencv/camera/undistorter.hpp"
#include "sslam/opencv/image_mask.hpp"
#include "sslam/opencv/lines/line_extractor.hpp"
#include "sslam/opencv/normals/no_normals.hpp"
#include "sslam/opencv/normals/normal_source.hpp"
#include "sslam/opencv/points/orb_extractor.hpp"
#include "sslam/opencv/side_thread.hpp"

namespace sslam {

enum class ImageStatus : std::uint8_t {
  kOk,
  kEmpty,      // no pixels: the file could not be decoded
  kWrongSize,  // not the camera's width and height
  kWrongType,  // not 8 bit with one, three or four channels
  kWrongMask,  // not 8 bit with one channel, of the image's size
};

[[nodiscard]] constexpr const char* name(ImageStatus status) noexcept {
  switch (status) {
    case ImageStatus::kOk:
      return "ok";
    case ImageStatus::kEmpty:
      return "the image is empty";
    case ImageStatus::kWrongSize:
      return "the image does not have the camera's size";
    case ImageStatus::kWrongType:
      return "the image is not 8 bit grey, BGR or BGRA";
    case ImageStatus::kWrongMask:
      return "the mask is not 8 bit grey of the image's size";
  }
  return "unknown";
}

// Times are seconds of wall clock; points and normals run beside lines, so the total is less than the sum.
struct FrontendReport {
  ImageStatus image = ImageStatus::kOk;      // the frame is filled only if ok
  NormalStatus normals = NormalStatus::kOk;  // of this frame's normals; points and lines stand without them
  double grey_time = 0, points_time = 0, lines_time = 0, normals_time = 0, total_time = 0;
};

template <NormalSource Normals = NoNormals>
class ImageFrontend {
 public:
  Camera<double> camera;
  OrbExtractor points;
  LineExtractor lines;
  Normals normals;
  bool normals_later = false;  // process() leaves the frame without normals: ask() finds them
  bool parallel = true;        // false: one stage after the other, with the same result

  // Replaces the contents of `frame`, whose buffers are reused.
  [[nodiscard]] FrontendReport process(const ImageInput& input, Frame<double>& frame) {
    FrontendReport report;
    const Clock start;
    report.image = to_grey(input.image);
    if (report.image == ImageStatus::kOk && !mask_.set(input.mask, grey_.size()))
      report.image = ImageStatus::kWrongMask;
    report.grey_time = start.seconds();
    if (report.image != ImageStatus::kOk) return report;
    mask_.flatten(grey_);
    frame.index = input.index;
    frame.stamp = input.stamp;
    frame.pinhole = camera.pinhole;
    frame.width = camera.width;
    frame.height = camera.height;
    const auto points_and_normals = [&] {
      const Clock clock;
      extract_points(frame);
      report.points_time = clock.seconds();
      if (normals_later) return frame.normals.clear();
      report.normals = fill_normals(input, mask_, frame.normals);
      report.normals_time = clock.seconds() - report.points_time;
    };
    const auto only_lines = [&] {
      const Clock clock;
      extract_lines(frame);
      report.lines_time = clock.seconds();
    };
    if (parallel) {
      if (!side_) side_ = std::make_unique<SideThread>();
      side_->run(points_and_normals, only_lines);
    } else {
      only_lines();
      points_and_normals();
    }
    report.total_time = start.seconds();
    return report;
  }

  // Fills in the normals of an image that process() has taken; another thread may process the next one
  // meanwhile. Where the mask leaves nothing to see there are no normals.
  void ask(const ImageInput& input, NormalField& field, FrontendReport& report) {
    const Clock clock;
    (void)asked_mask_.set(input.depth.empty() ? cv::Mat() : input.mask, input.image.size());
    report.normals = fill_normals(input, asked_mask_, field);
    report.normals_time = clock.seconds();
    report.total_time += report.normals_time;
  }

 private:
  class Clock {
   public:
    [[nodiscard]] double seconds() const {
      return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    }

   private:
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  };

  [[nodiscard]] ImageStatus to_grey(const cv::Mat& image) {
    if (image.empty()) return ImageStatus::kEmpty;
    if (image.cols != camera.width || image.rows != camera.height) return ImageStatus::kWrongSize;
    switch (image.type()) {
      case CV_8UC1:
        image.copyTo(grey_);
        return ImageStatus::kOk;
      case CV_8UC3:
        cv::cvtColor(image, grey_, cv::COLOR_BGR2GRAY);
        return ImageStatus::kOk;
      case CV_8UC4:
        cv::cvtColor(image, grey_, cv::COLOR_BGRA2GRAY);
        return ImageStatus::kOk;
      default:
        return ImageStatus::kWrongType;
    }
  }

  void extract_points(Frame<double>& frame) {
    points.extract(grey_, frame.points, frame.patches);
    if (mask_.active()) {
      std::erase_if(frame.points, [&](const PointFeature<double>& point) {
        constexpr double kReach = 5;  // of a corner and its refinement, pixels of its level
        return mask_.distance(point.pixel) <= kReach * point.sigma / points.options.sigma;
      });
    }
    if (camera.distortion.is_identity()) return;
    std::erase_if(frame.points, [&](PointFeature<double>& point) {
      point.pixel = camera.undistort_pixel(point.pixel);
      if (!seen(point.pixel, 0)) return true;
      Mat2<float>& spacing = frame.patches[static_cast<std::size_t>(point.patch)].spacing;
      spacing = distortion_at(point.pixel).inverse().template cast<float>() * spacing;
      return false;
    });
  }

  // The derivative of the distorted pixel by the undistorted one.
  [[nodiscard]] Mat2<double> distortion_at(const Vec2<double>& undistorted) const noexcept {
    Mat2<double> jacobian;
    for (int axis = 0; axis < 2; ++axis) {
      const Vec2<double> step = Vec2<double>::Unit(axis);
      jacobian.col(axis) =
          (camera.distort_pixel(undistorted + step) - camera.distort_pixel(undistorted - step)) / 2;
    }
    return jacobian;
  }

  // Straight edges are straight, and whole, only in the undistorted image. What lies beyond the lens's view
  // there is no evidence.
  void extract_lines(Frame<double>& frame) {
    lines.extract(undistorter_.undistort(grey_, camera), frame.lines);
    if (mask_.active()) {
      std::erase_if(frame.lines, [&](const LineFeature<double>& line) { return is_masked(line.segment); });
    }
    if (camera.distortion.is_identity()) return;
    std::erase_if(frame.lines, [&](const LineFeature<double>& line) {
      const double border = lines.options.border;
      return !seen(line.segment.start, border) || !seen(line.segment.end, border) ||
             !seen(line.segment.midpoint(), border);
    });
  }

  // A line that runs along the border of what is left out is that border; one that ends there was cut off by
  // it, and stays.
  [[nodiscard]] bool is_masked(const Segment2<double>& segment) const {
    constexpr double kStep = 2, kReach = 4;  // pixels
    const auto steps = static_cast<int>(std::ceil((segment.end - segment.start).norm() / kStep));
    int near = 0;
    for (int i = 0; i <= steps; ++i) {
      const double share = steps > 0 ? static_cast<double>(i) / steps : 0;
      const Vec2<double> undistorted = segment.start + share * (segment.end - segment.start);
      const double distance = mask_.distance(camera.distort_pixel(undistorted));
      if (distance == 0) return true;
      near += distance <= kReach ? 1 : 0;
    }
    return 2 * near > steps + 1;
  }

  // Depth of what is left out gives no normals. Networks look at the whole image.
  [[nodiscard]] NormalStatus fill_normals(const ImageInput& input, const ImageMask& mask,
                                          NormalField& field) {
    if (!mask.active() || input.depth.size() != input.image.size()) return normals.fill(input, camera, field);
    ImageInput seen = input;
    seen.depth = input.depth.clone();
    mask.erase_depth(seen.depth);
    return normals.fill(seen, camera, field);
  }

  // Whether the lens sees this undistorted pixel, `border` or more pixels inside its image. The way back
  // excludes the far field, which the distortion model folds into the image.
  [[nodiscard]] bool seen(const Vec2<double>& undistorted, double border) const noexcept {
    const Vec2<double> pixel = camera.distort_pixel(undistorted);
    return pixel.x() >= border && pixel.y() >= border && pixel.x() <= camera.width - 1 - border &&
           pixel.y() <= camera.height - 1 - border &&
           (camera.undistort_pixel(pixel) - undistorted).norm() < 0.5;
  }

  Undistorter undistorter_;
  ImageMask mask_, asked_mask_;  // of process() and of ask()
  cv::Mat grey_;
  std::unique_ptr<SideThread> side_;  // where the points are found
};

}  // namespace sslam
