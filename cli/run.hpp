// SPDX-License-Identifier: BSD-3-Clause
// `sslam run` as a function, so that `sslam demo` calls the same, and its options, which suites of `sslam
// batch` have too.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cli/foxglove/endpoint.hpp"
#include "cli/shell/progress.hpp"
#include "sslam/io/datasets/dataset.hpp"

namespace CLI {
class App;
}

namespace sslam::cli {

// What --normals takes.
inline constexpr const char* kNormalsMeaning =
    "Surface normals: none (lines alone), depth, files:DIR, onnx (the network that comes with sslam) or "
    "onnx:FILE, for every frame; on-demand (that network) or on-demand:SOURCE, only where a frame's lines do "
    "not determine its rotation; default on-demand if that network is installed, else none; none for presets "
    "without a Manhattan world";

// What becomes of the calibration.
enum class CalibrationMode {
  kFixed,   // it is taken as it is
  kRefine,  // where the map contradicts it, the run begins again with the camera that was found
  kFind,    // it is a guess, and the camera is found before the run begins
};

struct Checkpoint;

struct RunSettings {
  std::string dataset;
  io::BagTopics topics;      // of a bag: where its images and their depth are
  std::string camera;        // file or name; empty: from the dataset
  double focal = 0;          // pixels, for a camera without calibration; 0: not given
  double fov = 0;            // the same as degrees across
  double undistort_fov = 0;  // of the pinhole's view that a wide lens's images become, degrees; 0: the usual
  CalibrationMode calibration = CalibrationMode::kRefine;
  std::string normals;  // empty: the shipped network on demand where it is installed, else none
  std::string mask;     // image, or folder with one a frame, of the pixels to use; empty: all
  std::string preset = "structure";
  std::string map;             // file of an earlier run to go on in; empty: none
  std::string scale = "none";  // as parse_scale takes it
  std::string out = "out";
  io::Slice slice;
  std::vector<std::string> set;                   // stage.parameter=value
  std::map<std::string, std::string> set_places;  // of those that a file gave: "FILE: line N: "
  std::uint64_t seed = 1;
  bool live = false;       // mapping in a thread of its own, frames when a camera would deliver them
  int longest_side = 960;  // of the images as they are worked on, pixels
  bool final_pass = true;  // all frames are tracked again in the finished map
  bool report = true;      // write report.html
  bool dense = false;      // write the dense model of planes
  double retry = 10;       // seconds that a lost stream is tried again for
  std::string record;      // folder to keep what is tracked in, as a dataset, or FILE.mcap; empty: none
  std::string video;       // overlay video to write; empty: none
  bool view = false;       // show the run while it goes on, and its report until Ctrl-C
  int port = 0;            // of that page; 0: any free one
  std::optional<Endpoint> foxglove;  // where Foxglove finds the run while it goes on; empty: nowhere
  double frame_rate = 30;            // frames a second, for images without stamps
  Verbosity verbosity = Verbosity::kNormal;
  std::optional<double> checkpoint;     // seconds from one to the next, at least; 0: none; empty: as is usual
  std::vector<std::string> words;       // of the command line, for checkpoints; empty: none are made
  std::shared_ptr<Checkpoint> resumed;  // to go on from; null: the run begins
};

// All options of `sslam run` but those of its messages; `settings` outlive the command.
void add_run_options(CLI::App& command, RunSettings& settings);

// Tracks the dataset and writes everything into settings.out. Throws Error; Stop when interrupted.
void run(RunSettings settings);

}  // namespace sslam::cli
