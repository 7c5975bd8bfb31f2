// SPDX-License-Identifier: BSD-3-Clause
// Depth and normals of the keyframes by the model of `--dense`, with lists and a camera as TUM RGB-D has
// them.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "cli/input/camera_yaml.hpp"
#include "cli/input/image_file.hpp"
#include "cli/input/normal_files.hpp"
#include "cli/results/image_paths.hpp"
#include "cli/results/keyframe_images.hpp"
#include "cli/results/run_camera.hpp"
#include "cli/results/run_folder.hpp"
#include "cli/results/scale_record.hpp"
#include "cli/results/straight_view.hpp"
#include "sslam/dense/depth_raster.hpp"
#include "sslam/io/files/text.hpp"

namespace sslam::cli {

inline constexpr double kDepthUnits = 5000;      // of the images, in a unit of the map, as TUM RGB-D has them
inline constexpr double kFarthestUnits = 65535;  // what 16 bits hold
inline constexpr double kModelNormalSigmaDeg = 0.6;  // of a plane as a whole: the median in a rendered room

struct DepthCounts {
  std::size_t keyframes = 0;
  std::size_t strangers = 0;  // keyframes of an earlier run: left out
  std::size_t missing = 0;    // images that are not where the run has found them: in no row of rgb.txt
  std::size_t pixels = 0, with_depth = 0, too_far = 0;

  // What was written.
  [[nodiscard]] std::string text() const {
    const auto percent = std::lround(100.0 * static_cast<double>(with_depth) /
                                     static_cast<double>(std::max<std::size_t>(pixels, 1)));
    return "depth, normals (" + std::to_string(keyframes) + " keyframes, depth in " +
           std::to_string(percent) + " % of the pixels), " + (missing < keyframes ? "rgb.txt, " : "") +
           "depth.txt, normals.txt, keyframes.txt, camera.yaml";
  }
};

namespace depth_detail {

// What a camera sees of the model, pixel by pixel.
class Painter {
 public:
  cv::Mat_<std::uint16_t> depth;  // of the last keyframe; 0: no surface, or too far
  cv::Mat_<cv::Vec3b> normals;

  Painter(const TexturedMesh& mesh, const Camera<double>& camera)
      : depth(camera.height, camera.width), normals(depth.size()), mesh_(mesh), view_(camera) {}

  void paint(const SE3<double>& cam_from_world, DepthCounts& counts) {
    raster_.begin(view_.pinhole, view_.width, view_.height);
    const auto corner = [&](std::size_t i) -> Vec3<double> {
      return cam_from_world * mesh_.places[mesh_.indices[i]].cast<double>();
    };
    for (std::size_t i = 0; i + 2 < mesh_.indices.size(); i += 3)
      raster_.add(corner(i), corner(i + 1), corner(i + 2));
    for (int v = 0; v < depth.rows; ++v)
      for (int u = 0; u < depth.cols; ++u) paint(u, v, counts);
    counts.pixels += depth.total();
  }

 private:
  void paint(int u, int v, DepthCounts& counts) {
    depth(v, u) = 0;
    normals(v, u) = no_normal();
    const Vec2<double>& place = view_.place(u, v);
    const dense::DepthRaster::Surface* const surface = raster_.at(place);
    if (surface == nullptr) return;
    const double inverse = surface->inverse_depth(place);
    if (!(inverse > 0)) return;  // at the end of a surface that is seen along its plane
    const Vec3<float> n = surface->normal.cast<float>();
    normals(v, u) = encode_normal({n.x(), n.y(), n.z()});
    const double units = std::round(kDepthUnits / inverse);
    if (units > kFarthestUnits) {
      ++counts.too_far;
      return;
    }
    depth(v, u) = static_cast<std::uint16_t>(units);
    ++counts.with_depth;
  }

