// SPDX-License-Identifier: BSD-3-Clause
// Kernels on arrays, of one view or two. Pixels are those of the camera's images, distorted as they are;
// poses are camera to world.
#include <nanobind/stl/optional.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <numbers>
#include <span>

#include "bindings/arrays.hpp"
#include "bindings/bindings.hpp"
#include "bindings/free.hpp"
#include "bindings/pixels.hpp"
#include "sslam/manhattan/votes.hpp"
#include "sslam/system/compiled_kernels.hpp"

namespace sslam::python {
namespace {

// Matches of pixels as the kernels of two views want them; sigma in pixels.
std::vector<BearingMatch<double>> matches_of(const Rows<double>& pixels0, const Rows<double>& pixels1,
                                             const Camera<double>& camera, double sigma) {
  std::vector<BearingMatch<double>> matches;
  const std::size_t count = pixels0.size() / 2;
  matches.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const auto ray = [&](const Rows<double>& pixels) {
      return camera.pinhole.unproject(undistorted(camera, pixels.data() + 2 * i));
    };
    matches.push_back({ray(pixels0), ray(pixels1), sigma / focal_of(camera)});
  }
  return matches;
}

nb::object flags_of(const std::vector<std::uint8_t>& flags) {
  auto kept = std::make_unique<bool[]>(flags.size());
  std::copy(flags.begin(), flags.end(), kept.get());
  bool* const data = kept.release();
  const nb::capsule owner(data, [](void* all) noexcept { delete[] static_cast<bool*>(all); });
  return nb::cast(Made<bool>(data, {flags.size()}, owner));
}

nb::tuple manhattan(const Rows<float>& normals, const std::optional<Rows<float>>& weights,
                    const Rows<double>& segments, const std::optional<Camera<double>>& camera, double sigma,
                    const std::optional<Rows<double>>& prior, double prior_sigma, double plane_sigma,
                    std::uint64_t seed) {
  const std::size_t lines = segments.size() / 4;
  std::vector<LineVote<double>> votes;
  std::vector<std::int8_t> axis_of(lines, -1);
  ManhattanPrior<double> start;
  if (prior) start.cam_from_manhattan = rotation_from(prior->data(), 3, "prior");
  start.covariance = Mat3<double>::Identity() * (prior_sigma * prior_sigma);
  ManhattanEstimate<double> answer;
  {
    const Free free;
    votes.reserve(lines);
    for (std::size_t i = 0; i < lines; ++i) {
      const double* const ends = segments.data() + 4 * i;
      votes.push_back(line_vote(Segment2<double>{undistorted(*camera, ends), undistorted(*camera, ends + 2)},
                                camera->pinhole, sigma));
    }
    const float* const x = normals.data();
    const NormalView<float> view{x, x + 1, x + 2, nullptr, normals.size() / 3, 3};
    // Weights stand one after the other, and the normals' components three apart.
    std::vector<float> planes;
    NormalView<float> weighted = view;
    if (weights) {
      planes.resize(4 * view.size);
      for (std::size_t i = 0; i < view.size; ++i) {
        for (std::size_t c = 0; c < 3; ++c) planes[c * view.size + i] = x[3 * i + c];
        planes[3 * view.size + i] = weights->data()[i];
      }
      weighted = {planes.data(),
                  planes.data() + view.size,
                  planes.data() + 2 * view.size,
                  planes.data() + 3 * view.size,
                  view.size,
                  1};
    }
    const ManhattanOptions<double> options = ManhattanOptions<double>().with_plane_sigma(plane_sigma);
    if (prior) {
      answer = track_manhattan<double, float>(weighted, votes, start, options, axis_of);
    } else {
      SearchOptions<double> search;
      search.rotation = options;
      answer = find_manhattan<double, float>(weighted, votes, search, seed, axis_of);
    }
  }
  return nb::make_tuple(answer.status, matrix_array<3, 3>(answer.cam_from_manhattan.matrix()),
                        matrix_array<3, 3>(answer.covariance), answer.axes_seen, answer.deviation,
                        answer.ambiguity, make_array(std::move(axis_of), {lines}));
}

nb::tuple pose_answer(const RelativePoseSummary<double>& summary, const SO3<double>& R_10,
                      const Vec3<double>& t_10, const std::vector<std::uint8_t>& inliers) {
  return nb::make_tuple(summary.status, matrix_array<4, 4>(matrix_of(SE3<double>{R_10, t_10})),
                        matrix_array<3, 3>(summary.rotation_covariance),
                        matrix_array<3, 3>(summary.translation_covariance), summary.parallax,
                        flags_of(inliers));
}

nb::tuple relative_pose(const Rows<double>& pixels0, const Rows<double>& pixels1,
                        const Camera<double>& camera, double sigma, const std::optional<Rows<double>>& start,
                        std::uint64_t seed) {
  SE3<double> pose;
  if (start) pose = pose_from(start->data(), "start");
  std::vector<std::uint8_t> inliers(pixels0.size() / 2, 0);
  RelativePoseSummary<double> summary;
  {
    const Free free;
    const std::vector<BearingMatch<double>> matches = matches_of(pixels0, pixels1, camera, sigma);
    const std::span<const BearingMatch<double>> all(matches);
    summary = start ? refine_relative_pose<double>(all, pose.rotation, pose.translation, {}, inliers)
                    : find_relative_pose<double>(all, {}, seed, pose.rotation, pose.translation, inliers);
  }
  return pose_answer(summary, pose.rotation, pose.translation, inliers);
}

nb::tuple translation(const Rows<double>& pixels0, const Rows<double>& pixels1, const Rows<double>& rotation,
                      const Camera<double>& camera, double sigma, double rotation_sigma, std::uint64_t seed) {
  const SO3<double> R_10 = rotation_from(rotation.data(), 3, "rotation");
  std::vector<std::uint8_t> inliers(pixels0.size() / 2, 0);
  TranslationEstimate<double> answer;
  {
    const Free free;
    const std::vector<BearingMatch<double>> matches = matches_of(pixels0, pixels1, camera, sigma);
    TranslationOptions<double> options;
    options.rotation_sigma = rotation_sigma;
    answer = translation_from_rotation<double>(std::span<const BearingMatch<double>>(matches), R_10, options,
                                               seed, inliers);
  }
  return nb::make_tuple(answer.status, matrix_array<3, 1>(answer.t_10), matrix_array<3, 3>(answer.covariance),
                        answer.parallax, flags_of(inliers));
}

nb::tuple refine(const Rows<double>& points, const Rows<double>& pixels, const Rows<double>& segments_world,
                 const Rows<double>& segments, const Camera<double>& camera, const Rows<double>& start,
                 double sigma) {
  SE3<double> pose = pose_from(start.data(), "pose").inverse();
  const std::size_t point_count = points.size() / 3, line_count = segments.size() / 4;
  std::vector<std::uint8_t> point_inliers(point_count, 0), line_inliers(line_count, 0);
  PoseSummary<double, 6> summary;
  {
    const Free free;
    std::vector<PointObservation<double>> seen;
    for (std::size_t i = 0; i < point_count; ++i) {
      const double* const x = points.data() + 3 * i;
      seen.push_back({{x[0], x[1], x[2]}, undistorted(camera, pixels.data() + 2 * i), sigma});
    }
    std::vector<LineObservation<double>> lines;
    for (std::size_t i = 0; i < line_count; ++i) {
      const double *const x = segments_world.data() + 6 * i, *const ends = segments.data() + 4 * i;
      lines.push_back({Line3<double>::from_points({x[0], x[1], x[2]}, {x[3], x[4], x[5]}),
                       {undistorted(camera, ends), undistorted(camera, ends + 2)},
                       sigma});
    }
    summary = refine_pose<double>(camera.pinhole, seen, lines, pose, {}, point_inliers, line_inliers);
  }
  if (!usable(summary.status)) {
    point_inliers.assign(point_count, 0);
    line_inliers.assign(line_count, 0);
  }
  return nb::make_tuple(summary.status, matrix_array<4, 4>(matrix_of(pose.inverse())),
                        matrix_array<6, 6>(summary.information), flags_of(point_inliers),
                        flags_of(line_inliers));
}

}  // namespace

void bind_kernels(nb::module_& module) {
  module.def("manhattan_rotation", &manhattan, nb::arg("normals"), nb::arg("weights").none(),
             nb::arg("segments"), nb::arg("camera").none(), nb::arg("sigma"), nb::arg("prior").none(),
             nb::arg("prior_sigma"), nb::arg("plane_sigma"), nb::arg("seed"));
  module.def("relative_pose", &relative_pose, nb::arg("pixels0"), nb::arg("pixels1"), nb::arg("camera"),
             nb::arg("sigma"), nb::arg("start").none(), nb::arg("seed"));
  module.def("translation_from_rotation", &translation);
  module.def("refine_pose", &refine);
}

}  // namespace sslam::python
