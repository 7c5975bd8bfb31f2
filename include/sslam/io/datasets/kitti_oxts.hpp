// SPDX-License-Identifier: BSD-3-Clause
// The ground truth of KITTI's raw recordings: a file of GPS and inertial readings a frame, oxts/data/N.txt,
// whose first numbers are latitude, longitude, altitude, roll, pitch and yaw.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sslam/core/types.hpp"
#include "sslam/io/datasets/dataset.hpp"
#include "sslam/io/datasets/dataset_filling.hpp"
#include "sslam/io/datasets/kitti_calibration.hpp"
#include "sslam/io/files/files.hpp"
#include "sslam/io/files/plain_text.hpp"
#include "sslam/io/trajectories/pose_times.hpp"

namespace sslam::io {

namespace kitti_oxts_detail {

using Reading = std::array<double, 6>;  // degrees, degrees, metres, radians, radians, radians

[[nodiscard]] inline std::optional<Reading> read_reading(const std::filesystem::path& file) {
  const std::string text = read_plain_text(file);
  const std::vector<TextRow> rows = split_rows(text);
  Reading reading{};
  if (rows.empty() || rows.front().cells.size() < reading.size()) return std::nullopt;
  for (std::size_t i = 0; i < reading.size(); ++i) {
    const auto number = parse_number<double>(rows.front().cells[i]);
    if (!number || !std::isfinite(*number)) return std::nullopt;
    reading[i] = *number;
  }
  return reading;
}

[[nodiscard]] inline SO3<double> turn_about(double angle, int axis) {
  std::array<double, 4> q{std::cos(angle / 2), 0, 0, 0};
  q[static_cast<std::size_t>(axis) + 1] = std::sin(angle / 2);
  return SO3<double>::from_quaternion(q[0], q[1], q[2], q[3]);
}

// East, north, up in metres by Mercator's projection, whose scale is that of the first reading's latitude, as
// KITTI's development kit has it.
[[nodiscard]] inline SE3<double> world_from_body(const Reading& reading, double first_latitude) {
  constexpr double kEarth = 6378137;
  const double scale = std::cos(radians(first_latitude));
  SE3<double> pose;
  pose.translation = {scale * kEarth * radians(reading[1]),
                      scale * kEarth * std::log(std::tan(radians(90 + reading[0]) / 2)), reading[2]};
  pose.rotation = turn_about(reading[5], 2) * turn_about(reading[4], 1) * turn_about(reading[3], 0);
  return pose;
}

// By the three files of a day's calibration. `rectified`: the images are. Throws Error.
[[nodiscard]] inline SE3<double> cam_from_body(const std::filesystem::path& calibration,
                                               const std::string& camera, bool rectified) {
  const std::filesystem::path folder = calibration.parent_path();
  const std::string text = read_plain_text(calibration);
  const std::vector<double> p = calibration_row(text, "P_rect_" + camera);
  if (p.size() != 12 || !(p[0] > 0))
    throw Error(calibration.string() + ": P_rect_" + camera + " is missing; expected twelve numbers");
  const SE3<double> from_first =
      rectified ? rigid_motion(calibration_row(text, "R_rect_00"), {p[3] / p[0], 0, 0}, calibration)
                : rigid_motion(calibration_row(text, "R_" + camera), calibration_row(text, "T_" + camera),
                               calibration);
  return from_first * read_rigid_motion(folder / "calib_velo_to_cam.txt") *
         read_rigid_motion(folder / "calib_imu_to_velo.txt");
}

}  // namespace kitti_oxts_detail

// `folder`: with data/N.txt and timestamps.txt. `calibration`: calib_cam_to_cam.txt, beside the two others;
// empty: not there. `stamps`: of the images, by number; readings as many as images are of the images, others
// have stamps of their own.
inline void attach_oxts(Dataset& dataset, const std::filesystem::path& folder,
                        const std::filesystem::path& calibration, const std::string& camera, bool rectified,
                        const std::vector<double>& stamps) {
  using namespace kitti_oxts_detail;
  attach_or_leave_out(dataset, [&] {
    if (calibration.empty())
      throw Error(folder.string() +
                  ": holds the car's poses, and without calib_cam_to_cam.txt, calib_velo_to_cam.txt and "
                  "calib_imu_to_velo.txt above it the camera's are not known");
    const SE3<double> body_from_cam = cam_from_body(calibration, camera, rectified).inverse();
    const auto files = list_files(
        folder / "data", [](const std::filesystem::path& name) { return all_digits(name.stem().string()); });
    const std::filesystem::path times = folder / "timestamps.txt";
    std::error_code ignored;
    Warnings dates;  // as the layout has them
    const bool own =
        std::filesystem::is_regular_file(times, ignored) && files.size() != dataset.frames.size();
    const std::vector<double> clock = own ? read_times(times, dates) : stamps;
    BadEntries bad(folder / "data");
    Trajectory truth;
    std::optional<Reading> first;
    for (const std::filesystem::path& file : files) {
      const auto number = parse_number<std::size_t>(file.stem().string());
      const auto reading = read_reading(file);
      if (!reading || !number || *number >= clock.size()) {
        bad.add(file.filename().string() + (reading ? ": has no time in " + times.string()
                                                    : ": expected lat lon alt roll pitch yaw and more"));
        continue;
      }
      if (!first) first = reading;
      SE3<double> pose = world_from_body(*reading, (*first)[0]);
      pose.translation -= world_from_body(*first, (*first)[0]).translation;
      truth.push_back({clock[*number], pose * body_from_cam});
    }
    bad.settle(files.size(), dataset.warnings);
    order_by_stamp(truth, folder, dataset.warnings);
    attach_ground_truth(dataset, std::move(truth), folder);
  });
}

}  // namespace sslam::io
