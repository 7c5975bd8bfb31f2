// SPDX-License-Identifier: BSD-3-Clause
// The words of many programs for one model of a lens.
#pragma once

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <initializer_list>
#include <string>
#include <string_view>

namespace sslam {
namespace detail {

enum class LensModel {
  kNone,
  kRadTan,
  kInverseRadTan,
  kRational,
  kFisheye,
  kFov,
  kOmni,
  kDoubleSphere,
  kUnified,
  kOther
};

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
  if (is({"inversebrownconrady", "distortioninversebrownconrady"})) return LensModel::kInverseRadTan;
  if (is({"fov", "atan"})) return LensModel::kFov;
  if (is({"omni", "mei", "omnidirectional"})) return LensModel::kOmni;
  if (is({"ds", "doublesphere"})) return LensModel::kDoubleSphere;
  if (is({"eucm", "extendedunified"})) return LensModel::kUnified;
  return LensModel::kOther;
}

// How many numbers Kalibr's wide models have before fx: xi; xi, alpha; alpha, beta. 0: another model.
[[nodiscard]] constexpr std::size_t count_before_focal(LensModel model) noexcept {
  if (model == LensModel::kOmni) return 1;
  return model == LensModel::kDoubleSphere || model == LensModel::kUnified ? 2 : 0;
}

}  // namespace detail
}  // namespace sslam
