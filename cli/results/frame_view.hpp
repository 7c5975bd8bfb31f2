// SPDX-License-Identifier: BSD-3-Clause
// What the report shows of one frame: the image in small, its normals, and what the tracker saw in it.
#pragma once

#include <cstddef>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sslam/geometry/camera.hpp"
#include "sslam/system/observer.hpp"

namespace sslam::cli {

struct FrameViewInput {
  std::size_t row = 0;  // of frames.csv
  const cv::Mat& picture;
  const cv::Mat& normal_picture;  // empty: none
  const Camera<double>& camera;   // of the picture
  const std::vector<SO3<double>>& world_from_manhattan;
};

// `row` counts the frames that were tracked; `camera` is that of the images.
[[nodiscard]] inline FrameViewInput frame_view(const FrameEvent& event, std::size_t row,
                                               const Camera<double>& camera) {
  return {row, event.input.picture, event.input.normal_picture, camera, event.map.world_from_manhattan};
}

// Bytes, little-endian; cli/report/views.js reads them, in this order:
//   u32 row; f32 width / height of the picture
//   u32 size and JPEG of the picture; u32 size (0: none) and JPEG of the normals
//   u16 points, u16 how many of them, the first, see the map; each u16 x, y
//   u16 lines; each u16 x, y of both ends, i8 axis (-1: none), u8 whether it sees the map
//   u16 normals; each i8 x, y, z in 1/127
//   u8 whether axes follow; 9 f32, the axes of the room in the camera frame, one after the other
// x and y of the picture run from 0 to 65535 over its width and height.
[[nodiscard]] std::string encode_frame_view(const FrameViewInput& input, const TrackedFrame<double>& frame);

// A view, read back.
struct FrameView {
  struct Line {
    Vec2<double> start, end;
    int axis = 0;  // -1: none
    bool mapped = false;
  };
  std::size_t row = 0;
  std::string_view picture, normals;  // JPEG; empty: none
  std::vector<Vec2<double>> points;   // 0 to 1 over the picture, as the lines
  std::size_t mapped = 0;             // of the points, the first
  std::vector<Line> lines;
};

// `bytes` outlive the answer. Throws Error when they end too early.
[[nodiscard]] FrameView decode_frame_view(std::string_view bytes);

// The picture with its features, as in the overlay video, as JPEG; empty where it cannot be decoded.
[[nodiscard]] std::vector<unsigned char> draw_frame_view(const FrameView& view);

}  // namespace sslam::cli
