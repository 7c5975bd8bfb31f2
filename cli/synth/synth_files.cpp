// SPDX-License-Identifier: BSD-3-Clause
#include "cli/synth/synth_files.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "cli/input/camera_yaml.hpp"
#include "cli/input/image_file.hpp"
#include "cli/input/normal_files.hpp"
#include "cli/results/result_set.hpp"
#include "cli/synth/synth_names.hpp"
#include "sslam/core/error.hpp"
#include "sslam/io/files/output_file.hpp"

namespace sslam::cli {
namespace {

namespace fs = std::filesystem;

std::string numbered(const char* folder, int number, const std::string& extension) {
  return cv::format("%s/%06d.%s", folder, number, extension.c_str());
}

void write_camera(const SynthSettings& settings, const Camera<double>& camera) {
  const auto write = [&](const char* name, const Camera<double>& content) {
    io::write_text(fs::path(settings.folder) / name,
                   camera_yaml({content, kDepthFactor, settings.rate, {}}, ""));
  };
  write("camera.yaml", with_error(camera, settings.camera_error));
  if (!camera_error_text(settings.camera_error).empty()) write("camera_true.yaml", camera);
}

// [[x, y], ...] as TOML has it.
std::string outline_text(const synth::Outline& outline) {
  std::string text;
  for (const Vec2<double>& corner : outline)
    text += cv::format("%s[%.6f, %.6f]", text.empty() ? "" : ", ", corner.x(), corner.y());
  return "[" + text + "]";
}

void write_manifest(const SynthSettings& s, const synth::Outline& outline, std::size_t frames) {
  std::string text =
      "# Made by `sslam synth`. Depth: 16 bits, 5000 a metre, 0 where nothing or beyond 13.1 m.\n"
      "# Normals: 8 bits, (x, y, z) = 2 v / 255 - 1 for red, green, blue; camera frame (x right, y down, z "
      "forward),\n"
      "# towards the camera; (0, 0, 0) where nothing is seen. Ground truth: world with z up, metres.\n"
      "# outline: x and y of the corners between the walls of a single room, counterclockwise from above.\n";
  text += cv::format("frames = %zu\nseed = %llu\n", frames, static_cast<unsigned long long>(s.house.seed));
  text += "texture = \"" + name_of(kRichnessNames, s.house.richness) + "\"\n";
  text += "world = \"" + name_of(kWorldNames, s.house.world) + "\"\n";
  text += "path = \"" + name_of(kPathNames, s.house.path) + "\"\n";
  const synth::PathOptions& motion = s.house.motion;
  text += cv::format("rooms = %d\nspeed = %g\ntremor = %g\nshake = %g\nstand = %g\n", s.house.rooms,
                     motion.speed, motion.tremor, motion.shake, motion.stand);
  text += cv::format("off-square = %g\ndoors-ajar = %s\nclutter = %d\n", s.house.off_square,
                     s.house.doors_ajar ? "true" : "false", s.house.clutter);
  if (!outline.empty()) text += "outline = " + outline_text(outline) + "\n";
  text += cv::format("fps = %g\nsize = \"%dx%d\"\nfocal = %g\n", s.rate, s.width, s.height, s.focal);
  text += cv::format("noise = %g\nvignetting = %g\nblur = %g\nexposure = %g\n", s.sensor.noise,
                     s.sensor.vignetting, s.blur, s.sensor.exposure_swing);
  text += cv::format("read-out = %g\nexposure-drift = %g\nwhite-balance-drift = %g\n", s.read_out,
                     s.sensor.exposure_drift, s.sensor.white_balance_drift);
  text += "lens = \"" + lens_text(s.lens) + "\"\n";
  if (const std::string error = camera_error_text(s.camera_error); !error.empty())
    text += "camera-error = \"" + error + "\"\n";
  text += "image-fixed = \"" + name_of(kImageFixedNames, s.image_fixed) + "\"\n";
  text += "image-format = \"" + s.image_format + "\"\n";
  text += cv::format("jpeg-quality = %d\n", s.jpeg_quality);
  text += cv::format("no-depth = %s\nno-normals = %s\n", s.depth ? "false" : "true",
                     s.normals ? "false" : "true");
  io::write_text(fs::path(s.folder) / "synth.toml", text);
}

}  // namespace

void claim_synth_folder(const std::string& name) {
  const fs::path folder = name;
  settle_results(folder);
  std::error_code ignored;
  if (fs::exists(folder / "rgb.txt", ignored) && !fs::exists(folder / "synth.toml", ignored))
    throw Error(name + ": holds a data set that sslam synth did not make; choose another folder");
  io::prepare_output_folder(folder);
}

void prepare_image_folders(const SynthSettings& settings) {
  const fs::path folder = settings.folder;
  io::prepare_output_folder(folder / "rgb");
  if (settings.depth) io::prepare_output_folder(folder / "depth");
  if (!settings.normals) return;
  io::prepare_output_folder(folder / "normals");
  write_normal_encoding(folder / "normals", 0);  // exact
}

void FrameWriter::write(int number, const synth::RenderedFrame& frame, const std::vector<std::uint8_t>& rgb) {
  const cv::Mat colour(frame.height, frame.width, CV_8UC3, const_cast<std::uint8_t*>(rgb.data()));
  cv::Mat bgr;
  cv::cvtColor(colour, bgr, cv::COLOR_RGB2BGR);
  draw_image_fixed(settings_.image_fixed, settings_.house.seed, number / settings_.rate, bgr);
  const bool png = settings_.image_format == "png";
  write_image(fs::path(settings_.folder) / numbered("rgb", number, settings_.image_format), bgr,
              png ? fast_png() : std::vector<int>{cv::IMWRITE_JPEG_QUALITY, settings_.jpeg_quality});
  if (settings_.depth) write_depth(numbered("depth", number, "png"), frame);
  if (settings_.normals) write_normals(numbered("normals", number, "png"), frame);
}

void FrameWriter::write_depth(const std::string& name, const synth::RenderedFrame& frame) {
  constexpr float kMost = 65535.0f;
  cv::Mat depth(frame.height, frame.width, CV_16UC1);
  std::uint16_t* out = depth.ptr<std::uint16_t>();
  for (const float inverse : frame.inverse_depth) {
    const float units = inverse > 0.0f ? static_cast<float>(kDepthFactor) / inverse + 0.5f : 0.0f;
    *out++ = units <= kMost ? static_cast<std::uint16_t>(units) : std::uint16_t{0};
  }
  write_image(fs::path(settings_.folder) / name, depth, fast_png());
}

void FrameWriter::write_normals(const std::string& name, const synth::RenderedFrame& frame) {
  std::vector<cv::Vec3b> encoded;
  for (const Vec3<float>& n : frame.normals) encoded.push_back(encode_normal({n.x(), n.y(), n.z()}));
  cv::Mat image(frame.height, frame.width, CV_8UC3);
  cv::Vec3b* out = image.ptr<cv::Vec3b>();
  for (const std::int32_t id : frame.surface)
    *out++ = id >= 0 ? encoded[static_cast<std::size_t>(id)] : cv::Vec3b();
  write_image(fs::path(settings_.folder) / name, image, fast_png());
}

void write_synth_lists(const SynthSettings& settings, const Camera<double>& camera,
                       const synth::Outline& outline, const io::Trajectory& truth) {
  const fs::path folder = settings.folder;
  const auto list = [&](const char* name, const std::string& extension) {
    std::string text = "# timestamp filename\n";
    for (std::size_t i = 0; i < truth.size(); ++i)
      text += cv::format("%.6f ", truth[i].stamp) + numbered(name, static_cast<int>(i), extension) + "\n";
    io::write_text(folder / (std::string(name) + ".txt"), text);
  };
  write_camera(settings, camera);
  write_manifest(settings, outline, truth.size());
  io::write_trajectory(folder / "groundtruth.txt", truth);
  if (settings.depth) list("depth", "png");
  if (settings.normals) list("normals", "png");
  list("rgb", settings.image_format);
}

}  // namespace sslam::cli
