// SPDX-License-Identifier: BSD-3-Clause
#include "cli/run/metric_scale.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "cli/input/frame_reader.hpp"
#include "cli/run/depth_image.hpp"
#include "cli/shell/exit_code.hpp"
#include "sslam/map/depth_ratios.hpp"
#include "sslam/map/floor.hpp"
#include "sslam/map/rescale.hpp"

namespace sslam::cli {
namespace {

std::map<std::int64_t, const io::FrameEntry*> frames_with_depth(const io::Dataset& dataset) {
  std::map<std::int64_t, const io::FrameEntry*> frames;
  for (const io::FrameEntry& frame : dataset.frames)
    if (!frame.depth.empty()) frames[frame.index] = &frame;
  return frames;
}

void scale_by_depth(const RunOutcome& outcome, const ScaleInput& input, ScaleRecord& scale) {
  constexpr std::size_t kLandmarks = 10, kKeyframes = 2;  // of a keyframe; of the map
  constexpr double kAgree = 0.3, kFarthest = 200;         // metres: no sensor sees farther indoors
  const auto frames = frames_with_depth(input.dataset);
  FrameReader reader(input.dataset);
  std::vector<double> medians, all;
  std::string fault;  // of the first depth image that cannot be used
  for (const Keyframe<double>& kf : outcome.map.keyframes) {
    if (!kf.alive()) continue;
    const auto entry = frames.find(kf.frame.index);
    // A keyframe of the map that the run went on in may have the number of another image.
    if (entry == frames.end() || entry->second->stamp != kf.frame.stamp) continue;
    std::string why;
    const cv::Mat read = reader.read_depth(*entry->second, why);
    if (read.empty()) {
      if (fault.empty()) fault = why;
      continue;
    }
    if (const double middle = median_of_floats(read); middle > kFarthest) {
      scale.problem = entry->second->depth + ": its floats have the median " +
                      std::to_string(static_cast<int>(middle)) + "; expected metres: are these millimetres?";
      return;
    }
    const DepthImage depth(read, input.depth_factor, input.working_camera);
    if (!depth.fits()) {
      scale.problem = entry->second->depth + ": is no depth image of the shape of the colour images";
      return;
    }
    std::vector<double> ratios = depth_ratios(outcome.map, kf, depth);
    if (ratios.size() < kLandmarks) continue;
    all.insert(all.end(), ratios.begin(), ratios.end());
    medians.push_back(median<double>(ratios));
  }
  scale.samples = static_cast<int>(medians.size());
  scale.landmarks = static_cast<int>(all.size());
  if (medians.size() < kKeyframes) {
    scale.problem = std::to_string(medians.size()) + " keyframes have depth at " +
                    std::to_string(kLandmarks) + " of their landmarks or more, " +
                    std::to_string(kKeyframes) + " are needed" + (fault.empty() ? "" : "; " + fault);
    return;
  }
  const CommonRatio<double> common = common_ratio<double>(medians);
  scale.spread = common.spread;
  // Depth of something else may have a middle, too.
  const double apart = std::max(common.spread, common_ratio<double>(all).spread);
  if (apart > kAgree) {
    scale.problem = "depth and map do not agree: their ratio differs by " +
                    std::to_string(static_cast<int>(100 * apart)) + " % from landmark to landmark";
    return;
  }
  scale.factor = common.value;
}

void scale_by_height(double metres, const RunOutcome& outcome, ScaleRecord& scale) {
  const Floor<double> floor = find_floor(outcome.map);
  if (floor.status != FloorStatus::kFound) {
    scale.problem = std::string("no floor was found: ") + name(floor.status);
    return;
  }
  scale.factor = metres / floor.camera_height;
  scale.spread = floor.spread;
  scale.landmarks = floor.support;
  scale.samples = static_cast<int>(std::count_if(outcome.map.keyframes.begin(), outcome.map.keyframes.end(),
                                                 [](const Keyframe<double>& kf) { return kf.alive(); }));
}

// Where the camera was in a frame of this index; nothing where it has no pose.
std::optional<Vec3<double>> place_of(const io::Dataset& dataset, const io::Trajectory& trajectory,
                                     std::int64_t index) {
  for (const io::FrameEntry& frame : dataset.frames) {
    if (frame.index != index) continue;
    const auto pose = std::find_if(trajectory.begin(), trajectory.end(),
                                   [&](const io::StampedPose& p) { return p.stamp == frame.stamp; });
    if (pose != trajectory.end()) return pose->world_from_cam.translation;
  }
  return std::nullopt;
}

void scale_by_distance(const ScaleWish& wish, const RunOutcome& outcome, const ScaleInput& input,
                       ScaleRecord& scale) {
  constexpr double kFarEnough = 0.02;  // of the path's extent: less is as uncertain as the path itself
  const io::Trajectory& path = outcome.trajectory;
  if (path.size() < 2) {
    scale.problem = "fewer than two frames have a pose";
    return;
  }
  Vec3<double> a = path.front().world_from_cam.translation, b = path.back().world_from_cam.translation;
  if (wish.first) {
    for (const auto& [index, place] : {std::pair(*wish.first, &a), std::pair(*wish.second, &b)}) {
      const auto found = place_of(input.dataset, path, index);
      if (!found) {
        scale.problem = "frame " + std::to_string(index) + " has no pose";
        return;
      }
      *place = *found;
    }
  }
  Vec3<double> low = a, high = a;
  for (const io::StampedPose& pose : path) {
    low = low.cwiseMin(pose.world_from_cam.translation);
    high = high.cwiseMax(pose.world_from_cam.translation);
  }
  const double apart = (b - a).norm();
  if (!(apart > kFarEnough * (high - low).norm())) {
    scale.problem = std::string(wish.first ? "the two frames" : "the first and the last frame with a pose") +
                    " are at nearly the same place; choose two others, as known=METRES@FRAME:FRAME";
    return;
  }
  scale.factor = wish.metres / apart;
}

// The scale of the outcome's map, which is left as it is. Where none is found, `problem` says why.
ScaleRecord find_scale(const ScaleWish& wish, const RunOutcome& outcome, const ScaleInput& input) {
  ScaleRecord scale;
  switch (wish.method) {
    case ScaleMethod::kNone:
      if (input.metric_map) {
        scale.method = "map";
        scale.metric = true;
      }
      return scale;
    case ScaleMethod::kDepth:
      scale.method = "depth";
      scale_by_depth(outcome, input, scale);
      break;
    case ScaleMethod::kHeight:
      scale.method = "height";
      scale_by_height(wish.metres, outcome, scale);
      break;
    case ScaleMethod::kKnown:
      scale.method = "known";
      scale_by_distance(wish, outcome, input, scale);
      break;
  }
  if (scale.problem.empty() && !(scale.factor > 0 && std::isfinite(scale.factor)))
    scale.problem = "the map has no extent to measure";
  if (scale.problem.empty())
    scale.metric = true;
  else
    scale.factor = 1;
  return scale;
}

// Brings poses and map to metres.
void apply_scale(const ScaleRecord& scale, RunOutcome& outcome) {
  if (scale.factor == 1) return;
  rescale(outcome.map, scale.factor);
  for (io::Trajectory* poses : {&outcome.trajectory, &outcome.keyframes})
    for (io::StampedPose& pose : *poses) pose.world_from_cam = rescaled(pose.world_from_cam, scale.factor);
  for (FrameRecord& frame : outcome.frames)
    frame.cam_from_world = rescaled(frame.cam_from_world, scale.factor);
}

}  // namespace

void check_scale(const ScaleWish& wish, const io::Dataset& dataset, double depth_factor) {
  const bool stream = dataset.layout == io::Layout::kStream;
  if (wish.method == ScaleMethod::kDepth) {
    if (frames_with_depth(dataset).empty())
      throw Error("--scale depth: " + dataset.root.string() +
                  " has no depth images; use height=METRES or known=METRES");
    if (!(depth_factor > 0))
      throw Error("--scale depth: the depth scale is not known; give DepthMapFactor in the camera file");
  }
  if (!wish.first || stream) return;
  for (const std::int64_t index : {*wish.first, *wish.second})
    if (std::none_of(dataset.frames.begin(), dataset.frames.end(),
                     [index](const io::FrameEntry& frame) { return frame.index == index; }))
      throw Error("--scale known: frame " + std::to_string(index) + " is not among those that are tracked, " +
                  std::to_string(dataset.frames.front().index) + " to " +
                  std::to_string(dataset.frames.back().index));
}

void bring_to_metres(const ScaleWish& wish, const ScaleInput& input, RunOutcome& outcome) {
  outcome.scale = find_scale(wish, outcome, input);
  apply_scale(outcome.scale, outcome);
  if (!outcome.scale.problem.empty() && !outcome.trajectory.empty())
    outcome.warnings.push_back("--scale " + outcome.scale.method + ": " + outcome.scale.problem +
                               "; the results stay in the map's own unit");
}

}  // namespace sslam::cli
