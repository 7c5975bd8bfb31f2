// SPDX-License-Identifier: BSD-3-Clause
// The images of a COLMAP model, images.txt or images.bin: a name and a pose each. COLMAP writes world to
// camera, w first; here it is camera to world.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sslam/core/colmap_bytes.hpp"
#include "sslam/io/files/plain_text.hpp"
#include "sslam/io/files/text.hpp"
#include "sslam/io/trajectories/pose_row.hpp"

namespace sslam::io {

struct NamedPose {
  std::string name;
  SE3<double> world_from_cam;
  std::int64_t camera = 0;  // its id
};

// Of the seven numbers QW QX QY QZ TX TY TZ; nothing, with the reason in `why`, where they are no pose.
[[nodiscard]] inline std::optional<SE3<double>> pose_of_colmap(const double* v, std::string& why) {
  for (int i = 0; i < 7; ++i)
    if (!std::isfinite(v[i])) {
      why = "a pose is not finite";
      return std::nullopt;
    }
  const auto cam_from_world = pose_of({v[4], v[5], v[6]}, {v[1], v[2], v[3], v[0]}, why);
  return cam_from_world ? std::optional(cam_from_world->inverse()) : std::nullopt;
}

// `IMAGE_ID QW QX QY QZ TX TY TZ CAMERA_ID NAME`. The rows between are features: three numbers each, so that
// none of them ends in a name.
[[nodiscard]] inline bool is_colmap_row(const TextRow& row) {
  if (row.cells.size() < 10 || parse_number<double>(row.cells.back())) return false;
  for (std::size_t i = 0; i < 9; ++i)
    if (!parse_number<double>(row.cells[i])) return false;
  return parse_number<std::int64_t>(row.cells[0]) && parse_number<std::int64_t>(row.cells[8]);
}

// Throws Error in one line.
[[nodiscard]] inline std::vector<NamedPose> read_colmap_text(const std::filesystem::path& path,
                                                             const std::vector<TextRow>& rows) {
  std::vector<NamedPose> images;
  for (const TextRow& row : rows) {
    if (!is_colmap_row(row)) continue;
    double v[7];
    for (std::size_t i = 0; i < 7; ++i) v[i] = *parse_number<double>(row.cells[i + 1]);
    std::string why;
    const auto pose = pose_of_colmap(v, why);
    if (!pose) throw Error(path.string() + ": line " + std::to_string(row.line) + ": " + why);
    const char* const name = row.cells[9].data();  // it may hold blanks
    std::string_view rest(name, static_cast<std::size_t>(row.text.data() + row.text.size() - name));
    while (!rest.empty() && (rest.back() == ' ' || rest.back() == '\t')) rest.remove_suffix(1);
    images.push_back({std::string(rest), *pose, *parse_number<std::int64_t>(row.cells[8])});
  }
  return images;
}

// Throws Error in one line.
[[nodiscard]] inline std::vector<NamedPose> read_colmap_binary(const std::filesystem::path& path) {
  const std::string bytes = read_text(path);
  ColmapBytes left(bytes, path.string(), "images.bin");
  std::uint64_t count = 0;
  left.take(count);
  std::vector<NamedPose> images;
  for (std::uint64_t i = 0; i < count; ++i) {
    std::int32_t id = 0, camera = 0;
    double v[7];
    left.take(id);
    left.take(v);
    left.take(camera);
    std::string why, name = left.take_name();
    std::uint64_t features = 0;
    left.take(features);
    constexpr std::size_t kFeature = 24;  // bytes: x, y, and the id of a point
    left.skip(features, kFeature);
    const auto pose = pose_of_colmap(v, why);
    if (!pose) throw Error(path.string() + ": image " + std::to_string(id) + ": " + why);
    images.push_back({std::move(name), *pose, camera});
  }
  return images;
}

}  // namespace sslam::io
