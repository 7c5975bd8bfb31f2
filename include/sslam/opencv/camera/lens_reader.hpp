// SPDX-License-Identifier: BSD-3-Clause
// The lens of a calibration: radial-tangential as it stands, other models fitted by one, or refused with the
// way out.
#pragma once

#include <algorithm>
#include <array>
#include <cstdio>
#include <string>
#include <vector>

#include "sslam/opencv/camera/camera_keys.hpp"
#include "sslam/opencv/camera/lens_fit.hpp"
#include "sslam/opencv/camera/lens_words.hpp"

namespace sslam {
namespace detail {

inline constexpr const char* kWayOut =
    "undistort the images to a pinhole, or calibrate the camera with sslam calibrate";

[[noreturn]] inline void refuse_lens(const CameraKeys& keys, const std::string& model) {
  keys.fail("the lens model '" + model +
            "' is not known here; expected radial-tangential, rational or fisheye: " + kWayOut);
}

// The first N; what is missing is 0, and what is beyond must be.
template <std::size_t N>
[[nodiscard]] std::array<double, N> leading(const CameraKeys& keys, const std::string& model,
                                            const std::vector<double>& values) {
  std::array<double, N> first{};
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (i < N)
      first[i] = values[i];
    else if (values[i] != 0)
      keys.fail("the lens model '" + model + "' has more coefficients than the " + std::to_string(N) +
                " that are known here; expected 0 for the others, or " + kWayOut);
  }
  return first;
}

[[nodiscard]] inline LensFit fit_model(const CameraKeys& keys, const std::string& model,
                                       const std::vector<double>& values, const Camera<double>& camera) {
  switch (lens_model(model)) {
    case LensModel::kFisheye:
      return fit_lens(camera, [k = leading<4>(keys, model, values)](const Vec2<double>& m) {
        return fisheye_sample(k, m);
      });
    case LensModel::kFov:
      return fit_lens(camera, [omega = leading<1>(keys, model, values)[0]](const Vec2<double>& m) {
        return fov_sample(omega, m);
      });
    case LensModel::kInverseRadTan: {
      const auto k = leading<5>(keys, model, values);
      return fit_lens(camera, [lens = RadTan<double>{k[0], k[1], k[2], k[3], k[4]}](const Vec2<double>& m) {
        return LensSample{lens.distort(m), m};
      });
    }
    default:
      return fit_lens(camera, [k = leading<14>(keys, model, values)](const Vec2<double>& m) {
        return rational_sample(k, m);
      });
  }
}

// The list of distortion coefficients, whatever programs call it; empty where there is none. One under
// another name is refused: a camera without its lens would be believed.
[[nodiscard]] inline std::vector<double> lens_list(const CameraKeys& keys) {
  static const CameraKeys::Names names{"distortion_coefficients",
                                       "Distortion_Coefficients",
                                       "distortion_coeffs",
                                       "distortion_coef",
                                       "distortion",
                                       "distCoeffs",
                                       "dist_coeffs",
                                       "dist_coeff",
                                       "dist_coefs",
                                       "dist_coef",
                                       "dist",
                                       "coefficients",
                                       "coeffs",
                                       "D",
                                       "d"};
  if (!keys.has_any(names))
    for (std::size_t i = 0; i < keys.map().keys.size(); ++i)
      if (keys.map().items[i].kind != TextNode::Kind::kScalar &&
          plain_word(keys.map().keys[i]).find("dist") != std::string::npos)
        keys.fail(keys.map().items[i], keys.map().keys[i],
                  "is not known here; expected " + std::string(names.front()));
  const std::vector<double> values = keys.numbers(names, "distortion coefficients");
  if (values.size() == 3 &&
      std::any_of(values.begin(), values.end(), [](double value) { return value != 0; }))
    keys.fail(keys.where() +
              "the distortion has 3 coefficients, which may be k1 k2 k3 or k1 k2 p1; expected k1 "
              "k2 p1 p2 k3, with 0 for those that the lens has not");
  return values;
}

// Whether an image of the lens can be undistorted to a pinhole's view, where no other lens comes near it.
[[nodiscard]] constexpr bool is_wide(LensModel model) noexcept {
  return model == LensModel::kFisheye || model == LensModel::kFov;
}

// Its plane and size are those of the file when all of it is read.
inline void set_wide_lens(const CameraKeys& keys, WideModel model, const std::array<double, 5>& k,
                          const std::string& reason, CameraFile& file) {
  file.wide.emplace();
  file.wide->model = model;
  file.wide->k = k;
  file.wide_reason = keys.file() + ": " + reason;
}

// `values` in the order of the model, or as many of them as there are; the file's pinhole and size are known
// by now, if it has them.
inline void set_lens(const CameraKeys& keys, const std::string& model, const std::vector<double>& values,
                     CameraFile& file) {
  const LensModel known = lens_model(model);
  const bool straight = std::all_of(values.begin(), values.end(), [](double value) { return value == 0; });
  if (known == LensModel::kOther || count_before_focal(known) > 0) refuse_lens(keys, model);
  if (straight && known != LensModel::kFisheye) return;
  if (known == LensModel::kNone)
    keys.fail("the lens model '" + model +
              "' has no distortion, and its coefficients are not 0; expected the name " + "of their model");
  const bool rational =
      known == LensModel::kRational ||
      (known == LensModel::kRadTan && values.size() > 5 &&
       std::any_of(values.begin() + 5, values.end(), [](double value) { return value != 0; }));
  RadTan<double>& lens = file.camera.distortion;
  if (!rational && known == LensModel::kRadTan) {
    const auto k = leading<5>(keys, model, values);
    lens = {k[0], k[1], k[2], k[3], k[4]};
    return;
  }
  const std::string name = "the lens model '" + (rational ? "rational" : model) + "'";
  if (file.camera.width == 0 || file.camera.height == 0)
    keys.fail(name + " is fitted within the image; expected its width and height beside it");
  const LensFit fit = fit_model(keys, rational ? "rational" : model, values, file.camera);
  const double bearable = std::max(0.5, 0.001 * file.camera.width);  // pixels
  if (!fit.covers && !is_wide(known)) keys.fail(name + " sees more than a pinhole can; " + kWayOut);
  char worst[32];
  std::snprintf(worst, sizeof worst, "%.2g", fit.worst);
  if (!fit.covers || fit.worst > bearable) {
    const std::string why =
        fit.covers ? " is not near a radial-tangential one: " + std::string(worst) + " pixels off; "
                   : " sees more than a pinhole can; ";
    if (!is_wide(known)) keys.fail(name + why + kWayOut);
    set_wide_lens(keys, known == LensModel::kFov ? WideModel::kFov : WideModel::kFisheye,
                  leading<5>(keys, model, values), name + why + kWayOut, file);
    return;
  }
  lens = fit.lens;
  file.notes.push_back(keys.file() + ": " + name + " is taken as radial-tangential, at most " + worst +
                       " pixels off within the image");
}

}  // namespace detail
}  // namespace sslam
