// SPDX-License-Identifier: BSD-3-Clause
// The manifest beside an ONNX model: what goes in, what comes out, and how that becomes normals in the camera
// frame.
#pragma once

#include <array>
#include <cmath>
#include <filesystem>
#include <initializer_list>
#include <opencv2/core.hpp>
#include <string>
#include <string_view>

#include "sslam/core/error.hpp"
#include "sslam/opencv/camera/storage_file.hpp"

namespace sslam {

// what() is one line that names the file and the field.
struct NormalModelError : Error {
  using Error::Error;
};

enum class NetworkOutput { kNormals, kDepth, kInverseDepth };

// Network value = (8 bit value - mean) * scale, per channel in the order of `rgb`.
struct NetworkInput {
  int width = 0, height = 0;  // pixels
  bool rgb = true;            // false: blue comes first
  std::array<double, 3> mean{0, 0, 0};
  std::array<double, 3> scale{1, 1, 1};
  double focal =
      0;  // pixels of the network's image; images of other cameras are warped to it. 0: only resized
};

struct NormalManifest {
  std::filesystem::path file;   // the manifest itself, for messages
  std::filesystem::path model;  // the ONNX file
  std::string sha256;           // of the model, 64 hexadecimal digits in lower case; empty: not told
  NetworkInput input;
  NetworkOutput kind = NetworkOutput::kNormals;
  std::string output;                   // name of the output with three channels, or of the depth
  std::array<int, 3> axis{0, 1, 2};     // the camera axis (x, y, z) that channels 0, 1 and 2 hold
  std::array<double, 3> sign{1, 1, 1};  // of channels 0, 1 and 2 against their axis
  std::array<double, 2> range{-1, 1};   // the output values that stand for -1 and 1
  double depth_scale = 1;               // metres of one unit of depth; of inverse depth: 1 / metres
  double plane_sigma_deg = 5;           // what the normals of one plane get wrong together (NormalField)
  std::string mask, confidence;         // names of outputs in [0, 1] with one channel; empty: none
};

namespace normal_manifest_detail {

inline constexpr double kLargest = 1e9;

class Reader {
 public:
  explicit Reader(std::filesystem::path file) : file_(std::move(file)) {}

  [[noreturn]] void fail(const std::string& field, const std::string& what) const {
    throw NormalModelError(file_.string() + ": " + field + ": " + what);
  }

  void only(const cv::FileNode& node, const std::string& where,
            std::initializer_list<std::string_view> known) const {
    if (!node.isMap()) fail(where, "missing, or not an object");
    for (const std::string& key : node.keys()) {
      bool found = false;
      for (const auto name : known) found = found || name == key;
      if (!found) fail(where + "." + key, "not known");
    }
  }

  [[nodiscard]] std::string text(const cv::FileNode& parent, const char* key, const std::string& where,
                                 const char* otherwise = nullptr) const {
    const cv::FileNode node = parent[key];
    const bool untold = node.empty() || (node.isString() && node.string().empty());
    if (untold && otherwise != nullptr) return otherwise;
    if (!node.isString() || node.string().empty()) fail(where + "." + key, "missing, or not a name");
    return node.string();
  }

  [[nodiscard]] int pixels(const cv::FileNode& parent, const char* key, const std::string& where) const {
    const cv::FileNode node = parent[key];
    const int value = node.isInt() ? static_cast<int>(node) : 0;
    if (value < 16 || value > 4096) fail(where + "." + key, "missing, or not a whole number from 16 to 4096");
    return value;
  }

  [[nodiscard]] double number(const cv::FileNode& parent, const char* key, const std::string& where,
                              double otherwise) const {
    const cv::FileNode node = parent[key];
    if (node.empty()) return otherwise;
    const double value = node.isInt() || node.isReal() ? node.real() : -1;
    if (!(value > 0 && value < kLargest)) fail(where + "." + key, "not a positive number");
    return value;
  }

  template <std::size_t N>
  void numbers(const cv::FileNode& parent, const char* key, const std::string& where,
               std::array<double, N>& values) const {
    const cv::FileNode node = parent[key];
    if (node.empty()) return;
    if (!node.isSeq() || node.size() != N)
      fail(where + "." + key, "not a list of " + std::to_string(N) + " numbers");
    for (std::size_t i = 0; i < N; ++i) {
      const cv::FileNode item = node[static_cast<int>(i)];
      if (!item.isInt() && !item.isReal()) fail(where + "." + key, "holds something that is no number");
      values[i] = item.real();
      if (!(std::abs(values[i]) < kLargest)) fail(where + "." + key, "holds a number beyond 1e9");
    }
  }

