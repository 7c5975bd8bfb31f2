// SPDX-License-Identifier: BSD-3-Clause
// The cameras of a COLMAP model, cameras.txt or cameras.bin: what each file says, not what it means.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "sslam/core/colmap_bytes.hpp"
#include "sslam/core/error.hpp"
#include "sslam/core/shortest_text.hpp"

namespace sslam {

struct ColmapCamera {
  std::int64_t id = 0;
  std::uint64_t width = 0, height = 0;  // pixels
  std::string row;                      // "CAMERA_ID MODEL WIDTH HEIGHT PARAMS[]", as cameras.txt has it
};

namespace colmap_detail {

struct Model {
  std::string_view name;
  std::size_t numbers;
};

// By their numbers in cameras.bin.
inline constexpr std::array<Model, 11> kModels{{{"SIMPLE_PINHOLE", 3},
                                                {"PINHOLE", 4},
                                                {"SIMPLE_RADIAL", 4},
                                                {"RADIAL", 5},
                                                {"OPENCV", 8},
                                                {"OPENCV_FISHEYE", 8},
                                                {"FULL_OPENCV", 12},
                                                {"FOV", 5},
                                                {"SIMPLE_RADIAL_FISHEYE", 4},
                                                {"RADIAL_FISHEYE", 5},
                                                {"THIN_PRISM_FISHEYE", 12}}};

}  // namespace colmap_detail

// Of the bytes of a cameras.bin. Throws Error in one line.
[[nodiscard]] inline std::vector<ColmapCamera> parse_colmap_binary(std::string_view bytes,
                                                                   const std::string& source) {
  ColmapBytes left(bytes, source, "cameras.bin");
  std::uint64_t count = 0;
  left.take(count);
  std::vector<ColmapCamera> cameras;
  for (std::uint64_t i = 0; i < count; ++i) {
    ColmapCamera camera;
    std::int32_t id = 0, model = 0;
    left.take(id);
    left.take(model);
    left.take(camera.width);
    left.take(camera.height);
    if (model < 0 || static_cast<std::size_t>(model) >= colmap_detail::kModels.size())
      throw Error(source + ": camera " + std::to_string(id) + " has the model number " +
                  std::to_string(model) + ", which is not known; expected 0 to 10, or a cameras.txt");
    const colmap_detail::Model& known = colmap_detail::kModels[static_cast<std::size_t>(model)];
    camera.id = id;
    camera.row = std::to_string(id) + " " + std::string(known.name) + " " + std::to_string(camera.width) +
                 " " + std::to_string(camera.height);
    for (std::size_t k = 0; k < known.numbers; ++k) {
      double number = 0;
      left.take(number);
      camera.row += " " + shortest_text(number);
    }
    cameras.push_back(std::move(camera));
  }
  return cameras;
}

// Of a cameras.txt. Rows that are none are left out; whoever reads a camera's row says what is wrong with it.
[[nodiscard]] inline std::vector<ColmapCamera> parse_colmap_rows(const std::string& text) {
  std::vector<ColmapCamera> cameras;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream cells(line);
    ColmapCamera camera;
    std::string model;
    if (!(cells >> camera.id >> model >> camera.width >> camera.height)) continue;
    while (!line.empty() && (line.back() == '\r' || line.back() == ' ')) line.pop_back();
    camera.row = line;
    cameras.push_back(std::move(camera));
  }
  return cameras;
}

}  // namespace sslam
