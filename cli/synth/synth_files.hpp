// SPDX-License-Identifier: BSD-3-Clause
// The files of a synthetic data set: images, lists, camera, and a manifest that tells how it was made.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "cli/synth.hpp"
#include "sslam/geometry/camera.hpp"
#include "sslam/io/trajectories/trajectory.hpp"
#include "sslam/synth/outline.hpp"
#include "sslam/synth/rendered_frame.hpp"

namespace sslam::cli {

inline constexpr double kDepthFactor = 5000.0;  // depth image units per metre

// All that a synthetic data set may have, by its names in the folder.
inline constexpr std::array kSynthParts{
    "rgb",         "depth",       "normals",          "rgb.txt",         "depth.txt",
    "normals.txt", "camera.yaml", "camera_true.yaml", "groundtruth.txt", "synth.toml"};

// Makes the folder. Throws Error where it holds a data set of another kind.
void claim_synth_folder(const std::string& folder);

// Makes the sub-folders for the images.
void prepare_image_folders(const SynthSettings& settings);

// Buffers of one thread for the images of one frame.
class FrameWriter {
 public:
  explicit FrameWriter(const SynthSettings& settings) : settings_(settings) {}
  // rgb: 8 bits, 3 per pixel, red first.
  void write(int number, const synth::RenderedFrame& frame, const std::vector<std::uint8_t>& rgb);

 private:
  void write_depth(const std::string& name, const synth::RenderedFrame& frame);
  void write_normals(const std::string& name, const synth::RenderedFrame& frame);

  const SynthSettings& settings_;
};

// rgb.txt, depth.txt, normals.txt, groundtruth.txt, camera.yaml and synth.toml for the first truth.size()
// frames; camera_true.yaml where camera.yaml is to be wrong.
void write_synth_lists(const SynthSettings& settings, const Camera<double>& camera,
                       const synth::Outline& outline, const io::Trajectory& truth);

}  // namespace sslam::cli
