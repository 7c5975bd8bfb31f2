// SPDX-License-Identifier: BSD-3-Clause
// Accuracy of two kernels as curves: the Manhattan rotation against the noise of its normals, their outliers,
// the width of the kernel and the number of axes in view; the translation against parallax and noise.
//   accuracy_kernels [TRIALS]
// writes CSV, the same bytes whenever it runs. accuracy_plots.py makes plots and a table of it.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "manhattan/vote_scene.hpp"
#include "solver/two_view/two_views.hpp"
#include "sslam/manhattan/rotation.hpp"
#include "sslam/solver/two_view/translation.hpp"

namespace {

using namespace sslam;

constexpr double kFailed = -1;  // the kernel refused

struct Room {
  int normals = 1000;
  double scatter_deg = 5;  // of a normal, per component
  double outliers = 0;     // share of the normals that point anywhere
  int axes = 3;            // that have normals
  double kernel_deg = 0;   // fixed width; 0: as the options have it
};

// Degrees between estimate and truth. With one axis in view, of that axis: the turn about it is not observed.
template <Scalar S>
double rotation_error(const Room& room, std::uint64_t seed) {
  Random random(seed);
  const SO3<double> truth = test::any_rotation(random);
  const Vec3<double> off = radians(3.0) * test::gaussian_vector<3>(random).normalized();
  test::VoteScene<S> scene(seed + 1, truth);
  const auto wrong = static_cast<int>(room.outliers * room.normals);
  for (int k = 0; k < room.axes; ++k)
    scene.add_plane(k, (room.normals - wrong) / room.axes, room.scatter_deg);
  scene.add_clutter_normals(wrong);
  ManhattanOptions<S> options;
  if (room.kernel_deg > 0) options.widest_kernel = options.narrowest_kernel = S(radians(room.kernel_deg));
  const ManhattanPrior<S> prior{truth.retract(off).template cast<S>()};
  const auto found = track_manhattan<S>(scene.normals(), {}, prior, options);
  if (room.axes > 1) return usable(found.status) ? test::error_deg(found.cam_from_manhattan, truth) : kFailed;
  if (found.status != Status::kDegenerate || found.axes_seen != 1) return kFailed;
  const Vec3<double> axis = found.cam_from_manhattan.matrix().col(0).template cast<double>();
  return angle_deg(axis, truth.matrix().col(0));
}

struct Step {
  double baseline = 0.3;  // metres, at depths from 2 to 6
  double noise = 1;       // pixels at a focal length of 500
  double mismatches = 0.3;
};

// Degrees between the directions of the translation.
template <Scalar S>
double translation_error(const Step& step, std::uint64_t seed) {
  const TwoViews views = make_two_views(
      {.matches = 300, .mismatches = step.mismatches, .noise = step.noise, .baseline = step.baseline}, seed);
  auto matches = views.as<S>();
  for (auto& match : matches) match.sigma = static_cast<S>(step.noise / TwoViews::kFocal);
  const auto found =
      translation_from_rotation<S>(matches, views.R_10.template cast<S>(), TranslationOptions<S>{}, seed);
  return usable(found.status) ? angle_deg(found.t_10.template cast<double>(), views.t_10) : kFailed;
}

// One point of a curve: median and 90 % quantile over what was answered, and the share that was.
template <class Error>
void put(const char* curve, const char* series, double x, const char* scalar, int trials, Error error) {
  std::vector<double> errors;
  for (int i = 0; i < trials; ++i) {
    const double e = error(static_cast<std::uint64_t>(1000 * i + 1));
    if (e != kFailed) errors.push_back(e);
  }
  std::sort(errors.begin(), errors.end());
  const auto quantile = [&](double q) {
    return errors.empty() ? 0 : errors[static_cast<std::size_t>(q * static_cast<double>(errors.size() - 1))];
  };
  std::printf("%s,%s,%.4g,%s,%.3g,%.3g,%.3g\n", curve, series, x, scalar, quantile(0.5), quantile(0.9),
              static_cast<double>(errors.size()) / trials);
}

void rotation(const char* curve, const char* series, double x, int trials, const Room& room) {
  put(curve, series, x, "float", trials,
      [&](std::uint64_t seed) { return rotation_error<float>(room, seed); });
  put(curve, series, x, "double", trials,
      [&](std::uint64_t seed) { return rotation_error<double>(room, seed); });
}

void translation(const char* curve, const char* series, double x, int trials, const Step& step) {
  put(curve, series, x, "float", trials,
      [&](std::uint64_t seed) { return translation_error<float>(step, seed); });
  put(curve, series, x, "double", trials,
      [&](std::uint64_t seed) { return translation_error<double>(step, seed); });
}

}  // namespace

int main(int argc, char** argv) {
  const int trials = argc > 1 ? std::max(std::atoi(argv[1]), 1) : 100;
  std::printf("curve,series,x,scalar,median_deg,p90_deg,answered\n");
  for (const int axes : {1, 2, 3}) {
    const char* const series = axes == 1 ? "1 axis" : axes == 2 ? "2 axes" : "3 axes";
    for (const double scatter : {0.5, 1.0, 2.0, 4.0, 6.0, 9.0, 12.0, 15.0})
      rotation("rotation_noise", series, scatter, trials, {.scatter_deg = scatter, .axes = axes});
    for (const double share : {0.0, 0.2, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9})
      rotation("rotation_outliers", series, share, trials, {.outliers = share, .axes = axes});
  }
  for (const double scatter : {2.0, 5.0, 10.0}) {
    const char* const series = scatter == 2 ? "2 degrees" : scatter == 5 ? "5 degrees" : "10 degrees";
    for (const double width : {1.0, 2.0, 3.0, 4.5, 7.0, 10.0, 14.0})
      rotation("rotation_kernel", series, width, trials,
               {.scatter_deg = scatter, .outliers = 0.3, .kernel_deg = width});
  }
  for (const double noise : {0.25, 1.0, 2.0}) {
    const char* const series = noise == 0.25 ? "0.25 px" : noise == 1 ? "1 px" : "2 px";
    for (const double parallax : {0.25, 0.5, 1.0, 2.0, 4.0, 8.0, 14.0})
      translation("translation_parallax", series, parallax, trials,
                  {.baseline = 4 * std::tan(radians(parallax)), .noise = noise});
  }
  for (const double parallax : {1.0, 4.0}) {
    const char* const series = parallax == 1 ? "1 degree" : "4 degrees";
    for (const double noise : {0.1, 0.2, 0.5, 1.0, 2.0, 4.0})
      translation("translation_noise", series, noise, trials,
                  {.baseline = 4 * std::tan(radians(parallax)), .noise = noise});
  }
}
