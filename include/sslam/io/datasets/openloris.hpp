// SPDX-License-Identifier: BSD-3-Clause
// The layout of OpenLORIS-Scene (Shi et al., ICRA 2020): color.txt and aligned_depth.txt with rows of `stamp
// file`, sensors.yaml, and the poses of the robot's base, on which trans_matrix.yaml places the camera.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sslam/core/error.hpp"
#include "sslam/core/text_tree.hpp"
#include "sslam/io/datasets/body_poses.hpp"
#include "sslam/io/datasets/dataset.hpp"
#include "sslam/io/datasets/dataset_filling.hpp"
#include "sslam/io/datasets/file_list.hpp"
#include "sslam/io/datasets/tum.hpp"
#include "sslam/io/files/files.hpp"
#include "sslam/io/files/plain_text.hpp"
#include "sslam/io/trajectories/read_trajectory.hpp"

namespace sslam::io {

namespace openloris_detail {

// Of the tree's lists of transforms, the one between these frames. Throws Error where there is none.
[[nodiscard]] inline SE3<double> parent_from_child(const std::filesystem::path& file, std::string_view parent,
                                                   std::string_view child) {
  const TextNode root = TextTree::parse(read_plain_text(file), file.string());
  const auto names = [](const TextNode& entry, std::string_view key, std::string_view name) {
    const TextNode* const node = entry.find(key);
    return node != nullptr && node->text == name;
  };
  for (const TextNode& list : root.items)
    for (const TextNode& entry : list.items) {
      if (!names(entry, "parent_frame", parent) || !names(entry, "child_frame", child)) continue;
      const TextNode* const matrix = entry.find("matrix");
      const TextNode* const data = matrix == nullptr ? nullptr : matrix->find("data");
      std::vector<double> v;
      if (data != nullptr)
        for (const TextNode& number : data->items) v.push_back(sslam::number_of(number.text).value_or(0));
      std::string why = "expected a 4x4 matrix";
      const auto pose = v.size() == 16 ? pose_of_matrix(v, why) : std::nullopt;
      if (!pose) throw Error(file.string() + ": " + std::string(child) + ": " + why);
      return *pose;
    }
  throw Error(file.string() + ": does not say where " + std::string(child) + " is on " + std::string(parent));
}

}  // namespace openloris_detail

[[nodiscard]] inline bool is_openloris(const std::filesystem::path& root) {
  return !first_file({root / "color.txt"}).empty() &&
         !first_file({root / "aligned_depth.txt", root / "sensors.yaml"}).empty();
}

[[nodiscard]] inline Dataset read_openloris(const std::filesystem::path& root) {
  constexpr double kMillimetres = 1000;
  Dataset dataset;
  dataset.layout = Layout::kOpenLoris;
  dataset.root = root;
  dataset.depth_factor = kMillimetres;
  const std::filesystem::path list = root / "color.txt", transforms = root / "trans_matrix.yaml";
  take_listed_frames(dataset, read_file_list(list, root, dataset.warnings), list);
  if (const auto depth = first_file({root / "aligned_depth.txt"}); !depth.empty())
    attach_depth(dataset, depth, read_file_list(depth, root, dataset.warnings));
  dataset.camera_file = first_file({root / "sensors.yaml"});
  const auto truth = first_file({root / "groundtruth.txt"});
  if (truth.empty()) return dataset;
  attach_or_leave_out(dataset, [&] {
    if (first_file({transforms}).empty())
      throw Error(truth.string() + ": holds the poses of the robot's base, and without " +
                  transforms.string() + " the camera's are not known");
    const SE3<double> base_from_cam =
        openloris_detail::parent_from_child(transforms, "base_link", "d400_color_optical_frame");
    attach_body_truth(dataset, read_trajectory(truth, dataset.warnings), base_from_cam, truth);
  });
  return dataset;
}

}  // namespace sslam::io
