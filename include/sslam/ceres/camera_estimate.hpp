// SPDX-License-Identifier: BSD-3-Clause
// What a map says about its camera: an estimate with its covariance, and whether it contradicts the given
// one.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "sslam/core/status.hpp"
#include "sslam/residual/lens_reprojection.hpp"

namespace sslam {

// How far a calibration may be off before the map is looked at: standard deviations.
struct CameraPrior {
  double focal = 0.05;   // of the focal length, as a part of it
  double centre = 0.01;  // of the principal point, as a part of the image's width
  double k1 = 0.2, k2 = 0.2;

  [[nodiscard]] LensChange<double> sigma(const Camera<double>& camera) const {
    const double pixels = centre * camera.width;
    return LensChange<double>(focal, pixels, pixels, k1, k2);
  }
};

struct CameraEstimate {
  Status status = Status::kTooFew;  // of no use unless kOk
  Camera<double> camera;
  LensChange<double> change = LensChange<double>::Zero();                                // from the given one
  Mat<double, kLensDof, kLensDof> covariance = Mat<double, kLensDof, kLensDof>::Zero();  // of the change
  int observations = 0;
  double gain = 0;  // what the change saves, as a part of the cost of all observations without it
};

// How much another camera moves what is seen, in pixels of the given one, root mean square over the image.
// A shift of the whole image does not count: that is a turn of the camera.
struct CameraShift {
  double pixels = 0, sigma = 0;
};

[[nodiscard]] inline CameraShift camera_shift(const Camera<double>& given, const CameraEstimate& estimate) {
  constexpr int kGrid = 9;
  constexpr int kPlaces = kGrid * kGrid;
  // One row a place in the image, x and y apart.
  Mat<double, kPlaces, 2> moved;
  std::array<Mat<double, kPlaces, kLensDof>, 2> by_camera;
  for (int i = 0; i < kPlaces; ++i) {
    const Vec2<double> pixel(given.width * (i % kGrid + 0.5) / kGrid,
                             given.height * (i / kGrid + 0.5) / kGrid);
    const Vec3<double> ray = given.pinhole.unproject(given.undistort_pixel(pixel));
    PointReprojection<double> seen;
    Mat<double, 2, kLensDof> derivative;
    (void)lens_point_reprojection(given, {}, ray, pixel, seen, &derivative);
    const Vec2<double> m = estimate.camera.distortion.distort(ray.head<2>());
    moved.row(i) = (estimate.camera.pinhole.project({m.x(), m.y(), 1}) - pixel).transpose();
    for (const int axis : {0, 1}) by_camera[axis].row(i) = derivative.row(axis);
  }
  moved.rowwise() -= moved.colwise().mean().eval();
  double variance = 0;
  for (auto& derivative : by_camera) {
    derivative.rowwise() -= derivative.colwise().mean().eval();
    variance += (derivative.transpose() * derivative * estimate.covariance).trace();
  }
  return {std::sqrt(moved.squaredNorm() / kPlaces), std::sqrt(std::max(variance, 0.0) / kPlaces)};
}

enum class CameraVerdict : std::uint8_t {
  kOpen,     // the map leaves the camera open: too few views, or a motion that does not tell
  kAgrees,   // with the given camera
  kDiffers,  // from it, and the observations fit far better with the estimate
};

struct CameraVerdictOptions {
  double tolerance = 0.0005;  // of the image's width: a smaller shift changes no map
  // Of the cost. A camera that is slightly wrong soaks up other errors too, such as those of a rolling
  // shutter: at most 0.02 on recordings whose calibration is good, and 0.1 where the focal length is 2 % off.
  double min_gain = 0.05;
  double open = 0.006;      // of the image's width: with a larger error the estimate says nothing
  double error_factor = 4;  // errors of the estimate over the standard deviation that it claims
};

[[nodiscard]] inline CameraVerdict judge_camera(const Camera<double>& given, const CameraEstimate& estimate,
                                                const CameraVerdictOptions& options = {}) {
  if (!usable(estimate.status)) return CameraVerdict::kOpen;
  const CameraShift shift = camera_shift(given, estimate);
  if (shift.pixels > options.tolerance * given.width && estimate.gain >= options.min_gain)
    return CameraVerdict::kDiffers;
  return options.error_factor * shift.sigma <= options.open * given.width ? CameraVerdict::kAgrees
                                                                          : CameraVerdict::kOpen;
}

}  // namespace sslam