  const TexturedMesh& mesh_;
  StraightView view_;
  dense::DepthRaster raster_;
};

// The first line of depth.txt, by which a folder of an earlier export is known.
inline constexpr const char* kListStart = "# depth by the model of a run of sslam, 5000 units to ";

// Lists of `stamp file`.
class FileLists {
 public:
  void add(double stamp, const std::string& image, const std::string& file) {
    const std::string start = io::exact_decimal(stamp) + " ";
    if (!image.empty()) rgb_ += start + image + "\n";
    depth_ += start + "depth/" + file + "\n";
    normals_ += start + "normals/" + file + "\n";
  }
  void write(const std::filesystem::path& folder, bool metric) const {
    const std::string head = "# timestamp filename\n",
                      start = kListStart + std::string(metric ? "the metre\n" : "the map's unit\n");
    if (!rgb_.empty()) io::write_text(folder / "rgb.txt", head + rgb_);
    io::write_text(folder / "depth.txt", start + head + depth_);
    io::write_text(folder / "normals.txt", head + normals_);
  }

 private:
  std::string rgb_, depth_, normals_;
};

}  // namespace depth_detail

// Folders take the place of those of the same name: a dataset is not written over. Throws Error.
inline void claim_depth_folder(const std::filesystem::path& out) {
  std::error_code ignored;
  const std::filesystem::path list = out / "depth.txt";
  if (std::filesystem::exists(list, ignored) && io::read_text(list).starts_with(depth_detail::kListStart))
    return;
  for (const char* name : {"depth.txt", "rgb.txt", "depth", "normals", kStraightFolder})
    if (std::filesystem::exists(out / name, ignored))
      throw Error(out.string() + ": holds " + name +
                  ", which no such export has made; choose another folder");
}

// Into `stage`, from where the files are brought to `out`: images are named as seen from there. straight: of
// the images that write_straight_images writes into `images` beside it, else of those of the lens. Throws
// Error.
inline DepthCounts write_depth_export(const RunFolder& run, const std::filesystem::path& stage,
                                      const std::filesystem::path& out, bool straight) {
  namespace fs = std::filesystem;
  DepthCounts counts;
  Camera<double> camera = camera_of(run);
  if (straight) camera.distortion = {};
  const KeyframeImages images = keyframe_images(run);
  const ImagePaths paths(run, out, straight);
  std::vector<const Keyframe<double>*> keyframes;
  for (const auto& keyframe : run.map.keyframes) {
    if (!keyframe.alive()) continue;
    if (images.known[Map<double>::index(keyframe.id)])
      keyframes.push_back(&keyframe);
    else
      ++counts.strangers;
  }
  std::stable_sort(keyframes.begin(), keyframes.end(),
                   [](const auto* a, const auto* b) { return a->frame.stamp < b->frame.stamp; });
  for (const char* folder : {"depth", "normals"}) fs::create_directories(stage / folder);
  depth_detail::Painter painter(run.surfaces, camera);
  depth_detail::FileLists lists;
  io::Trajectory poses;
  for (const Keyframe<double>* const keyframe : keyframes) {
    const std::string& name = images.names[Map<double>::index(keyframe->id)];
    const std::string file = fs::path(name).stem().string() + ".png", image = paths.of(name);
    painter.paint(keyframe->cam_from_world, counts);
    write_image(stage / "depth" / file, painter.depth, fast_png());
    write_image(stage / "normals" / file, painter.normals, fast_png());
    counts.missing += image.empty() ? 1U : 0U;
    lists.add(keyframe->frame.stamp, image, file);
    poses.push_back({keyframe->frame.stamp, keyframe->cam_from_world.inverse()});
  }
  counts.keyframes = keyframes.size();
  lists.write(stage, is_metric(run.metrics));
  write_normal_encoding(stage / "normals", kModelNormalSigmaDeg);
  io::write_text(stage / "camera.yaml", camera_yaml({camera, kDepthUnits, 0, {}}, ""));
  io::write_trajectory(stage / "keyframes.txt", poses, is_metric(run.metrics) ? "unit: metres" : "");
  return counts;
}

}  // namespace sslam::cli
