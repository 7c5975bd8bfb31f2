// SPDX-License-Identifier: BSD-3-Clause
#include "cli/results/frame_view.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "sslam/io/maps/byte_archive.hpp"
#include "sslam/map/manhattan_axes.hpp"

namespace sslam::cli {
namespace {

// Chosen so that 1000 frames stay within 15 MB as text.
constexpr int kWidth = 304;
constexpr int kQuality = 45;
constexpr int kNormalQuality = 70;
constexpr std::size_t kOtherPoints = 100;  // that see nothing of the map
constexpr std::size_t kLines = 100;
constexpr std::size_t kNormals = 160;

std::vector<unsigned char> jpeg(const cv::Mat& image, int quality) {
  std::vector<unsigned char> bytes;
  cv::imencode(".jpg", image, bytes, {cv::IMWRITE_JPEG_QUALITY, quality});
  return bytes;
}

std::vector<unsigned char> small_jpeg(const cv::Mat& image) {
  if (image.cols <= kWidth) return jpeg(image, kQuality);
  cv::Mat small;
  const int height = std::max(1, image.rows * kWidth / image.cols);
  cv::resize(image, small, {kWidth, height}, 0, 0, cv::INTER_AREA);
  return jpeg(small, kQuality);
}

class Encoder {
 public:
  Encoder(const FrameViewInput& input, const TrackedFrame<double>& frame) : input_(input), frame_(frame) {}

  [[nodiscard]] std::string encode() {
    const cv::Mat& picture = input_.picture;
    out_(static_cast<std::uint32_t>(input_.row));
    out_(static_cast<float>(picture.cols) / static_cast<float>(picture.rows));
    put_block(small_jpeg(picture));
    put_block(input_.normal_picture.empty() ? std::vector<unsigned char>()
                                            : jpeg(input_.normal_picture, kNormalQuality));
    put_points();
    put_lines();
    put_normals();
    put_axes();
    return std::move(out_.bytes);
  }

 private:
  void put_block(const std::vector<unsigned char>& block) {
    out_(static_cast<std::uint32_t>(block.size()));
    out_.bytes.append(block.begin(), block.end());
  }

  void put_count(std::size_t count) { out_(static_cast<std::uint16_t>(count)); }

  // Features are undistorted, the picture is as the lens made it.
  void put_pixel(const Vec2<double>& undistorted) {
    const Vec2<double> pixel = input_.camera.distort_pixel(undistorted);
    const auto share = [](double at, int size) {
      return static_cast<std::uint16_t>(std::lround(std::clamp((at + 0.5) / size, 0.0, 1.0) * 65535));
    };
    out_(share(pixel.x(), input_.picture.cols));
    out_(share(pixel.y(), input_.picture.rows));
  }

  void put_points() {
    const auto& points = frame_.frame.points;
    std::vector<std::size_t> mapped, others;
    for (std::size_t i = 0; i < points.size(); ++i)
      (frame_.point_landmarks[i] != kNone ? mapped : others).push_back(i);
    others.resize(std::min(others.size(), kOtherPoints));
    put_count(mapped.size() + others.size());
    put_count(mapped.size());
    for (const auto& list : {mapped, others})
      for (const std::size_t i : list) put_pixel(points[i].pixel);
  }

  // The longest ones.
  void put_lines() {
    const auto& lines = frame_.frame.lines;
    std::vector<std::size_t> order(lines.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      return lines[a].segment.length() > lines[b].segment.length();
    });
    order.resize(std::min(order.size(), kLines));
    put_count(order.size());
    for (const std::size_t i : order) {
      put_pixel(lines[i].segment.start);
      put_pixel(lines[i].segment.end);
      out_(axis_in_frame(frame_.line_axes[i]));
      out_(static_cast<std::uint8_t>(frame_.line_landmarks[i] != kNone));
    }
  }

  void put_normals() {
    const NormalField& field = frame_.frame.normals;
    const std::size_t step = std::max<std::size_t>(1, (field.size() + kNormals - 1) / kNormals);
    put_count((field.size() + step - 1) / step);
    for (std::size_t i = 0; i < field.size(); i += step)
      for (const auto* component : {&field.x, &field.y, &field.z})
        out_(static_cast<std::int8_t>(std::lround(std::clamp((*component)[i], -1.0F, 1.0F) * 127)));
  }

  void put_axes() {
    const auto& frames = input_.world_from_manhattan;
    const bool known = frame_.manhattan && frame_.manhattan_frame < frames.size();
    out_(static_cast<std::uint8_t>(known));
    if (!known) return;
    const Mat3<double> axes = (frame_.manhattan->cam_from_world * frames[frame_.manhattan_frame]).matrix();
    for (const double value : axes.reshaped()) out_(static_cast<float>(value));
  }

  const FrameViewInput& input_;
  const TrackedFrame<double>& frame_;
  io::ByteWriter out_;
};

}  // namespace

std::string encode_frame_view(const FrameViewInput& input, const TrackedFrame<double>& frame) {
  return Encoder(input, frame).encode();
}

}  // namespace sslam::cli
