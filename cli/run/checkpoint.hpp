// SPDX-License-Identifier: BSD-3-Clause
// Where a run stands after some frame, in a file: what another process needs to go on from there.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "cli/results/frame_record.hpp"
#include "cli/results/map_colours.hpp"
#include "sslam/geometry/camera.hpp"
#include "sslam/io/datasets/dataset.hpp"
#include "sslam/system/system.hpp"

namespace sslam::cli {

struct CheckpointHead {
  std::string version;             // of sslam
  std::vector<std::string> words;  // of the run's command line, without its folder
  std::uint64_t frames = 0;        // of the dataset
  std::uint64_t frame_list = 0;    // checksum of their names and stamps
  Camera<double> given;            // of the images, before the run
  Camera<double> used;             // the same, or the one that was found
  std::string camera_source;       // of that
  bool camera_replaced = false;
  std::vector<std::string> camera_warnings;
  std::uint64_t next = 0;             // position in the dataset of the first frame that is still to come
  std::uint64_t known_keyframes = 0;  // of the map that the run goes on in
  int last_world = 0;                 // number of the world that was begun last
};

struct Checkpoint : CheckpointHead {
  RunOutcome outcome;  // what has been recorded
  FeatureColours colours;
  std::vector<World<double>> worlds;  // maps and logs, the camera's first
};

// Of a run that begins, with the camera that it is given.
[[nodiscard]] CheckpointHead begun_checkpoint(const std::vector<std::string>& words,
                                              const io::Dataset& dataset, const Camera<double>& camera);

// Throws Error with one line where dataset or camera are others than those of the checkpoint.
void check_resumed(const Checkpoint& checkpoint, const io::Dataset& dataset, const Camera<double>& camera,
                   const std::filesystem::path& folder);

// Takes the place of an older one as a whole. Changes nothing of what it writes down. Throws Error.
void write_checkpoint(const std::filesystem::path& folder, const CheckpointHead& head,
                      const RunOutcome& outcome, const FeatureColours& colours,
                      const std::vector<const World<double>*>& worlds);

[[nodiscard]] bool has_checkpoint(const std::filesystem::path& folder);

// Throws Error when there is none, or none of this sslam.
[[nodiscard]] Checkpoint read_checkpoint(const std::filesystem::path& folder);

}  // namespace sslam::cli
