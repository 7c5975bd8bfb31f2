// SPDX-License-Identifier: BSD-3-Clause
// Camera files as ORB-SLAM writes them: OpenCV YAML with Camera.fx and so on (ORB-SLAM3's Camera1.fx is read
// too).
#pragma once

#include <cmath>
#include <filesystem>
#include <opencv2/core.hpp>
#include <opencv2/core/persistence.hpp>
#include <string>
#include <utility>

#include "sslam/core/error.hpp"
#include "sslam/geometry/camera.hpp"
#include "sslam/opencv/camera/storage_file.hpp"

namespace sslam {

struct CameraFile {
  Camera<double> camera;    // width and height are 0 when the file does not give them
  double depth_factor = 0;  // depth image units a metre; 0: not given
  double frame_rate = 0;    // frames a second; 0: not given
};

namespace detail {

// Reads numbers and names file, key and remedy when one is wrong.
class CameraKeys {
 public:
  CameraKeys(const cv::FileStorage& storage, std::string file) : storage_(storage), file_(std::move(file)) {}

  [[nodiscard]] bool has(const std::string& key) const { return !storage_[key].empty(); }

  [[nodiscard]] double required(const std::string& key, const std::string& meaning) const {
    if (!has(key)) throw Error(file_ + ": " + key + " is missing; expected " + meaning);
    return finite(key, meaning);
  }

  [[nodiscard]] double optional(const std::string& key, double otherwise, const std::string& meaning) const {
    return has(key) ? finite(key, meaning) : otherwise;
  }

  [[nodiscard]] double positive(const std::string& key, double value, const std::string& meaning) const {
    if (value > 0) return value;
    throw Error(file_ + ": " + key + " is " + short_text(value) + "; expected " + meaning +
                ", greater than 0");
  }

  // 0 when absent.
  [[nodiscard]] double optional_positive(const std::string& key, const std::string& meaning) const {
    return has(key) ? positive(key, finite(key, meaning), meaning) : 0;
  }

  // A width or height, 0 when absent.
  [[nodiscard]] int optional_pixels(const std::string& key) const {
    constexpr double kLargest = 65535;
    const std::string meaning = "a whole number of pixels";
    const double value = optional_positive(key, meaning);
    if (value <= kLargest && value == std::floor(value)) return static_cast<int>(value);
    throw Error(file_ + ": " + key + " is " + short_text(value) + "; expected " + meaning);
  }

  [[nodiscard]] std::string text(const std::string& key) const {
    const cv::FileNode node = storage_[key];
    return node.isString() ? static_cast<std::string>(node) : std::string();
  }

 private:
  [[nodiscard]] double finite(const std::string& key, const std::string& meaning) const {
    const cv::FileNode node = storage_[key];
    if (!node.isInt() && !node.isReal()) {
      throw Error(file_ + ": " + key + " is not a number; expected " + meaning);
    }
    const double value = static_cast<double>(node);
    if (!std::isfinite(value)) {
      throw Error(file_ + ": " + key + " is not finite; expected " + meaning);
    }
    return value;
  }

  [[nodiscard]] static std::string short_text(double value) { return cv::format("%g", value); }

  const cv::FileStorage& storage_;
  std::string file_;
};

// OpenCV would print its own lines and leave the stack in the message.
inline void open_yaml(cv::FileStorage& storage, const std::filesystem::path& path) {
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) throw Error(path.string() + ": no such camera file");
  if (!std::filesystem::is_regular_file(path, ignored)) {
    throw Error(path.string() + ": is not a file; expected a camera file");
  }
  const std::string text = read_storage_text(path);
  bool opened = false;
  try {
    opened =
        storage.open(text, cv::FileStorage::READ | cv::FileStorage::MEMORY | cv::FileStorage::FORMAT_YAML);
  } catch (const cv::Exception& error) {
    throw Error(path.string() + ": not a YAML file that OpenCV reads (" + error.err +
                "); expected '%YAML:1.0', '---', then lines such as 'Camera.fx: 535.4'");
  }
  if (!opened) throw Error(path.string() + ": cannot open this camera file");
  // OpenCV would end a look for a key in what has none by an assertion.
  for (int i = 0; !storage.root(i).empty(); ++i)
    if (!storage.root(i).isMap() && !storage.root(i).isNone())
      throw Error(path.string() +
                  ": holds a list or a value instead of keys; expected lines such as "
                  "'Camera.fx: 535.4'");
}

}  // namespace detail

// Throws Error, in one line, when the file cannot be read, is large or nested, or a key is missing, not a
// number, not finite or not positive where it must be.
[[nodiscard]] inline CameraFile read_camera_file(const std::filesystem::path& path) {
  cv::FileStorage storage;
  detail::open_yaml(storage, path);
  const detail::CameraKeys keys(storage, path.string());
  const std::string type = keys.text("Camera.type");
  if (!type.empty() && type != "PinHole" && type != "Pinhole") {
    throw Error(path.string() + ": Camera.type is '" + type + "'; expected 'PinHole'");
  }
  const bool numbered = keys.has("Camera1.fx") && !keys.has("Camera.fx");
  const std::string prefix = numbered ? "Camera1." : "Camera.";
  const std::string focal = "the focal length in pixels";
  const std::string centre = "the principal point in pixels";
  const std::string coefficient = "a distortion coefficient";
  CameraFile file;
  Pinhole<double>& pinhole = file.camera.pinhole;
  pinhole.fx = keys.positive(prefix + "fx", keys.required(prefix + "fx", focal), focal);
  pinhole.fy = keys.positive(prefix + "fy", keys.required(prefix + "fy", focal), focal);
  pinhole.cx = keys.required(prefix + "cx", centre);
  pinhole.cy = keys.required(prefix + "cy", centre);
  RadTan<double>& distortion = file.camera.distortion;
  distortion.k1 = keys.optional(prefix + "k1", 0, coefficient);
  distortion.k2 = keys.optional(prefix + "k2", 0, coefficient);
  distortion.p1 = keys.optional(prefix + "p1", 0, coefficient);
  distortion.p2 = keys.optional(prefix + "p2", 0, coefficient);
  distortion.k3 = keys.optional(prefix + "k3", 0, coefficient);
  file.camera.width = keys.optional_pixels("Camera.width");
  file.camera.height = keys.optional_pixels("Camera.height");
  file.frame_rate = keys.optional_positive("Camera.fps", "frames a second");
  const std::string factor_key = numbered ? "RGBD.DepthMapFactor" : "DepthMapFactor";
  file.depth_factor = keys.optional_positive(factor_key, "depth image units a metre");
  return file;
}

}  // namespace sslam
