// SPDX-License-Identifier: BSD-3-Clause
#include "cli/video/frame_overlay.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <string>

#include "cli/video/overlay_colours.hpp"
#include "sslam/map/manhattan_axes.hpp"

namespace sslam::cli {
namespace {

constexpr int kFont = cv::FONT_HERSHEY_SIMPLEX;
constexpr int kShift = 4;  // of sub-pixel positions, bits

int even(int size) {
  return (size + 1) / 2 * 2;
}

int banner_height(int width) {
  return std::max(16, width / 22);
}

cv::Scalar bgr(const OverlayColour& colour) {
  return {static_cast<double>(colour.blue), static_cast<double>(colour.green),
          static_cast<double>(colour.red)};
}

// Those of the report's dark theme.
cv::Scalar state_colour(State state) {
  switch (state) {
    case State::kManhattan:
      return bgr({53, 189, 184});
    case State::kFallback:
      return bgr({240, 180, 41});
    case State::kUncertain:
      return bgr({183, 148, 246});
    case State::kLost:
      return bgr({255, 92, 138});
    case State::kInitialising:
      break;
  }
  return bgr({160, 168, 180});
}

class Overlay {
 public:
  Overlay(const FrameViewInput& input, const TrackedFrame<double>& frame, const TrackResult<double>& result)
      : input_(input), frame_(frame), result_(result), unit_(std::max(1, input.picture.cols / 640)) {}

  [[nodiscard]] cv::Mat draw() {
    const cv::Mat& picture = input_.picture;
    canvas_ = cv::Mat(overlay_size(picture.cols, picture.rows), CV_8UC3, cv::Scalar(34, 26, 22));
    image_ = canvas_({0, 0, picture.cols, picture.rows});
    picture.copyTo(image_);
    draw_pale();
    draw_lines(false);
    draw_points(true);
    draw_normals();
    draw_banner();
    return canvas_;
  }

 private:
  // What is translucent is blended in all at once.
  void draw_pale() {
    const cv::Mat opaque = image_.clone();
    draw_lines(true);
    draw_points(false);
    cv::addWeighted(opaque, 1 - kPale.opacity, image_, kPale.opacity, 0, image_);
  }

  // Features are undistorted, the picture is as the lens made it.
  [[nodiscard]] cv::Point place(const Vec2<double>& undistorted) const {
    const Vec2<double> pixel = input_.camera.distort_pixel(undistorted) * (1 << kShift);
    return {static_cast<int>(std::lround(pixel.x())), static_cast<int>(std::lround(pixel.y()))};
  }

  void draw_lines(bool pale) {
    const auto& lines = frame_.frame.lines;
    for (std::size_t i = 0; i < lines.size(); ++i) {
      const OverlayColour& colour = axis_overlay(axis_in_frame(frame_.line_axes[i]));
      if ((colour.opacity < 1) != pale) continue;
      const int thickness = (frame_.line_landmarks[i] != kNone ? 2 : 1) * unit_;
      cv::line(image_, place(lines[i].segment.start), place(lines[i].segment.end), bgr(colour), thickness,
               cv::LINE_AA, kShift);
    }
  }

  void draw_points(bool mapped) {
    const auto& points = frame_.frame.points;
    const double half = (mapped ? 1.5 : 1) * unit_;
    for (std::size_t i = 0; i < points.size(); ++i) {
      if ((frame_.point_landmarks[i] != kNone) != mapped) continue;
      const Vec2<double> corner(half, half), at = points[i].pixel;
      cv::rectangle(image_, place(at - corner), place(at + corner), bgr(mapped ? kMappedPoint : kOtherPoint),
                    cv::FILLED, cv::LINE_8, kShift);
    }
  }

  void draw_normals() {
    const cv::Mat& normals = input_.normal_picture;
    if (normals.empty()) return;
    const int width = std::max(1, image_.cols / 4);
    const int height = std::min(image_.rows, std::max(1, width * normals.rows / normals.cols));
    const cv::Rect place(image_.cols - width, 0, width, height);
    cv::resize(normals, image_(place), place.size(), 0, 0, cv::INTER_NEAREST);
    cv::rectangle(image_, place, bgr(kPale), unit_);
  }

  void draw_banner() {
    const int height = banner_height(image_.cols), base = image_.rows + height * 7 / 10;
    const int margin = height / 3;
    std::string text = "frame " + std::to_string(result_.index) + "   ";
    const std::string state = name(result_.state), reason = name(result_.reason);
    std::string rest;
    if (result_.has_pose())
      rest = "   " + std::to_string(result_.point_inliers) + " points " +
             std::to_string(result_.line_inliers) + " lines";
    if (!reason.empty()) rest += "   " + reason;
    if (result_.keyframe) rest += "   keyframe";
    int unused = 0;
    const auto width_at = [&](const std::string& words, double scale) {
      return cv::getTextSize(words, kFont, scale, unit_, &unused).width;
    };
    double scale = height / 40.0;
    const int wanted = width_at(text + state + rest, scale), room = image_.cols - 2 * margin;
    if (wanted > room) scale *= static_cast<double>(room) / wanted;
    int x = margin;
    const auto put = [&](const std::string& words, const cv::Scalar& colour) {
      cv::putText(canvas_, words, {x, base}, kFont, scale, colour, unit_, cv::LINE_AA);
      x += width_at(words, scale);
    };
    put(text, {240, 234, 231});
    put(state, state_colour(result_.state));
    put(rest, {240, 234, 231});
  }

  const FrameViewInput& input_;
  const TrackedFrame<double>& frame_;
  const TrackResult<double>& result_;
  int unit_;  // pixels of a thin line
  cv::Mat canvas_, image_;
};

}  // namespace

cv::Size overlay_size(int width, int height) {
  return {even(width), even(height + banner_height(width))};
}

cv::Mat draw_overlay(const FrameViewInput& input, const TrackedFrame<double>& frame,
                     const TrackResult<double>& result) {
  return Overlay(input, frame, result).draw();
}

}  // namespace sslam::cli
