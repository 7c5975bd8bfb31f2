// SPDX-License-Identifier: BSD-3-Clause
// transforms.json of nerfstudio, instant-ngp, Record3D and Polycam: a file and a 4x4 matrix a frame, camera
// to world, in the camera axes of OpenGL: y up, z backwards.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sslam/core/text_tree.hpp"
#include "sslam/io/files/bad_entries.hpp"
#include "sslam/io/files/date_stamps.hpp"
#include "sslam/io/files/files.hpp"
#include "sslam/io/files/plain_text.hpp"
#include "sslam/io/trajectories/pose_row.hpp"

namespace sslam::io {

struct TransformsFrame {
  double stamp = 0;
  bool has_stamp = false;
  std::string file, depth;                    // as written; depth may be empty
  std::optional<SE3<double>> world_from_cam;  // in our axes; empty: none
};

struct Transforms {
  std::vector<TransformsFrame> frames;  // in natural order of their files, by stamp where all have one
  bool stamped = false;
  std::size_t no_pose = 0;
  BadEntries bad_poses;  // of frames without a pose here; to be settled by who needs poses
};

namespace transforms_detail {

[[nodiscard]] inline std::string text_at(const TextNode& frame, std::string_view key) {
  const TextNode* node = frame.find(key);
  return node != nullptr && node->kind == TextNode::Kind::kScalar ? node->text : std::string();
}

inline void add_numbers(const TextNode& node, std::vector<double>& numbers) {
  if (node.kind == TextNode::Kind::kScalar)
    numbers.push_back(sslam::number_of(node.text).value_or(std::nan("")));
  for (const TextNode& item : node.items) add_numbers(item, numbers);
}

// Turns the camera by half about its x axis.
[[nodiscard]] inline SE3<double> from_opengl(SE3<double> pose) {
  pose.rotation = pose.rotation * SO3<double>::from_quaternion(0, 1, 0, 0);
  return pose;
}

}  // namespace transforms_detail

[[nodiscard]] inline bool is_transforms_text(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  return first != std::string_view::npos && text[first] == '{' &&
         text.find("\"frames\"") != std::string_view::npos;
}

// In natural order of the files, by stamp where all have one.
inline void order_transforms(Transforms& transforms) {
  const auto stamped = [](const TransformsFrame& frame) { return frame.has_stamp; };
  transforms.stamped = std::all_of(transforms.frames.begin(), transforms.frames.end(), stamped);
  std::stable_sort(transforms.frames.begin(), transforms.frames.end(),
                   [&transforms](const TransformsFrame& a, const TransformsFrame& b) {
                     return transforms.stamped ? a.stamp < b.stamp : natural_less(a.file, b.file);
                   });
}

// A few frames that cannot be read are skipped with a warning each. Throws Error in one line.
[[nodiscard]] inline Transforms read_transforms(const std::filesystem::path& path, Warnings& warnings) {
  const std::string text = read_plain_text(path);
  const TextNode root = TextTree::parse(text, path.string());
  const TextNode* frames = root.find("frames");
  if (frames == nullptr || frames->kind != TextNode::Kind::kList || frames->items.empty())
    throw Error(path.string() + ": lists no frame; expected \"frames\" with file_path and transform_matrix");
  Transforms result{{}, false, 0, BadEntries(path)};
  BadEntries bad(path);
  for (const TextNode& node : frames->items) {
    TransformsFrame frame;
    frame.file = transforms_detail::text_at(node, "file_path");
    frame.depth = transforms_detail::text_at(node, "depth_file_path");
    if (frame.file.empty()) {
      bad.add(node.line, "the frame has no file_path");
      continue;
    }
    const std::string time = transforms_detail::text_at(node, "timestamp");
    const auto number = sslam::number_of(time), stamp = number ? number : seconds_of_date(time);
    frame.has_stamp = stamp && std::isfinite(*stamp);
    if (frame.has_stamp) frame.stamp = *stamp;
    if (const TextNode* matrix = node.find("transform_matrix")) {
      std::vector<double> v;
      transforms_detail::add_numbers(*matrix, v);
      std::string why = "transform_matrix has " + std::to_string(v.size()) + " numbers; expected 4x4";
      const bool whole = v.size() == 12 || v.size() == 16;
      if (whole && means_no_pose(v)) {
        ++result.no_pose;
      } else if (const auto pose = whole ? pose_of_matrix(v, why) : std::nullopt) {
        frame.world_from_cam = transforms_detail::from_opengl(*pose);
      } else {
        result.bad_poses.add(node.line, why);
      }
    }
    result.frames.push_back(std::move(frame));
  }
  bad.settle(frames->items.size(), warnings);
  order_transforms(result);
  return result;
}

}  // namespace sslam::io
