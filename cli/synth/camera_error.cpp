// SPDX-License-Identifier: BSD-3-Clause
#include "cli/synth/camera_error.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <string_view>
#include <vector>

#include "sslam/io/files/text.hpp"

namespace sslam::cli {
namespace {

// The parts between commas, empty ones too.
std::vector<std::string> comma_parts(const std::string& text) {
  std::vector<std::string> parts;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t end = std::min(text.find(',', at), text.size());
    parts.push_back(text.substr(at, end - at));
    at = end + 1;
  }
  return parts;
}

std::string number_text(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", value);
  return text;
}

// Coefficients of lenses that exist lie well within.
constexpr double kLargestCoefficient = 2.0;

double largest_error(std::string_view name) {
  if (name == "focal") return 0.9;
  return name == "cx" || name == "cy" ? 1000.0 : kLargestCoefficient;
}

}  // namespace

std::string parse_camera_error(const std::string& text, CameraError& error) {
  const std::string example = "expected errors such as focal=0.05,k1=0.1, of focal, cx, cy, k1, k2, p1, p2";
  CameraError parsed;
  for (const std::string& part : comma_parts(text)) {
    const std::size_t equals = part.find('=');
    const std::string name = part.substr(0, equals);
    const auto* const known = std::find_if(kCameraErrorNames.begin(), kCameraErrorNames.end(),
                                           [&](const auto& each) { return name == each.first; });
    if (equals == std::string::npos || known == kCameraErrorNames.end())
      return "'" + part + "' is not an error of a camera; " + example;
    const std::optional<double> value = io::parse_number<double>(part.substr(equals + 1));
    const double most = largest_error(name);
    if (!value || !(std::abs(*value) <= most))
      return "'" + part + "' needs a number between " + number_text(-most) + " and " + number_text(most);
    parsed.*known->second = *value;
  }
  error = parsed;
  return {};
}

std::string camera_error_text(const CameraError& error) {
  std::string text;
  for (const auto& [name, member] : kCameraErrorNames) {
    if (error.*member == 0) continue;
    if (!text.empty()) text += ',';
    text += std::string(name) + '=' + number_text(error.*member);
  }
  return text;
}

Camera<double> with_error(Camera<double> camera, const CameraError& error) {
  camera.pinhole.fx *= 1 + error.focal;
  camera.pinhole.fy *= 1 + error.focal;
  camera.pinhole.cx += error.cx;
  camera.pinhole.cy += error.cy;
  camera.distortion.k1 += error.k1;
  camera.distortion.k2 += error.k2;
  camera.distortion.p1 += error.p1;
  camera.distortion.p2 += error.p2;
  return camera;
}

std::string parse_lens(const std::string& text, RadTan<double>& lens) {
  std::array<double, 4> k{};
  const std::vector<std::string> parts = comma_parts(text);
  bool good = parts.size() == 2 || parts.size() == 4;
  for (std::size_t i = 0; good && i < parts.size(); ++i) {
    const std::optional<double> value = io::parse_number<double>(parts[i]);
    good = value && std::abs(*value) <= kLargestCoefficient;
    if (good) k[i] = *value;
  }
  if (!good) return "'" + text + "' is not a lens such as -0.28,0.07 (k1,k2 or k1,k2,p1,p2; each within 2)";
  lens = {k[0], k[1], k[2], k[3], 0.0};
  return {};
}

std::string lens_text(const RadTan<double>& lens) {
  return number_text(lens.k1) + ',' + number_text(lens.k2) + ',' + number_text(lens.p1) + ',' +
         number_text(lens.p2);
}

}  // namespace sslam::cli
