// SPDX-License-Identifier: BSD-3-Clause
// What can be wrong with the settings of a run, found before its first frame: `sslam run` checks itself,
// `sslam batch` all of its runs. Everything here throws a std::exception with one line.
#pragma once

#include <map>
#include <opencv2/core.hpp>
#include <string>

#include "cli/input/camera_choice.hpp"
#include "cli/input/normal_choice.hpp"
#include "cli/run.hpp"
#include "cli/run/checkpoint_clock.hpp"
#include "sslam/system/parameter_value.hpp"
#include "sslam/system/presets.hpp"

namespace sslam::cli {

[[nodiscard]] const Preset& choose_preset(const std::string& wanted);

// The frames that the settings ask for, of anything but a stream.
[[nodiscard]] io::Dataset open_run_dataset(const RunSettings& settings);

// The camera of images of the first one's size. What is to be told of it stands in the answer.
[[nodiscard]] CameraChoice choose_run_camera(const RunSettings& settings, const io::Dataset& dataset);

// Of the images that a calibration of a stream is for; empty: there is none, or it does not say.
[[nodiscard]] cv::Size size_of_stream_camera(const RunSettings& settings);

// As choose_run_camera, of a stream with images of this size.
[[nodiscard]] CameraChoice choose_stream_camera(const RunSettings& settings, const io::Dataset& dataset,
                                                cv::Size size);

// Whether the preset has what --live asks for.
void check_live(const RunSettings& settings, const Preset& preset);

// Whether the dataset has what settings.normals need.
void check_normals(const RunSettings& settings, const io::Dataset& dataset, double depth_factor);

// Whether a lens that is too wide for a pinhole leaves what the settings ask for.
void check_wide(const RunSettings& settings, const CameraChoice& camera);

// When the run's checkpoints are due, if any are made.
[[nodiscard]] CheckpointClock checkpoint_clock(const RunSettings& settings);

// Each "stage.parameter=value", if the preset has all these parameters and they take these values. `places`:
// of those that stand in a file, where; what is wrong with one is then an Error that begins with it.
[[nodiscard]] std::vector<ParameterValue> set_parameters(
    const Preset& preset, const std::vector<std::string>& set,
    const std::map<std::string, std::string>& places = {});

// Every parameter of the fullest preset by stage: name, default, unit, range and meaning, a line each.
[[nodiscard]] std::string describe_parameters();

// Whether --record names a file for the results, FILE.mcap, rather than a folder for the images. Throws Error
// where there is no folder for it.
[[nodiscard]] bool records_results(const RunSettings& settings);

}  // namespace sslam::cli
