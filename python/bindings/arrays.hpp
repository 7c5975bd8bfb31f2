// SPDX-License-Identifier: BSD-3-Clause
// Between numpy's arrays and what the library takes and gives. Names of arguments stand first in messages.
#pragma once

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>

#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "sslam/geometry/nearest_rotation.hpp"
#include "sslam/geometry/se3.hpp"
#include "sslam/io/trajectories/trajectory.hpp"

namespace sslam::python {

namespace nb = nanobind;

// Numbers in rows without gaps: the Python side has seen to dtype, shape and layout.
template <class T>
using Rows = nb::ndarray<const T, nb::c_contig, nb::device::cpu>;
template <class T>
using Made = nb::ndarray<nb::numpy, T>;

// An array that owns its numbers.
template <class T>
[[nodiscard]] Made<T> make_array(std::vector<T> values, std::initializer_list<std::size_t> shape) {
  auto kept = std::make_unique<std::vector<T>>(std::move(values));
  T* const data = kept->data();
  const nb::capsule owner(kept.release(),
                          [](void* all) noexcept { delete static_cast<std::vector<T>*>(all); });
  return Made<T>(data, shape, owner);
}

template <class T, int R, int C>
void append(std::vector<T>& values, const Mat<T, R, C>& matrix) {
  for (int r = 0; r < R; ++r)
    for (int c = 0; c < C; ++c) values.push_back(matrix(r, c));
}

template <int R, int C>
[[nodiscard]] Made<double> matrix_array(const Mat<double, R, C>& matrix) {
  std::vector<double> values;
  append(values, matrix);
  if constexpr (C == 1) return make_array(std::move(values), {std::size_t{R}});
  return make_array(std::move(values), {std::size_t{R}, std::size_t{C}});
}

[[nodiscard]] inline Mat<double, 4, 4> matrix_of(const SE3<double>& pose) {
  Mat<double, 4, 4> m = Mat<double, 4, 4>::Identity();
  m.topLeftCorner<3, 3>() = pose.rotation.matrix();
  m.topRightCorner<3, 1>() = pose.translation;
  return m;
}

// The rotation that nine numbers, row by row, are meant to be. Throws value_error, naming it, for what is
// none.
[[nodiscard]] inline SO3<double> rotation_from(const double* values, std::size_t stride,
                                               const std::string& what) {
  Mat3<double> m;
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c)
      m(r, c) = values[static_cast<std::size_t>(r) * stride + static_cast<std::size_t>(c)];
  constexpr double kRounding = 1e-4;  // of numbers in text files
  SO3<double> rotation;
  if (!m.allFinite() || !usable(nearest_rotation(m, rotation)) ||
      (rotation.matrix() - m).cwiseAbs().maxCoeff() > kRounding)
    throw nb::value_error(
        (what + ": is no rotation; expected an orthonormal 3x3 matrix, not mirrored").c_str());
  return rotation;
}

// A pose from sixteen numbers, row by row.
[[nodiscard]] inline SE3<double> pose_from(const double* values, const std::string& what) {
  const Vec3<double> translation(values[3], values[7], values[11]);
  if (!translation.allFinite()) throw nb::value_error((what + ": the translation is not finite").c_str());
  if (values[12] != 0 || values[13] != 0 || values[14] != 0 || values[15] != 1)
    throw nb::value_error((what + ": the last row is not 0 0 0 1; expected a pose, 4x4").c_str());
  return {rotation_from(values, 4, what), translation};
}

// "estimate[3]"
[[nodiscard]] inline std::string item(const std::string& name, std::size_t i) {
  return name + "[" + std::to_string(i) + "]";
}

[[nodiscard]] inline io::Trajectory trajectory_from(const Rows<double>& stamps, const Rows<double>& poses,
                                                    const std::string& what) {
  io::Trajectory trajectory;
  trajectory.reserve(stamps.size());
  for (std::size_t i = 0; i < stamps.size(); ++i)
    trajectory.push_back({stamps.data()[i], pose_from(poses.data() + 16 * i, item(what, i))});
  return trajectory;
}

// Stamps (N,) and poses (N, 4, 4), camera to world.
[[nodiscard]] inline nb::tuple trajectory_arrays(const io::Trajectory& trajectory) {
  std::vector<double> stamps, poses;
  for (const io::StampedPose& pose : trajectory) {
    stamps.push_back(pose.stamp);
    append(poses, matrix_of(pose.world_from_cam));
  }
  const std::size_t count = trajectory.size();
  return nb::make_tuple(make_array(std::move(stamps), {count}), make_array(std::move(poses), {count, 4, 4}));
}

}  // namespace sslam::python