 private:
  std::filesystem::path file_;
};

inline NetworkInput read_input(const cv::FileNode& node, const Reader& reader) {
  reader.only(node, "input", {"name", "width", "height", "channels", "mean", "scale", "focal"});
  NetworkInput input;
  input.width = reader.pixels(node, "width", "input");
  input.height = reader.pixels(node, "height", "input");
  const std::string channels = reader.text(node, "channels", "input");
  if (channels != "rgb" && channels != "bgr")
    reader.fail("input.channels", "'" + channels + "' is neither rgb nor bgr");
  input.rgb = channels == "rgb";
  reader.numbers(node, "mean", "input", input.mean);
  reader.numbers(node, "scale", "input", input.scale);
  for (const double scale : input.scale)
    if (!(scale > 0)) reader.fail("input.scale", "not positive");
  input.focal = reader.number(node, "focal", "input", 0);
  return input;
}

inline void read_axes(const cv::FileNode& node, const Reader& reader, NormalManifest& manifest) {
  const cv::FileNode axes = node["axes"];
  if (!axes.isSeq() || axes.size() != 3)
    reader.fail("output.axes", "missing, or not a list of three axes such as x, y, z");
  std::array<bool, 3> seen{};
  for (int i = 0; i < 3; ++i) {
    const std::string name = axes[i].isString() ? axes[i].string() : "";
    const std::size_t axis =
        name.size() == 1 ? std::string_view("xyz").find(name[0]) : std::string_view::npos;
    if (axis == std::string_view::npos || seen[axis])
      reader.fail("output.axes", "not x, y and z in some order");
    seen[axis] = true;
    manifest.axis[static_cast<std::size_t>(i)] = static_cast<int>(axis);
  }
  reader.numbers(node, "signs", "output", manifest.sign);
  for (const double sign : manifest.sign)
    if (sign != 1 && sign != -1) reader.fail("output.signs", "neither 1 nor -1");
  reader.numbers(node, "range", "output", manifest.range);
  if (!(manifest.range[0] < manifest.range[1]))
    reader.fail("output.range", "its first number is not the smaller one");
}

inline void read_output(const cv::FileNode& node, const Reader& reader, NormalManifest& manifest) {
  const std::string kind = node.isMap() ? reader.text(node, "kind", "output") : "";
  if (kind == "normals") {
    reader.only(node, "output",
                {"kind", "name", "axes", "signs", "range", "plane_sigma_deg", "mask", "confidence"});
    read_axes(node, reader, manifest);
  } else if (kind == "depth" || kind == "inverse_depth") {
    reader.only(node, "output", {"kind", "name", "scale", "plane_sigma_deg"});
    manifest.kind = kind == "depth" ? NetworkOutput::kDepth : NetworkOutput::kInverseDepth;
    manifest.depth_scale = reader.number(node, "scale", "output", 1);
  } else {
    reader.fail("output.kind", "'" + kind + "' is neither normals, depth nor inverse_depth");
  }
  manifest.output = reader.text(node, "name", "output");
  manifest.plane_sigma_deg = reader.number(node, "plane_sigma_deg", "output", manifest.plane_sigma_deg);
  manifest.mask = reader.text(node, "mask", "output", "");
  manifest.confidence = reader.text(node, "confidence", "output", "");
}

}  // namespace normal_manifest_detail

// Reads the JSON manifest (its fields: docs and the shipped planar_normals.json). Throws NormalModelError.
[[nodiscard]] inline NormalManifest read_normal_manifest(const std::filesystem::path& file) {
  const normal_manifest_detail::Reader reader(file);
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(file, ignored))
    throw NormalModelError(file.string() + ": no such manifest");
  cv::FileStorage storage;
  try {
    storage.open(read_storage_text(file),
                 cv::FileStorage::READ | cv::FileStorage::MEMORY | cv::FileStorage::FORMAT_JSON);
  } catch (const Error& error) {
    throw NormalModelError(error.what());
  } catch (const cv::Exception& error) {
    throw NormalModelError(file.string() + ": not JSON: " + error.err.substr(0, error.err.find('\n')));
  }
  if (!storage.isOpened()) throw NormalModelError(file.string() + ": cannot be read");
  const cv::FileNode root = storage.root();
  reader.only(root, "manifest", {"format", "model", "sha256", "input", "output"});
  if (reader.text(root, "format", "manifest") != "sslam-normals-1")
    reader.fail("manifest.format", "not sslam-normals-1");
  NormalManifest manifest;
  manifest.file = file;
  manifest.model = file.parent_path() / reader.text(root, "model", "manifest");
  manifest.sha256 = reader.text(root, "sha256", "manifest", "");
  if (!manifest.sha256.empty() &&
      (manifest.sha256.size() != 64 ||
       manifest.sha256.find_first_not_of("0123456789abcdef") != std::string::npos))
    reader.fail("manifest.sha256", "not 64 digits of 0-9 and a-f");
  manifest.input = normal_manifest_detail::read_input(root["input"], reader);
  normal_manifest_detail::read_output(root["output"], reader, manifest);
  return manifest;
}

}  // namespace sslam
