// SPDX-License-Identifier: BSD-3-Clause
// Folders of runs, of which any file may be another's, or none: what can be read goes into the report's page.
#include "cli/report/report_data.hpp"
#include "cli/results/keyframe_images.hpp"
#include "cli/results/run_folder.hpp"
#include "fuzz/made_folder.hpp"
#include "fuzz/seeds.hpp"
#include "sslam/io/maps/map_file.hpp"
#include "support/map_scene.hpp"

namespace run_folder_fuzz {

using namespace sslam;

inline constexpr std::array<std::string_view, 9> kNames{"metrics.json",    "frames.csv",  "keyframes.txt",
                                                        "trajectory.txt",  "map.sslam",   "views.bin",
                                                        "groundtruth.txt", "colours.bin", "model.glb"};

// The fields alone: its head is put before them when it is written.
inline std::string small_map() {
  testing::MapSceneOptions options;
  options.points = 6;
  options.lines = 2;
  std::vector<SE3<double>> path;
  for (int k = 0; k < 2; ++k) path.push_back(testing::look({0.3 * k, 0, -2}, 0.05 * k, 0));
  Map<double> map = testing::MapScene(options, path).make_map();
  io::ByteWriter writer;
  io::MapFields(writer).walk(map);
  return writer.bytes;
}

inline const std::vector<std::string>& seeds() {
  const auto file = [](std::string_view name, std::string_view text) {
    return fuzzing::file_of(kNames, name, text);
  };
  const std::string
      poses = "0.0 0 0 0 0 0 0 1\n0.1 1 0 0 0 0 0 1\n",
      frames = "index,stamp,image,state,keyframe\n0,0.0,a.png,ok,1\n1,0.1,\"v.mp4 frame 1\",ok,0\n",
      metrics =
          R"({"frames": 2, "tracked": 2, "keyframes": 2, "settings": {"topic": ""}, "scale": {"metric": true}, "files": {"frames.csv": "0"},
                        "trajectory": {"alignment": {"rotation_xyzw": [0,0,0,1], "translation_m": [0,0,0], "scale": 1.5}, "max_difference": 0.02}})";
  static const std::vector<std::string> kSeeds{
      file("metrics.json", metrics) + file("frames.csv", frames) + file("keyframes.txt", poses) +
          file("trajectory.txt", poses) + file("groundtruth.txt", poses) + file("map.sslam", small_map()) +
          file("views.bin", std::string("SSLAMVW1\3\0\0\0abc", 15)),
      file("metrics.json", R"({"tracked": 0, "keyframes": 0})") + file("frames.csv", frames),
      file("frames.csv", frames)};
  return kSeeds;
}

}  // namespace run_folder_fuzz

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most,
                                               unsigned seed) {
  return sslam::fuzzing::mutate_or_begin(run_folder_fuzz::seeds(), data, size, most, seed);
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace run_folder_fuzz;
  const std::filesystem::path folder = fuzzing::empty_folder();
  fuzzing::for_each_file(
      {reinterpret_cast<const char*>(data), size}, kNames, [&](std::string_view name, std::string_view text) {
        const std::string head = name == "map.sslam" ? io::sealed_head(io::kMapFile, text) : "";
        fuzzing::write_bytes(folder / name, head + std::string(text));
      });
  fuzzing::expect_message([&] {
    cli::RunFolder run = cli::read_run_folder(folder);
    (void)cli::keyframe_images(run);
    const auto page = cli::report_data(run);
    (void)page.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
  });
  return 0;
}
