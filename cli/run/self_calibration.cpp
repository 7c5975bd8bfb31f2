// SPDX-License-Identifier: BSD-3-Clause
#include "cli/run/self_calibration.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <limits>
#include <utility>

#include "cli/input/frame_stream.hpp"
#include "cli/shell/interrupt.hpp"
#include "sslam/ceres/camera_adjustment.hpp"
#include "sslam/geometry/camera_check.hpp"

namespace sslam::cli {
namespace {

std::size_t count_keyframes(const Map<double>& map) {
  return static_cast<std::size_t>(
      std::count_if(map.keyframes.begin(), map.keyframes.end(), [](const auto& kf) { return kf.alive(); }));
}

// A round costs little, so that it may be for a small gain.
constexpr double kMinGain = 0.02;

// One round: as much of the dataset as it takes.
CameraFinding probe(const io::Dataset& dataset, Settings settings, const MaskSource& masks,
                    const CameraPrior& prior) {
  System system(std::move(settings));
  FrameStream stream(dataset, system, 0, masks);
  ExtractedFrame input;
  constexpr std::array<std::size_t, 3> kEnough{20, 40, 80};  // keyframes at which the map is asked
  const auto* next = kEnough.begin();
  while (!Interrupt::asked() && stream.next(input)) {
    if (!input.usable() || !system.track(input).keyframe) continue;
    if (next == kEnough.end() || count_keyframes(system.map()) < *next) continue;
    ++next;
    CameraFinding found = examine_camera(system, prior, kMinGain);
    if (found.verdict != CameraVerdict::kOpen) return found;
  }
  system.finish();
  return examine_camera(system, prior, kMinGain);
}

}  // namespace

CameraFinding examine_camera(const System& system, const CameraPrior& prior, double min_gain) {
  CameraFinding found;
  found.camera = system.settings().camera;
  constexpr std::size_t kFewest = 5;  // keyframes
  if (count_keyframes(system.map()) < kFewest) return found;
  CameraAdjustment adjustment;
  adjustment.options.prior = prior;
  found.estimate = adjustment.estimate(system.map(), system.camera());
  if (!usable(found.estimate.status)) return found;
  LensChange<double> change = found.estimate.change;
  change[1] *= static_cast<double>(found.camera.width) / system.camera().width;
  change[2] *= static_cast<double>(found.camera.height) / system.camera().height;
  found.camera = changed(found.camera, change);
  if (check_camera(found.camera).fault.empty())
    found.verdict = judge_camera(system.camera(), found.estimate, {.min_gain = min_gain});
  else
    found.camera = system.settings().camera;
  return found;
}

CameraFinding find_camera(const io::Dataset& dataset, const Settings& settings, const MaskSource& masks,
                          const CameraPrior& prior) {
  Settings wanted = settings;
  wanted.normals = {};
  wanted.final_pass = wanted.keep_pictures = wanted.live = false;
  CameraFinding best;
  best.camera = settings.camera;
  constexpr int kRounds = 6;
  for (int round = 0; round < kRounds && !Interrupt::asked(); ++round) {
    CameraFinding found = probe(dataset, wanted, masks, prior);
    if (found.verdict == CameraVerdict::kOpen) break;
    best = std::move(found);
    if (best.verdict == CameraVerdict::kAgrees) break;
    wanted.camera = best.camera;
  }
  return best;
}

std::string camera_text(const Camera<double>& camera) {
  char text[160];
  std::snprintf(text, sizeof text, "focal length %.1f pixels, centre (%.1f, %.1f), k1 %.4f, k2 %.4f",
                camera.pinhole.fx, camera.pinhole.cx, camera.pinhole.cy, camera.distortion.k1,
                camera.distortion.k2);
  return text;
}

}  // namespace sslam::cli
