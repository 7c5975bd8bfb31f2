// SPDX-License-Identifier: BSD-3-Clause
#include "cli/run/run_check.hpp"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <utility>

#include "cli/input/first_image.hpp"
#include "cli/input/open_images.hpp"
#include "cli/results/result_set.hpp"
#include "cli/shell/exit_code.hpp"
#include "cli/shell/messages.hpp"
#include "cli/stream/stream_name.hpp"
#include "sslam/io/files/text.hpp"
#include "sslam/system/parameters.hpp"

namespace sslam::cli {
namespace {

ParameterValue parse_override(const std::string& text) {
  const auto equals = text.find('=');
  const auto value =
      equals == std::string::npos ? std::nullopt : io::parse_number<double>(text.substr(equals + 1));
  if (!value) throw UsageError("--set " + text + ": expected stage.parameter=number");
  return {text.substr(0, equals), *value};
}

}  // namespace

const Preset& choose_preset(const std::string& wanted) {
  try {
    return find_preset(wanted);
  } catch (const Error& error) {
    throw UsageError(std::string("--preset ") + error.what());
  }
}

io::Dataset open_run_dataset(const RunSettings& settings) {
  if (stream_named(settings.dataset))
    throw Error(settings.dataset + ": is a stream, which cannot be read twice; use sslam run");
  settle_results(settings.dataset);  // of `sslam synth`
  io::Dataset dataset =
      open_frames(settings.dataset, {settings.frame_rate}, settings.topics, settings.slice.end);
  io::apply_slice(dataset, settings.slice);
  print_warnings(dataset.warnings);
  return dataset;
}

CameraChoice choose_run_camera(const RunSettings& settings, const io::Dataset& dataset) {
  return camera_for_images({settings.camera, settings.focal, settings.fov, settings.undistort_fov}, dataset);
}

cv::Size size_of_stream_camera(const RunSettings& settings) {
  io::Dataset stream;
  stream.layout = io::Layout::kStream;
  const std::optional<CameraChoice> known = find_camera(settings.camera, stream);
  return known && known->all.empty() ? cv::Size(known->camera.width, known->camera.height) : cv::Size();
}

CameraChoice choose_stream_camera(const RunSettings& settings, const io::Dataset& dataset, cv::Size size) {
  return choose_camera({settings.camera, settings.focal, settings.fov, settings.undistort_fov}, dataset,
                       size.width, size.height);
}

void check_live(const RunSettings& settings, const Preset& preset) {
  if (!settings.live || preset.make_live != nullptr) return;
  std::string able;
  for (const Preset& p : all_presets())
    if (p.make_live != nullptr) io::add_to_list(able, p.name);
  throw UsageError("--live: not with --preset " + settings.preset + "; use one of " + able);
}

void check_normals(const RunSettings& settings, const io::Dataset& dataset, double depth_factor) {
  if (source_of_normals(settings.normals) != "depth") return;
  const bool any = std::any_of(dataset.frames.begin(), dataset.frames.end(),
                               [](const io::FrameEntry& frame) { return !frame.depth.empty(); });
  if (!any) throw Error("--normals depth: " + settings.dataset + " has no depth images; use --normals none");
  if (!(depth_factor > 0))
    throw Error("--normals depth: the depth scale is not known; give DepthMapFactor in the camera file");
}

void check_wide(const RunSettings& settings, const CameraChoice& camera) {
  if (!camera.wide) return;
  const bool pixels = settings.normals == "depth" || settings.normals.starts_with("files:");
  if (pixels)
    throw Error("--normals " + settings.normals +
                ": they are those of the wide lens's images, which are undistorted; " + "use none or onnx");
  if (settings.scale == "depth")
    throw Error(
        "--scale depth: the depth images are those of a wide lens, whose images are undistorted; use "
        "height=METRES or known=METRES");
}

bool records_results(const RunSettings& settings) {
  const std::filesystem::path file(settings.record);
  if (file.extension() != ".mcap") return false;
  const std::filesystem::path folder = file.parent_path();
  std::error_code ignored;
  if (!folder.empty() && !std::filesystem::is_directory(folder, ignored))
    throw Error("--record " + settings.record + ": there is no folder " + folder.string());
  if (std::filesystem::is_directory(file, ignored))
    throw Error("--record " + settings.record + ": is a folder; choose another name");
  return true;
}

CheckpointClock checkpoint_clock(const RunSettings& settings) {
  const CheckpointClock never(0, 0);
  const std::pair<bool, const char*> hindrances[] = {
      {settings.live, "--live, which is not repeatable"},
      {settings.view, "--view, whose page would lack the earlier frames"},
      {!settings.video.empty(), "--video, which would start again"},
      {!settings.record.empty() && !records_results(settings), "--record, which would start again"},
      {settings.dense, "--dense, whose images are not kept"},
      {stream_named(settings.dataset).has_value(), "a stream, which cannot be read again"},
  };
  for (const auto& [there, what] : hindrances) {
    if (!there) continue;
    if (settings.checkpoint.value_or(0) > 0) throw UsageError(std::string("--checkpoint: not with ") + what);
    return never;
  }
  if (settings.words.empty()) return never;
  // As usual: once a minute, and a hundredth of the time at most.
  return settings.checkpoint ? CheckpointClock(*settings.checkpoint, 0) : CheckpointClock(60, 100);
}

std::vector<ParameterValue> set_parameters(const Preset& preset, const std::vector<std::string>& set,
                                           const std::map<std::string, std::string>& places) {
  std::vector<ParameterValue> overrides;
  ParameterTable table = all_parameters(preset);
  const auto demand = [&places](const ParameterAnswer& answer, const std::string& text) {
    if (answer.ok()) return;
    const auto place = places.find(text);
    if (place != places.end()) throw Error(place->second + "[set] " + answer.message);
    throw UsageError("--set " + answer.message);
  };
  for (const std::string& text : set) {
    overrides.push_back(parse_override(text));
    demand(table.set(overrides.back().name, overrides.back().value), text);
  }
  demand(table.check(), set.empty() ? std::string() : set.back());  // of several against each other
  return overrides;
}

std::string describe_parameters() {
  std::string text, group;
  const ParameterTable table = all_parameters(find_preset("structure"));
  for (const Parameter& parameter : table.entries()) {
    const std::string stage = parameter.name.substr(0, parameter.name.find('.'));
    if (!group.empty() && stage != group) text += '\n';
    group = stage;
    const char* const unit = name(parameter.unit);
    char line[256];
    std::snprintf(line, sizeof line, "%-44s %8g  %-8s %-18s  %s\n", parameter.name.c_str(), parameter.initial,
                  *unit == '\0' ? "-" : unit, ParameterTable::range(parameter).c_str(),
                  parameter.meaning.c_str());
    text += line;
  }
  return text;
}

}  // namespace sslam::cli
