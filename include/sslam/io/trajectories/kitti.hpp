// SPDX-License-Identifier: BSD-3-Clause
// Trajectories in the format of KITTI's odometry benchmark: a pose a row, the upper three rows of
// world_from_cam one after the other; its rows have no stamps: write_stamps() puts them in a file of their
// own.
#pragma once

#include <cstdio>
#include <filesystem>
#include <span>

#include "sslam/io/files/output_file.hpp"
#include "sslam/io/trajectories/trajectory.hpp"

namespace sslam::io {

// Throws Error when it cannot be written.
inline void write_kitti_poses(const std::filesystem::path& path, std::span<const StampedPose> trajectory) {
  OutputFile file(path);
  char number[40];
  for (const StampedPose& pose : trajectory) {
    const Mat3<double> r = pose.world_from_cam.rotation.matrix();
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column < 4; ++column) {
        const double value = column < 3 ? r(row, column) : pose.world_from_cam.translation[row];
        std::snprintf(number, sizeof number, "%.9e", value);
        file.stream() << (row + column > 0 ? " " : "") << number;
      }
    }
    file.stream() << '\n';
  }
  file.commit();
}

}  // namespace sslam::io
