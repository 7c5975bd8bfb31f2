// SPDX-License-Identifier: BSD-3-Clause
// Folders of all dataset layouts: lists, poses and calibrations of every kind, and images that are not looked
// into.
#include "fuzz/made_folder.hpp"
#include "fuzz/seeds.hpp"
#include "sslam/io/datasets/open_dataset.hpp"

namespace layout_fuzz {

using namespace sslam;

inline constexpr std::array<std::string_view, 62> kNames{"rgb.txt",
                                                         "depth.txt",
                                                         "groundtruth.txt",
                                                         "associations.txt",
                                                         "accelerometer.txt",
                                                         "camera.yaml",
                                                         "rgb/0.png",
                                                         "rgb/1.png",
                                                         "frame-000000.color.png",
                                                         "frame-000000.pose.txt",
                                                         "frame-000001.color.png",
                                                         "frame-000001.pose.txt",
                                                         "mav0/cam0/data.csv",
                                                         "mav0/cam0/sensor.yaml",
                                                         "mav0/cam0/data/1403636580838555648.png",
                                                         "mav0/state_groundtruth_estimate0/data.csv",
                                                         "mav0/mocap0/data.csv",
                                                         "dso/camchain.yaml",
                                                         "image_0/000000.png",
                                                         "image_0/000001.png",
                                                         "times.txt",
                                                         "calib.txt",
                                                         "poses.txt",
                                                         "image_00/data/0000000000.png",
                                                         "image_00/timestamps.txt",
                                                         "oxts/data/0000000000.txt",
                                                         "oxts/timestamps.txt",
                                                         "calib_cam_to_cam.txt",
                                                         "calib_imu_to_velo.txt",
                                                         "calib_velo_to_cam.txt",
                                                         "results/frame000000.jpg",
                                                         "results/frame000001.jpg",
                                                         "traj.txt",
                                                         "cam_params.json",
                                                         "color/0.jpg",
                                                         "color/1.jpg",
                                                         "pose/0.txt",
                                                         "pose/1.txt",
                                                         "intrinsic/intrinsic_color.txt",
                                                         "depth/0.png",
                                                         "color.txt",
                                                         "aligned_depth.txt",
                                                         "sensors.yaml",
                                                         "trans_matrix.yaml",
                                                         "image_left/000000_left.png",
                                                         "image_left/000001_left.png",
                                                         "pose_left.txt",
                                                         "left_images.txt",
                                                         "images.txt",
                                                         "lowres_wide/41_1.000.png",
                                                         "lowres_wide_intrinsics/41_1.000.pincam",
                                                         "lowres_wide.traj",
                                                         "rgb.mp4",
                                                         "odometry.csv",
                                                         "camera_matrix.csv",
                                                         "transforms.json",
                                                         "transforms_train.json",
                                                         "images/0.png",
                                                         "images/1.png",
                                                         "sparse/0/images.txt",
                                                         "sparse/0/images.bin",
                                                         "sparse/0/cameras.txt"};

inline const std::vector<std::string>& seeds() {
  const auto file = [](std::string_view name, std::string_view text = "") {
    return fuzzing::file_of(kNames, name, text);
  };
  const std::string tum = "0.0 0 0 0 0 0 0 1\n0.1 1 2 3 0 0 0 1\n",
                    kitti = "1 0 0 0 0 1 0 0 0 0 1 0\n1 0 0 1 0 1 0 0 0 0 1 0\n",
                    matrix = "1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n";
  static const std::vector<std::string> kSeeds{
      file("rgb.txt", "# rgb\n0.0 rgb/0.png\n0.1 rgb/1.png\n") + file("depth.txt", "0.01 depth/0.png\n") +
          file("groundtruth.txt", tum) + file("rgb/0.png") + file("rgb/1.png"),
      file("rgb/0.png") + file("rgb/1.png") + file("groundtruth.txt", "0 0 0 0 0 0 0 1\n1 1 2 3 0 0 0 1\n"),
      file("frame-000000.color.png") + file("frame-000000.pose.txt", matrix) +
          file("frame-000001.color.png") + file("frame-000001.pose.txt", matrix),
      file("mav0/cam0/data.csv", "#timestamp [ns],filename\n1403636580838555648,1403636580838555648.png\n") +
          file("mav0/cam0/data/1403636580838555648.png") +
          file("mav0/cam0/sensor.yaml",
               "T_BS:\n  cols: 4\n  rows: 4\n  data: [1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1]\nintrinsics: [458, "
               "457, 367, 248]\n") +
          file("mav0/state_groundtruth_estimate0/data.csv",
               "#timestamp,p_x,p_y,p_z,q_w,q_x,q_y,q_z\n1403636580838555648,1,2,3,1,0,0,0\n"),
      file("image_0/000000.png") + file("image_0/000001.png") + file("times.txt", "0\n0.1\n") +
          file("calib.txt", "P0: 7 0 6 0 0 7 1 0 0 0 1 0\n") + file("poses.txt", kitti),
      file("image_00/data/0000000000.png") +
          file("image_00/timestamps.txt", "2011-09-26 13:02:25.964389445\n") +
          file("oxts/data/0000000000.txt",
               "49.01 8.43 112 0.03 0.002 1.5 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0\n") +
          file("oxts/timestamps.txt", "2011-09-26 13:02:25.9\n") +
          file("calib_cam_to_cam.txt",
               "R_rect_00: 1 0 0 0 1 0 0 0 1\nP_rect_00: 7 0 6 0 0 7 1 0 0 0 1 0\nS_rect_00: 1242 375\n") +
          file("calib_imu_to_velo.txt", "R: 1 0 0 0 1 0 0 0 1\nT: 0 0 0\n") +
          file("calib_velo_to_cam.txt", "R: 1 0 0 0 1 0 0 0 1\nT: 0 0 0\n"),
      file("results/frame000000.jpg") + file("results/frame000001.jpg") +
          file("traj.txt", "1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1\n1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1\n") +
          file(
              "cam_params.json",
              R"({"camera": {"w": 1200, "h": 680, "fx": 600.0, "fy": 600.0, "cx": 599.5, "cy": 339.5, "scale": 6553.5}})"),
      file("color/0.jpg") + file("color/1.jpg") + file("pose/0.txt", matrix) + file("pose/1.txt", matrix) +
          file("intrinsic/intrinsic_color.txt", matrix) + file("depth/0.png"),
      file("color.txt", "1560000000.1 color/0.jpg\n") +
          file("aligned_depth.txt", "1560000000.1 depth/0.png\n") + file("groundtruth.txt", tum) +
          file("sensors.yaml",
               "d400_color_optical_frame:\n  width: 848\n  height: 480\n  intrinsics: [611, 611, 433, "
               "249]\n") +
          file("trans_matrix.yaml",
               "- parent_frame: base_link\n  child_frame: d400_color_optical_frame\n  matrix: [1,0,0,0, "
               "0,1,0,0, 0,0,1,0, 0,0,0,1]\n") +
          file("color/0.jpg"),
      file("image_left/000000_left.png") + file("image_left/000001_left.png") +
          file("pose_left.txt", "0 0 0 0 0 0 1\n1 0 0 0 0 0 1\n"),
      file("left_images.txt",
           "# id timestamp image_name\n0 1540113212.1 images/0.png\n1 1540113212.2 images/1.png\n") +
          file("images/0.png") + file("images/1.png") + file("groundtruth.txt", tum),
      file("lowres_wide/41_1.000.png") +
          file("lowres_wide_intrinsics/41_1.000.pincam", "256 192 210 210 128 96\n") +
          file("lowres_wide.traj", "1.0 0.1 0.2 0.3 1 2 3\n"),
      file("rgb.mp4") +
          file("odometry.csv",
               "timestamp, frame, x, y, z, qx, qy, qz, qw\n1.5, 000000, 0, 0, 0, 0, 0, 0, 1\n") +
          file("camera_matrix.csv", "1500, 0, 960\n0, 1500, 720\n0, 0, 1\n"),
      file("transforms.json",
           R"({"fl_x": 200, "frames": [{"file_path": "images/0.png", "timestamp": 1.5, "transform_matrix":
          [[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]]}]})") +
          file("images/0.png"),
      file("images/0.png") + file("images/1.png") +
          file("sparse/0/images.txt", "1 1 0 0 0 0 0 0 1 0.png\n\n2 1 0 0 0 1 0 0 1 1.png\n\n") +
          file("sparse/0/cameras.txt", "1 PINHOLE 320 240 200 200 160 120\n"),
      file("images/0.png") + file("images/1.png") + file("times.txt", "00000 1.5 0.02\n00001 1.6 0.02\n")};
  return kSeeds;
}

