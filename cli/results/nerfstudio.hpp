// SPDX-License-Identifier: BSD-3-Clause
// A run as nerfstudio's dataset: transforms.json with the camera and the keyframes' poses, and points.ply.
// Its cameras look along -z with y up, its world has z up, and pixels count from the corner of the first one.
#pragma once

#include <array>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "cli/results/image_paths.hpp"
#include "cli/results/keyframe_images.hpp"
#include "cli/results/run_camera.hpp"
#include "cli/results/run_folder.hpp"
#include "cli/results/straight_images.hpp"
#include "sslam/io/files/text.hpp"
#include "sslam/io/maps/map_writer.hpp"

namespace sslam::cli {

struct NerfstudioCounts {
  std::size_t images = 0;
  std::size_t missing = 0;    // of them, those whose file is not where the run has found it
  std::size_t strangers = 0;  // keyframes of an earlier run: left out
  std::size_t points = 0;
};

namespace nerfstudio_detail {

using Json = nlohmann::ordered_json;

inline Vec3<double> z_up(const Vec3<double>& x) {
  return {x.x(), x.z(), -x.y()};
}

inline Json matrix_of(const SE3<double>& world_from_cam) {
  const Mat3<double> axes = world_from_cam.rotation.matrix();
  const Vec3<double> columns[] = {z_up(axes.col(0)), z_up(-axes.col(1)), z_up(-axes.col(2)),
                                  z_up(world_from_cam.translation)};
  Json rows = Json::array();
  for (int r = 0; r < 3; ++r) rows.push_back({columns[0][r], columns[1][r], columns[2][r], columns[3][r]});
  rows.push_back({0.0, 0.0, 0.0, 1.0});
  return rows;
}

inline Json json_of(const Camera<double>& camera) {
  const Pinhole<double>& pinhole = camera.pinhole;
  const RadTan<double>& lens = camera.distortion;
  return {{"camera_model", "OPENCV"},
          {"fl_x", pinhole.fx},
          {"fl_y", pinhole.fy},
          {"cx", pinhole.cx + 0.5},
          {"cy", pinhole.cy + 0.5},
          {"w", camera.width},
          {"h", camera.height},
          {"k1", lens.k1},
          {"k2", lens.k2},
          {"k3", lens.k3},
          {"p1", lens.p1},
          {"p2", lens.p2},
          {"ply_file_path", "points.ply"}};
}

}  // namespace nerfstudio_detail

// Into `stage`, from where the files are brought to `out`: images are named as seen from there. straight: by
// those that write_straight_images writes into `images` beside it. Throws Error.
inline NerfstudioCounts write_nerfstudio(const RunFolder& run, const std::filesystem::path& stage,
                                         const std::filesystem::path& out, bool straight) {
  namespace detail = nerfstudio_detail;
  NerfstudioCounts counts;
  Camera<double> camera = camera_of(run);
  const KeyframeImages images = keyframe_images(run);
  if (straight) camera.distortion = {};
  const ImagePaths paths(run, out, straight);
  detail::Json json = detail::json_of(camera);
  json["frames"] = detail::Json::array();
  for (const auto& keyframe : run.map.keyframes) {
    if (!keyframe.alive()) continue;
    const std::size_t id = Map<double>::index(keyframe.id);
    if (!images.known[id]) {
      ++counts.strangers;
      continue;
    }
    ++counts.images;
    std::string path = paths.of(images.names[id]);
    if (path.empty()) {
      path = (std::filesystem::path(kStraightFolder) / images.names[id]).generic_string();
      ++counts.missing;
    }
    json["frames"].push_back(
        {{"file_path", path}, {"transform_matrix", detail::matrix_of(keyframe.cam_from_world.inverse())}});
  }
  try {
    io::write_text(stage / "transforms.json", json.dump(1) + "\n");
  } catch (const detail::Json::exception&) {  // with other names, the images would not be found
    throw Error(
        "transforms.json: a name of an image is not UTF-8, as JSON asks for; rename it, or use another "
        "--format");
  }
  std::vector<io::MapPoint> points;
  for (std::size_t i = 0; i < run.map.points.size(); ++i)
    if (run.map.points[i].alive)
      points.push_back({detail::z_up(run.map.points[i].position),
                        colour_at(run.colours.points, i).value_or(io::kNoColour)});
  io::write_map(stage / "points.ply", points, {});
  counts.points = points.size();
  return counts;
}

}  // namespace sslam::cli
