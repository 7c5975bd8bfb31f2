// SPDX-License-Identifier: BSD-3-Clause
// The calibration files of KITTI's raw data: rows of 'name: numbers', several cameras in one file.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sslam/core/error.hpp"
#include "sslam/geometry/se3.hpp"
#include "sslam/io/files/plain_text.hpp"
#include "sslam/io/files/text.hpp"

namespace sslam::io {

// The numbers of the row `name`; empty: there is no such row, or it has words.
[[nodiscard]] inline std::vector<double> calibration_row(std::string_view text, std::string_view name) {
  for (const TextRow& row : split_rows(text)) {
    if (row.cells.front() != std::string(name) + ":") continue;
    std::vector<double> numbers;
    for (std::size_t i = 1; i < row.cells.size(); ++i) {
      const auto number = parse_number<double>(row.cells[i]);
      if (!number) return {};
      numbers.push_back(*number);
    }
    return numbers;
  }
  return {};
}

// Rows R (3x3, or R_rect_00 alone) and T (3), from the second frame to the first. Throws Error where they are
// no rigid motion.
[[nodiscard]] inline SE3<double> rigid_motion(const std::vector<double>& r, const std::vector<double>& t,
                                              const std::filesystem::path& source) {
  if (r.size() != 9 || t.size() != 3)
    throw Error(source.string() + ": rows R and T are missing; expected nine and three numbers");
  SE3<double> motion;
  Mat3<double> rotation;
  rotation << r[0], r[1], r[2], r[3], r[4], r[5], r[6], r[7], r[8];
  constexpr double kTolerance = 0.01;
  if ((rotation * rotation.transpose() - Mat3<double>::Identity()).cwiseAbs().maxCoeff() > kTolerance ||
      rotation.determinant() < 0)
    throw Error(source.string() + ": row R is not a rotation");
  motion.rotation = SO3<double>::from_matrix(rotation);
  motion.translation = {t[0], t[1], t[2]};
  return motion;
}

// A file of rows R and T.
[[nodiscard]] inline SE3<double> read_rigid_motion(const std::filesystem::path& file) {
  const std::string text = read_plain_text(file);
  return rigid_motion(calibration_row(text, "R"), calibration_row(text, "T"), file);
}

// What calib_cam_to_cam.txt (KITTI-360: perspective.txt) says of a camera "00" to "03", as a camera file in
// text: of rectified images P_rect and S_rect, of others K, D and S. Empty: it does not say.
[[nodiscard]] inline std::string kitti_camera_text(std::string_view calibration, const std::string& camera,
                                                   bool rectified) {
  const std::vector<double> matrix = calibration_row(calibration, (rectified ? "P_rect_" : "K_") + camera),
                            size = calibration_row(calibration, (rectified ? "S_rect_" : "S_") + camera),
                            lens = calibration_row(calibration, "D_" + camera);
  if (matrix.size() != (rectified ? 12U : 9U)) return {};
  std::string text = "camera_matrix: [";
  for (std::size_t i = 0; i < matrix.size(); ++i)
    if (!rectified || i % 4 < 3) text += (i > 0 ? ", " : "") + exact_decimal(matrix[i]);
  text += "]\n";
  if (size.size() == 2)
    text += "image_width: " + exact_decimal(size[0]) + "\nimage_height: " + exact_decimal(size[1]) + "\n";
  if (rectified || lens.empty()) return text;
  text += "distortion_coefficients: [";
  for (std::size_t i = 0; i < lens.size(); ++i) text += (i > 0 ? ", " : "") + exact_decimal(lens[i]);
  return text + "]\n";
}

}  // namespace sslam::io
