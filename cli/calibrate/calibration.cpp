// SPDX-License-Identifier: BSD-3-Clause
#include "cli/calibrate/calibration.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <opencv2/core/eigen.hpp>

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

// Standard deviations of fx and fy, which OpenCV's fisheye module does not tell: from the normal equations of
// all corners, less what each view's own pose explains. Gives each view's error, too.
void judge_fisheye(const std::vector<BoardView>& views, Fit& fit) {
  using Intrinsics = Eigen::Matrix<double, 8, 8>;
  constexpr int kOwn = 8, kPose = 6;
  Intrinsics normal = Intrinsics::Zero();
  double sum = 0;
  int rows = 0;
  fit.view_errors = cv::Mat_<double>(static_cast<int>(views.size()), 1);
  for (std::size_t v = 0; v < views.size(); ++v) {
    std::vector<cv::Point2f> seen;
    cv::Mat jacobian;  // of fx fy, cx cy, k1 to k4, turn, place, skew
    cv::fisheye::projectPoints(views[v].board, seen, fit.rotations[v], fit.translations[v], fit.matrix,
                               fit.lens, 0, jacobian);
    Eigen::MatrixXd j;
    cv::cv2eigen(jacobian, j);
    const Eigen::MatrixXd own = j.leftCols(kOwn), pose = j.middleCols(kOwn, kPose);
    const Eigen::MatrixXd across = own.transpose() * pose;
    normal += own.transpose() * own - across * (pose.transpose() * pose).ldlt().solve(across.transpose());
    double view_sum = 0;
    for (std::size_t i = 0; i < seen.size(); ++i) {
      const cv::Point2f off = seen[i] - views[v].image[i];
      view_sum += off.ddot(off);
    }
    fit.view_errors(static_cast<int>(v)) = std::sqrt(view_sum / static_cast<double>(seen.size()));
    sum += view_sum;
    rows += 2 * static_cast<int>(seen.size());
  }
  fit.error = std::sqrt(2 * sum / rows);
  const int free = rows - kOwn - kPose * static_cast<int>(views.size());
  const Intrinsics covariance = normal.inverse() * (sum / std::max(1, free));
  fit.sigmas = cv::Mat_<double>(2, 1);
  for (int i = 0; i < 2; ++i) fit.sigmas(i) = std::sqrt(std::max(0.0, covariance(i, i)));
}

Fit fit_fisheye(const std::vector<BoardView>& views, cv::Size size) {
  std::vector<std::vector<cv::Point3d>> board;
  std::vector<std::vector<cv::Point2d>> image;
  for (const BoardView& view : views) {
    board.emplace_back(view.board.begin(), view.board.end());
    image.emplace_back(view.image.begin(), view.image.end());
  }
  Fit fit;
  try {
    cv::fisheye::calibrate(board, image, size, fit.matrix, fit.lens, fit.rotations, fit.translations,
                           cv::fisheye::CALIB_RECOMPUTE_EXTRINSIC | cv::fisheye::CALIB_FIX_SKEW,
                           {cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 200, 1e-10});
    judge_fisheye(views, fit);
  } catch (const cv::Exception&) {
    throw Error(std::string("the views do not determine a fisheye; ") + kTilt);
  }
  return fit;
}

Fit fit(const std::vector<BoardView>& views, cv::Size size, LensKind kind) {
  if (kind == LensKind::kFisheye) return fit_fisheye(views, size);
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
                                    fit.sigmas, unused, fit.view_errors,
                                    kind == LensKind::kThird ? 0 : cv::CALIB_FIX_K3);
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

WideLens fisheye_of(const Fit& fit, const Camera<double>& plane) {
  WideLens lens;
  lens.model = WideModel::kFisheye;
  for (int i = 0; i < 4; ++i) lens.k[static_cast<std::size_t>(i)] = fit.lens(i);
  lens.pinhole = plane.pinhole;
  lens.width = plane.width;
  lens.height = plane.height;
  return lens;
}

Camera<double> camera_of(const Fit& fit, cv::Size size, LensKind kind) {
  Camera<double> camera;
  camera.pinhole = {fit.matrix(0, 0), fit.matrix(1, 1), fit.matrix(0, 2), fit.matrix(1, 2)};
  camera.width = size.width;
  camera.height = size.height;
  if (kind == LensKind::kFisheye) return camera;
  camera.distortion.k1 = fit.lens(0);
  camera.distortion.k2 = fit.lens(1);
  camera.distortion.p1 = fit.lens(2);
  camera.distortion.p2 = fit.lens(3);
  camera.distortion.k3 = fit.lens(4);
  return camera;
}

}  // namespace

Calibration calibrate(const std::vector<BoardView>& views, cv::Size size, LensKind kind) {
  Calibration result;
  result.views = views;
  Fit last = fit(result.views, size, kind);
  while (result.views.size() > kLeastViews) {
    const std::size_t outlier = find_outlier(last);
    if (outlier == result.views.size()) break;
    result.left_out_errors.push_back(last.view_errors(static_cast<int>(outlier)));
    const auto at = result.views.begin() + static_cast<std::ptrdiff_t>(outlier);
    result.left_out.push_back(std::move(*at));
    result.views.erase(at);
    last = fit(result.views, size, kind);
  }
  constexpr double kLargestError = 3;  // pixels
  if (last.error > kLargestError)
    throw Error(cv::format("the corners miss the board by %.1f pixels; ", last.error) +
                "check --size and --pattern, that the board is flat, and that nothing zooms or refocuses");
  refuse_unconstrained(last, size);
  result.camera = camera_of(last, size, kind);
  if (kind == LensKind::kFisheye) result.wide = fisheye_of(last, result.camera);
  result.error = last.error;
  result.fx_sigma = last.sigmas(0);
  result.fy_sigma = last.sigmas(1);
  result.view_errors.assign(last.view_errors.begin(), last.view_errors.end());
  result.largest_tilt = largest_tilt(last);
  return result;
}

}  // namespace sslam::cli
