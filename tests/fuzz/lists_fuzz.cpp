// SPDX-License-Identifier: BSD-3-Clause
// Lists of poses and tables.
#include "fuzz/fuzz_input.hpp"
#include "sslam/io/files/csv_reader.hpp"
#include "sslam/io/trajectories/read_trajectory.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace sslam;
  (void)fuzzing::read_as_file(data, size, [](const std::filesystem::path& path) {
    io::Warnings warnings;
    for (const io::StampedPose& pose : io::read_trajectory(path, warnings))
      if (!pose.world_from_cam.translation.allFinite()) std::abort();
  });
  return fuzzing::read_as_file(data, size, [](const std::filesystem::path& path) {
    io::Warnings warnings;
    const io::CsvTable table = io::read_csv(path, warnings);
    for (std::size_t row = 0; row < table.rows(); ++row)
      for (std::size_t column = 0; column < table.columns.size(); ++column) (void)table.cell(row, column);
  });
}
