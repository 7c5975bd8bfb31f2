// SPDX-License-Identifier: BSD-3-Clause
// The folder of a run, read back: whatever of its files is there and sound.
#pragma once

#include <array>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "cli/results/map_colours.hpp"
#include "cli/results/textured_mesh.hpp"
#include "sslam/io/files/csv_reader.hpp"
#include "sslam/io/trajectories/trajectory.hpp"
#include "sslam/map/map.hpp"

namespace sslam::cli {

// Files that not every run writes; the others are named where they are written.
inline constexpr const char* kTruthFile = "groundtruth.txt";
inline constexpr const char* kViewFile = "views.bin";
inline constexpr const char* kColourFile = "colours.bin";  // of the map beside it
inline constexpr const char* kReportFile = "report.html";
inline constexpr const char* kCameraFoundFile = "camera_found.yaml";
inline constexpr const char* kModelFile = "model.glb";  // of `--dense`
inline constexpr const char* kModelPlyFile = "model.ply";
inline constexpr const char* kModelObjFile = "model.obj";  // with the next two beside it
inline constexpr const char* kModelMaterialFile = "model.mtl";
inline constexpr const char* kModelTextureFile = "model.jpg";
inline constexpr const char* kTopViewFile = "topview.svg";           // of a run that tracked something
inline constexpr const char* kCheckpointFile = ".sslam-checkpoint";  // of a run that has not ended
inline constexpr std::array kCheckpointFiles{kCheckpointFile, ".sslam-checkpoint.part"};

// Those that a run need not write.
inline constexpr std::array kOptionalFiles{
    "map.sslam", kColourFile,   kTruthFile,    kViewFile,          kReportFile,       kCameraFoundFile,
    kModelFile,  kModelPlyFile, kModelObjFile, kModelMaterialFile, kModelTextureFile, kTopViewFile};

struct RunFolder {
  std::string name;  // of the folder, for people
  nlohmann::ordered_json metrics = nlohmann::ordered_json::object();
  io::CsvTable frames;
  io::Trajectory trajectory, keyframes, truth;
  Map<double> map;
  MapColours colours;
  TexturedMesh surfaces;  // of `--dense`; empty: none
  std::vector<std::string> views;
  std::vector<std::string> problems;  // a line each: a file that is missing, damaged or flawed
};

// For people, however its path is written.
[[nodiscard]] std::string folder_name(const std::filesystem::path& folder);

// The map in `file`, and a warning where it is not that of the run beside it. Throws Error.
[[nodiscard]] Map<double> load_run_map(const std::filesystem::path& file);

// Whether that map is in metres, by the run beside it.
[[nodiscard]] bool is_metric_map(const std::filesystem::path& file);

// The colours of that map, from the file beside it; none where there is no such file, and with a warning
// where it does not fit.
[[nodiscard]] MapColours load_map_colours(const std::filesystem::path& file, const Map<double>& map);

// Throws Error when `folder` is none, or holds neither frames.csv nor metrics.json in a readable state.
[[nodiscard]] RunFolder read_run_folder(const std::filesystem::path& folder);

}  // namespace sslam::cli
