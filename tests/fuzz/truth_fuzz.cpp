// SPDX-License-Identifier: BSD-3-Clause
// Ground truths and estimates as files: what reads them goes by their name as well as by what they hold.
#include "fuzz/made_folder.hpp"
#include "fuzz/seeds.hpp"
#include "sslam/io/trajectories/colmap_images.hpp"
#include "sslam/io/trajectories/read_trajectory.hpp"

namespace truth_fuzz {

using namespace sslam;

// The last one is a file of times beside the others.
inline constexpr std::array<std::string_view, 8> kNames{
    "a.txt", "a.csv", "a.traj", "transforms.json", "images.txt", "images.bin", "a.log", "times.txt"};

inline const std::vector<std::string>& seeds() {
  const auto file = [](std::string_view name, std::string_view text) {
    return fuzzing::file_of(kNames, name, text);
  };
  static const std::vector<std::string> kSeeds{
      file("a.txt", "# stamp tx ty tz qx qy qz qw\n0.0 0 0 0 0 0 0 1\n0.1 1e3 -2 0.5 0 0 0.7071 0.7071\n"),
      file("a.csv",
           "#timestamp "
           "[ns],p_x,p_y,p_z,q_w,q_x,q_y,q_z\n1403636580838555648,1,2,3,1,0,0,0\n1403636580938555648,1,2,3,0,"
           "1,0,0\n"),
      file("a.csv", "Zeit;x;y;z;qx;qy;qz;qw\n0,5;1,5;2;3;0;0;0;1\n"),
      file("a.txt", "1 0 0 0 0 1 0 0 0 0 1 0\n1 0 0 1 0 1 0 0 0 0 1 0\n") + file("times.txt", "0.5\n1.5\n"),
      file("a.txt", "2024-05-01T10:11:12.5 0 0 0 0 0 0 1\n2024-05-01T10:11:13 1 0 0 0 0 0 1\n"),
      file("a.txt",
           "VERTEX_SE3:QUAT 0 0 0 0 0 0 0 1\nVERTEX_SE3:QUAT 1 1 0 0 0 0 0 1\nEDGE_SE3:QUAT 0 1 1 0 0 0 0 0 "
           "1\n"),
      file("a.log", "0 0 1\n1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n1 1 2\n1 0 0 1\n0 1 0 0\n0 0 1 0\n0 0 0 1\n"),
      file("a.traj", "0.1 0.1 0.2 0.3 1 2 3\n0.2 0.1 0.2 0.3 1 2 4\n"),
      file("transforms.json",
           R"({"fl_x": 200, "frames": [{"file_path": "a/1.png", "timestamp": 1.5, "transform_matrix":
          [[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]]}, {"file_path": "a/2.png", "transform_matrix": [[1,0,0,2],[0,1,0,0],[0,0,1,0],[0,0,0,1]]}]})"),
      file("images.txt", "# Image list\n1 1 0 0 0 0 0 0 1 a 1.png\n10 20 -1\n2 1 0 0 0 0 0 1 1 b.png\n\n"),
      file("images.bin", std::string("\1\0\0\0\0\0\0\0\1\0\0\0", 12) + std::string("\0\0\0\0\0\0\360\77", 8) +
                             std::string(48, '\0') + std::string("\1\0\0\0a.png\0\0\0\0\0\0\0\0\0", 18))};
  return kSeeds;
}

inline void demand_finite(const io::Trajectory& poses) {
  for (const io::StampedPose& pose : poses)
    if (!pose.world_from_cam.translation.allFinite() || !pose.world_from_cam.rotation.matrix().allFinite() ||
        !std::isfinite(pose.stamp))
      std::abort();
}

inline void demand_lines(const io::Warnings& warnings) {
  for (const std::string& warning : warnings)
    if (warning.find('\n') != std::string::npos) std::abort();
}

}  // namespace truth_fuzz

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most,
                                               unsigned seed) {
  return sslam::fuzzing::mutate_or_begin(truth_fuzz::seeds(), data, size, most, seed);
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace truth_fuzz;
  const std::filesystem::path folder = fuzzing::empty_folder();
  std::vector<std::filesystem::path> files;
  fuzzing::for_each_file({reinterpret_cast<const char*>(data), size}, kNames,
                         [&](std::string_view name, std::string_view text) {
                           files.push_back(folder / name);
                           fuzzing::write_bytes(files.back(), text);
                         });
  for (const std::filesystem::path& file : files)
    fuzzing::expect_error([&] {
      io::Warnings warnings;
      demand_finite(io::read_pose_file(file, warnings).trajectory);
      demand_lines(warnings);
    });
  return 0;
}
