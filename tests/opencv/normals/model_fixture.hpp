// SPDX-License-Identifier: BSD-3-Clause
// What the tests of networks share: the fixtures' folder, changed manifests, and a picture with a colour in
// every corner.
#pragma once

#include <cmath>
#include <filesystem>
#include <fstream>
#include <opencv2/core.hpp>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "sslam/opencv/normals/onnx_normals.hpp"
#include "support/scratch_folder.hpp"

namespace sslam::test {

using Changes = std::vector<std::pair<std::string, std::string>>;

inline std::filesystem::path fixtures() {
  return std::filesystem::absolute(__FILE__).parent_path().parent_path() / "fixtures";
}

// `manifest` with pieces of its text replaced, beside a copy of nothing: the model stays where it is.
inline std::filesystem::path changed(const testing::ScratchFolder& folder,
                                     const std::filesystem::path& manifest, const Changes& changes) {
  std::string text = testing::text_of(manifest);
  const std::string model = manifest.stem().string() + ".onnx";
  Changes all{{"\"" + model + "\"", "\"" + (manifest.parent_path() / model).string() + "\""}};
  all.insert(all.begin(), changes.begin(), changes.end());
  for (const auto& [from, to] : all) {
    const auto at = text.find(from);
    if (at != std::string::npos)
      text.replace(at, from.size(), to);
    else if (&from != &all.back().first)
      throw std::logic_error("not in the manifest: " + from);
  }
  const std::filesystem::path out = folder.path() / "changed.json";
  std::ofstream(out) << text;
  return out;
}

inline Camera<double> camera(int width, int height, double focal) {
  return {{focal, focal, 0.5 * (width - 1), 0.5 * (height - 1)}, {}, width, height};
}

inline bool near(double a, double b, double tolerance = 1e-6) {
  return std::abs(a - b) <= tolerance;
}

// Blue grows to the right, green downwards, red along a diagonal.
inline cv::Mat coloured(int width, int height) {
  cv::Mat_<cv::Vec3b> image(height, width);
  for (int v = 0; v < height; ++v)
    for (int u = 0; u < width; ++u)
      image(v, u) = {cv::saturate_cast<std::uint8_t>(255.0 * u / width),
                     cv::saturate_cast<std::uint8_t>(255.0 * v / height),
                     cv::saturate_cast<std::uint8_t>(255.0 * (u + height - v) / (width + height))};
  return image;
}

// Largest angle, in degrees, between two dense answers where both have a normal.
inline double difference_deg(const DenseNormals& a, const DenseNormals& b) {
  double worst = 0;
  for (int v = 0; v < a.normal.rows; ++v)
    for (int u = 0; u < a.normal.cols; ++u) {
      const cv::Vec3f &x = a.normal(v, u), &y = b.normal(v, u);
      if (x == cv::Vec3f() || y == cv::Vec3f()) continue;
      worst = std::max(worst, degrees(std::atan2(cv::norm(x.cross(y)), static_cast<double>(x.dot(y)))));
    }
  return worst;
}

}  // namespace sslam::test
