// SPDX-License-Identifier: BSD-3-Clause
#include "cli/calibrate/calibration.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/calib3d.hpp>

#include "sslam/core/error.hpp"
#include "sslam/core/types.hpp"
#include "sslam/io/evaluation/statistics.hpp"

namespace sslam::cli {
namespace {

// What one call of OpenCV answers.
struct Fit {
  double error = 0;
  cv::Mat_<double> matrix, lens, sigmas, view_errors;
  std::vector<cv::Mat> rotations, translations;
};

constexpr const char* kTilt =
    "tilt the board by 20 to 45 degrees to all sides, near and far, and into the corners of the image";

Fit fit(const std::vector<BoardView>& views, cv::Size size, bool with_k3) {
  std::vector<std::vector<cv::Point3f>> board;
  std::vector<std::vector<cv::Point2f>> image;
  for (const BoardView& view : views) {
    board.push_back(view.board);
    image.push_back(view.image);
  }
  Fit fit;
  cv::Mat unused;
  try {
    fit.error = cv::calibrateCamera(board, image, size, fit.matrix, fit.lens, fit.rotations, fit.translations,
                                    fit.sigmas, unused, fit.view_errors, with_k3 ? 0 : cv::CALIB_FIX_K3);
  } catch (const cv::Exception&) {
    throw Error(std::string("the views do not determine a camera; ") + kTilt);
  }
  return fit;
}

double largest_tilt(const Fit& fit) {
  double largest = 0;
  for (const cv::Mat& rotation : fit.rotations) {
    cv::Mat_<double> matrix;
    cv::Rodrigues(rotation, matrix);
    largest = std::max(largest, std::acos(std::min(1.0, std::abs(matrix(2, 2)))));
  }
  return degrees(largest);
}

// The worst view, if it fits so much worse than the others that it must be wrong; else their number.
std::size_t find_outlier(const Fit& fit) {
  const std::vector<double> errors(fit.view_errors.begin(), fit.view_errors.end());
  const auto worst = std::max_element(errors.begin(), errors.end());
  const double usual = io::statistics_of(errors).median;
  constexpr double kFactor = 3,
                   kLeast = 0.3;  // pixels: below this a view is good, however good the others are
  const bool outlier = *worst > kFactor * usual && *worst > usual + kLeast;
  return outlier ? static_cast<std::size_t>(worst - errors.begin()) : errors.size();
}

void refuse_unconstrained(const Fit& fit, cv::Size size) {
  const double fx = fit.matrix(0, 0), fy = fit.matrix(1, 1);
  const double sigma = std::max(fit.sigmas(0) / fx, fit.sigmas(1) / fy);
  const bool sensible = std::isfinite(sigma) && fx > 0.1 * size.width && fx < 20.0 * size.width;
  constexpr double kLargestSigma = 0.01;  // of the focal length
  const double tilt = largest_tilt(fit);
  constexpr double kLeastTilt = 10;
  if (sensible && sigma < kLargestSigma && tilt > kLeastTilt) return;
  std::string why = "the views do not determine the focal length";
  if (tilt <= kLeastTilt)
    why += cv::format(": no board is tilted by more than %.0f degrees", tilt);
  else if (sensible)
    why += cv::format(" better than %.1f %%", 100 * sigma);
  throw Error(why + "; " + kTilt);
}

Camera<double> camera_of(const Fit& fit, cv::Size size) {
  Camera<double> camera;
  camera.pinhole = {fit.matrix(0, 0), fit.matrix(1, 1), fit.matrix(0, 2), fit.matrix(1, 2)};
  camera.distortion.k1 = fit.lens(0);
  camera.distortion.k2 = fit.lens(1);
  camera.distortion.p1 = fit.lens(2);
  camera.distortion.p2 = fit.lens(3);
  camera.distortion.k3 = fit.lens(4);
  camera.width = size.width;
  camera.height = size.height;
  return camera;
}

}  // namespace

Calibration calibrate(const std::vector<BoardView>& views, cv::Size size, bool with_k3) {
  Calibration result;
  result.views = views;
  Fit last = fit(result.views, size, with_k3);
  while (result.views.size() > kLeastViews) {
    const std::size_t outlier = find_outlier(last);
    if (outlier == result.views.size()) break;
    result.left_out_errors.push_back(last.view_errors(static_cast<int>(outlier)));
    const auto at = result.views.begin() + static_cast<std::ptrdiff_t>(outlier);
    result.left_out.push_back(std::move(*at));
    result.views.erase(at);
    last = fit(result.views, size, with_k3);
  }
  constexpr double kLargestError = 3;  // pixels
  if (last.error > kLargestError)
    throw Error(cv::format("the corners miss the board by %.1f pixels; ", last.error) +
                "check --size and --pattern, that the board is flat, and that nothing zooms or refocuses");
  refuse_unconstrained(last, size);
  result.camera = camera_of(last, size);
  result.error = last.error;
  result.fx_sigma = last.sigmas(0);
  result.fy_sigma = last.sigmas(1);
  result.view_errors.assign(last.view_errors.begin(), last.view_errors.end());
  result.largest_tilt = largest_tilt(last);
  return result;
}

}  // namespace sslam::cli
