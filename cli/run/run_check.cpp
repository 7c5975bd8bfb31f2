// SPDX-License-Identifier: BSD-3-Clause
#include "cli/run/run_check.hpp"

#include <algorithm>
#include <cstdio>
#include <memory>
#include <string_view>
#include <utility>

#include "cli/input/image_file.hpp"
#include "cli/shell/messages.hpp"
#include "sslam/io/datasets/open_dataset.hpp"
#include "sslam/io/files/text.hpp"
#include "sslam/opencv/parameters.hpp"

namespace sslam::cli {
namespace {

void check(const ParameterAnswer& answer) {
  if (!answer.ok()) throw io::Error("--set " + answer.message);
}

void set_one(const std::string& text, ParameterTable& table) {
  const auto equals = text.find('=');
  const auto value =
      equals == std::string::npos ? std::nullopt : io::parse_number<double>(text.substr(equals + 1));
  if (!value || !std::isfinite(*value)) throw Error("--set " + text + ": expected stage.parameter=number");
  return {text.substr(0, equals), *value};
}

// Parameters of which one must stay below another, and what a run would else do without a word.
struct Order {
  std::string_view low, high, otherwise;
};
constexpr std::array<Order, 2> kOrders{{
    {"rotation.squareness", "rotation.max_sigma", "no rotation would be trusted"},
    {"rotation.narrowest_kernel", "rotation.widest_kernel", "the search could not narrow"},
}};

void check_orders(const std::vector<ParameterInfo>& parameters) {
  const auto find = [&](std::string_view name) {
    return std::find_if(parameters.begin(), parameters.end(),
                        [name](const ParameterInfo& parameter) { return parameter.name == name; });
  };
  for (const Order& order : kOrders) {
    const auto low = find(order.low), high = find(order.high);
    if (low == parameters.end() || high == parameters.end() || low->value < high->value) continue;
    char values[80];
    std::snprintf(values, sizeof values, "%g is not below the %g of ", low->value, high->value);
    throw Error("--set " + low->name + ": " + values + high->name + ": " + std::string(order.otherwise));
  }
}

// Throws Error when there is no image to read.
cv::Size first_image_size(const io::Dataset& dataset) {
  if (dataset.layout == io::Layout::kVideo) {
    const cv::VideoCapture video(dataset.root.string());
    return {static_cast<int>(video.get(cv::CAP_PROP_FRAME_WIDTH)),
            static_cast<int>(video.get(cv::CAP_PROP_FRAME_HEIGHT))};
  }
  std::string why;
  for (const io::FrameEntry& frame : dataset.frames) {
    const cv::Mat image = load_image(frame.image, cv::IMREAD_COLOR, why);
    if (!image.empty()) return image.size();
  }
  throw Error(why + "; no image can be read");
}

}  // namespace

const Preset& choose_preset(const std::string& wanted) {
  try {
    return find_preset(wanted);
  } catch (const Error& error) {
    throw Error(std::string("--preset ") + error.what());
  }
}

io::Dataset open_run_dataset(const RunSettings& settings) {
  io::Dataset dataset = io::open_dataset(settings.dataset, {settings.frame_rate});
  if (dataset.layout == io::Layout::kVideo) list_video_frames(dataset);
  io::apply_slice(dataset, settings.slice);
  print_warnings(dataset.warnings);
  return dataset;
}

CameraChoice choose_run_camera(const RunSettings& settings, const io::Dataset& dataset) {
  const cv::Size size = first_image_size(dataset);
  return choose_camera({settings.camera, settings.focal, settings.fov}, dataset, size.width, size.height);
}

void check_live(const RunSettings& settings, const Preset& preset) {
  if (!settings.live || preset.make_live != nullptr) return;
  std::string able;
  for (const Preset& p : all_presets())
    if (p.make_live != nullptr) io::add_to_list(able, p.name);
  throw Error("--live: not with --preset " + settings.preset + "; use one of " + able);
}

void check_normals(const RunSettings& settings, const io::Dataset& dataset, double depth_factor) {
  if (settings.normals != "depth") return;
  const bool any = std::any_of(dataset.frames.begin(), dataset.frames.end(),
                               [](const io::FrameEntry& frame) { return !frame.depth.empty(); });
  if (!any) throw Error("--normals depth: " + settings.dataset + " has no depth images; use --normals none");
  if (!(depth_factor > 0))
    throw Error("--normals depth: the depth scale is not known; give DepthMapFactor in the camera file");
}

std::vector<ParameterValue> check_overrides(const Preset& preset, const std::vector<std::string>& set) {
  const std::unique_ptr<Engine> engine = preset.make();
  std::vector<ParameterValue> overrides;
  for (const std::string& text : set) {
    overrides.push_back(parse_override(text));
    try {
      engine->set(overrides.back());
    } catch (const Error& error) {
      throw Error(std::string("--set ") + error.what());
    }
  }
  check_orders(engine->parameters());
  return overrides;
}

}  // namespace sslam::cli
