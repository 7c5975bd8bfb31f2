// SPDX-License-Identifier: BSD-3-Clause
// The lens that a calibration names: the words of many programs for one model, and how to go on from a model
// that sslam does not have.
#pragma once

#include <algorithm>
#include <array>
#include <cctype>
#include <string>
#include <string_view>
#include <vector>

#include "sslam/opencv/camera/camera_keys.hpp"

namespace sslam {
namespace detail {

enum class LensModel { kNone, kRadTan, kRational, kFisheye, kOther };

// Small letters and digits alone: RADIAL-TANGENTIAL and radial_tangential are one word.
[[nodiscard]] inline std::string plain_word(std::string_view text) {
  std::string word;
  for (const char c : text)
    if (std::isalnum(static_cast<unsigned char>(c)) != 0)
      word += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return word;
}

[[nodiscard]] inline LensModel lens_model(std::string_view text) {
  const std::string word = plain_word(text);
  const auto is = [&word](std::initializer_list<std::string_view> words) {
    return std::find(words.begin(), words.end(), word) != words.end();
  };
  if (is({"", "none", "simplepinhole", "rectified", "nodistortion"})) return LensModel::kNone;
  if (is({"radtan", "radialtangential", "plumbbob", "opencv", "brown", "brownconrady", "pinhole",
          "perspective", "radial", "simpleradial", "distortionbrownconrady", "modifiedbrownconrady",
          "distortionmodifiedbrownconrady"}))
    return LensModel::kRadTan;
  if (is({"rationalpolynomial", "rational", "fullopencv"})) return LensModel::kRational;
  if (is({"fisheye", "equidistant", "equi", "opencvfisheye", "kannalabrandt", "kannalabrandt4",
          "kannalabrandt8", "kb4", "kb8", "simpleradialfisheye", "radialfisheye",
          "distortionkannalabrandt4"}))
    return LensModel::kFisheye;
  return LensModel::kOther;
}

[[noreturn]] inline void refuse_lens(const CameraKeys& keys, const std::string& model) {
  keys.fail(
      "the lens model '" + model +
      "' is not known here; expected a pinhole with radial-tangential distortion: undistort the images, or "
      "calibrate the camera with sslam calibrate");
}

// `values`: k1 k2 p1 p2 k3 k4 k5 k6 and on, in OpenCV's order, or as many of them as there are.
inline void set_lens(const CameraKeys& keys, const std::string& model, const std::vector<double>& values,
                     RadTan<double>& lens) {
  const LensModel known = lens_model(model);
  const bool straight = std::all_of(values.begin(), values.end(), [](double value) { return value == 0; });
  if (known == LensModel::kOther || known == LensModel::kFisheye) refuse_lens(keys, model);
  if (straight) return;
  if (known == LensModel::kNone)
    keys.fail("the lens model '" + model + "' has no distortion, but coefficients that are not 0; expected " +
              "the model that they belong to");
  if (std::any_of(values.begin() + std::min<std::ptrdiff_t>(5, std::ssize(values)), values.end(),
                  [](double value) { return value != 0; }))
    refuse_lens(keys, values.size() > 8 ? "thin prism" : "rational (k4, k5, k6)");
  const std::array<double*, 5> targets{&lens.k1, &lens.k2, &lens.p1, &lens.p2, &lens.k3};
  for (std::size_t i = 0; i < std::min(targets.size(), values.size()); ++i) *targets[i] = values[i];
}

}  // namespace detail
}  // namespace sslam
