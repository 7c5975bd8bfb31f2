// SPDX-License-Identifier: BSD-3-Clause
// The views of a run's frames, read back and drawn.
#include <cmath>
#include <cstdint>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "cli/results/frame_view.hpp"
#include "cli/video/overlay_colours.hpp"
#include "sslam/io/maps/byte_archive.hpp"

namespace sslam::cli {
namespace {

constexpr int kShift = 4;  // of sub-pixel positions, bits

template <class T>
T take(io::ByteReader& in) {
  T value{};
  in(value);
  return value;
}

Vec2<double> take_place(io::ByteReader& in) {
  const double x = take<std::uint16_t>(in), y = take<std::uint16_t>(in);
  return Vec2<double>(x, y) / 65535;
}

class Drawing {
 public:
  explicit Drawing(cv::Mat& image) : image_(image) {}

  void line(const FrameView::Line& line) {
    cv::line(image_, at(line.start), at(line.end), bgr(axis_overlay(line.axis)), line.mapped ? 2 : 1,
             cv::LINE_AA, kShift);
  }
  void point(const Vec2<double>& place, bool mapped) {
    cv::circle(image_, at(place), (mapped ? 3 : 2) << (kShift - 1), bgr(mapped ? kMappedPoint : kOtherPoint),
               cv::FILLED, cv::LINE_AA, kShift);
  }

 private:
  [[nodiscard]] cv::Point at(const Vec2<double>& share) const {
    constexpr double kOne = 1 << kShift;
    return {static_cast<int>(std::lround((share.x() * image_.cols - 0.5) * kOne)),
            static_cast<int>(std::lround((share.y() * image_.rows - 0.5) * kOne))};
  }
  [[nodiscard]] static cv::Scalar bgr(const OverlayColour& colour) {
    return {static_cast<double>(colour.blue), static_cast<double>(colour.green),
            static_cast<double>(colour.red)};
  }

  cv::Mat& image_;
};

}  // namespace

FrameView decode_frame_view(std::string_view bytes) {
  io::ByteReader in(bytes);
  FrameView view;
  view.row = take<std::uint32_t>(in);
  (void)take<float>(in);  // the picture's shape
  view.picture = in.take(take<std::uint32_t>(in));
  view.normals = in.take(take<std::uint32_t>(in));
  const std::size_t points = take<std::uint16_t>(in);
  view.mapped = take<std::uint16_t>(in);
  for (std::size_t i = 0; i < points; ++i) view.points.push_back(take_place(in));
  const std::size_t lines = take<std::uint16_t>(in);
  for (std::size_t i = 0; i < lines; ++i) {
    FrameView::Line& line = view.lines.emplace_back();
    line.start = take_place(in);
    line.end = take_place(in);
    line.axis = take<std::int8_t>(in);
    line.mapped = take<std::uint8_t>(in) != 0;
    if (line.axis > 2) throw Error("has an axis that there is not");
  }
  return view;
}

std::vector<unsigned char> draw_frame_view(const FrameView& view) {
  const std::vector<unsigned char> file(view.picture.begin(), view.picture.end());
  cv::Mat image = file.empty() ? cv::Mat() : cv::imdecode(file, cv::IMREAD_COLOR);
  if (image.empty()) return {};
  Drawing drawing(image);
  for (const FrameView::Line& line : view.lines) drawing.line(line);
  for (std::size_t i = 0; i < view.points.size(); ++i) drawing.point(view.points[i], i < view.mapped);
  std::vector<unsigned char> drawn;
  cv::imencode(".jpg", image, drawn, {cv::IMWRITE_JPEG_QUALITY, 80});
  return drawn;
}

}  // namespace sslam::cli
