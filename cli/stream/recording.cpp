// SPDX-License-Identifier: BSD-3-Clause
#include "cli/stream/recording.hpp"

#include <string_view>
#include <utility>

#include "cli/input/camera_yaml.hpp"
#include "cli/input/image_file.hpp"
#include "sslam/io/files/output_file.hpp"
#include "sslam/io/files/text.hpp"

namespace sslam::cli {
namespace {

namespace fs = std::filesystem;

const char* extension_of(ImageFormat format) {
  switch (format) {
    case ImageFormat::kJpeg:
      return ".jpg";
    case ImageFormat::kPng:
      return ".png";
    case ImageFormat::kWebp:
      return ".webp";
    case ImageFormat::kBmp:
      return ".bmp";
    case ImageFormat::kPnm:
      return ".ppm";
    default:
      return nullptr;
  }
}

}  // namespace

Recording::Recording(fs::path folder) : folder_(std::move(folder)) {
  std::error_code ignored;
  if (fs::exists(folder_, ignored) && !(fs::is_directory(folder_, ignored) && fs::is_empty(folder_, ignored)))
    throw Error("--record " + folder_.string() + ": already exists; choose a new folder");
  io::prepare_output_folder(folder_ / "rgb");
  list_.open(folder_ / "rgb.txt", std::ios::binary | std::ios::trunc);
  list_ << "# recorded by sslam run --record: stamp in seconds, image\n" << std::flush;
  if (!list_) throw Error("--record " + folder_.string() + ": cannot write rgb.txt");
}

void Recording::keep_camera(const CameraFile& camera) {
  constexpr int kExact = 17;
  io::write_text(folder_ / "camera.yaml", camera_yaml(camera, "", kExact));
}

void Recording::add(double stamp, const SourceFrame& frame, std::string& warning) {
  if (over_) return;
  try {
    write(stamp, frame);
  } catch (const Error& error) {
    over_ = true;
    warning = std::string("--record: ") + error.what() + "; the recording ends here";
  }
}

void Recording::write(double stamp, const SourceFrame& frame) {
  const char* const extension =
      frame.file.empty() ? nullptr : extension_of(read_image_header(frame.file).format);
  const std::string name = "rgb/" + io::exact_decimal(stamp) + (extension != nullptr ? extension : ".png");
  if (extension != nullptr) {
    const std::string_view bytes(reinterpret_cast<const char*>(frame.file.data()), frame.file.size());
    io::write_text(folder_ / name, bytes);
  } else {
    write_image(folder_ / name, frame.image, fast_png());
  }
  list_ << io::exact_decimal(stamp) << ' ' << name << '\n' << std::flush;
  if (!list_) throw Error((folder_ / "rgb.txt").string() + ": cannot write");
}

}  // namespace sslam::cli