inline void check(const io::Dataset& dataset) {
  for (const std::string& warning : dataset.warnings)
    if (warning.find('\n') != std::string::npos) std::abort();
  for (std::size_t i = 0; i < dataset.frames.size(); ++i) {
    const io::FrameEntry& frame = dataset.frames[i];
    if (!std::isfinite(frame.stamp) || (i > 0 && !(frame.stamp > dataset.frames[i - 1].stamp))) std::abort();
    if (frame.truth >= static_cast<std::ptrdiff_t>(dataset.ground_truth.size())) std::abort();
  }
  for (const io::StampedPose& pose : dataset.ground_truth)
    if (!pose.world_from_cam.translation.allFinite() || !std::isfinite(pose.stamp)) std::abort();
}

}  // namespace layout_fuzz

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most,
                                               unsigned seed) {
  return sslam::fuzzing::mutate_or_begin(layout_fuzz::seeds(), data, size, most, seed);
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace layout_fuzz;
  const std::filesystem::path folder = fuzzing::empty_folder();
  fuzzing::for_each_file({reinterpret_cast<const char*>(data), size}, kNames,
                         [&](std::string_view name, std::string_view text) {
                           const std::filesystem::path file = folder / name;
                           std::filesystem::create_directories(file.parent_path());
                           fuzzing::write_bytes(file, text);
                         });
  fuzzing::expect_error([&] { check(io::open_dataset(folder)); });
  return 0;
}
