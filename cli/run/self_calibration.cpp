// SPDX-License-Identifier: BSD-3-Clause
#include "cli/run/self_calibration.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "cli/input/frame_stream.hpp"
#include "cli/shell/interrupt.hpp"
#include "cli/shell/messages.hpp"
#include "sslam/ceres/camera_adjustment.hpp"
#include "sslam/geometry/camera_check.hpp"

namespace sslam::cli {
namespace {

std::size_t count_keyframes(const Map<double>& map) {
  return static_cast<std::size_t>(
      std::count_if(map.keyframes.begin(), map.keyframes.end(), [](const auto& kf) { return kf.alive(); }));
}

// min_gain: see CameraVerdictOptions.
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

// A round costs little, so that it may be for a small gain.
constexpr double kMinGain = 0.02;

// One round: as much of the dataset as it takes, with the final pass, in whose map features are better
// placed.
CameraFinding probe(io::Dataset& dataset, Settings settings, const MaskSource& masks,
                    const CameraPrior& prior) {
  System system(std::move(settings));
  FrameStream stream(dataset, system, {0, masks, nullptr, nullptr, nullptr});
  ExtractedFrame input;
  constexpr std::array<std::size_t, 3> kEnough{20, 40, 80};  // keyframes at which the map is asked
  const auto* next = kEnough.begin();
  CameraFinding found;
  while (found.verdict == CameraVerdict::kOpen && !Interrupt::asked() && stream.next(input)) {
    if (!input.usable() || !system.track(input).keyframe) continue;
    if (next == kEnough.end() || count_keyframes(system.map()) < *next) continue;
    ++next;
    found = examine_camera(system, prior, kMinGain);
  }
  system.finish();
  CameraFinding finished = examine_camera(system, prior, kMinGain);
  return finished.verdict == CameraVerdict::kOpen ? found : finished;
}

// Tracks the first part of the dataset with `settings` until the map says something about the camera, again
// and again with the camera that was found, until it agrees with itself. Lines alone give the rotation, and
// nobody looks on. kOpen: nothing was found, and the given camera stands in the answer.
CameraFinding find_camera_by_tracking(io::Dataset& dataset, const Settings& settings, const MaskSource& masks,
                                      const CameraPrior& prior) {
  Settings wanted = settings;
  wanted.normals = {};
  wanted.final_pass = true;
  wanted.keep_pictures = wanted.live = false;
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

}  // namespace

SelfCalibration::SelfCalibration(io::Dataset& dataset, const MaskSource& masks, const CameraChoice& camera,
                                 bool guess)
    : dataset_(dataset), masks_(masks), source_(camera.source) {
  prior_.focal = guess ? std::max(camera.focal_sigma, kUnknownFocal) : camera.focal_sigma;
  guess_ = prior_.focal > CameraPrior().focal;
  record_.given = camera.camera;
  record_.depth_factor = camera.depth_factor;
  record_.frame_rate = camera.frame_rate;
}

void SelfCalibration::examine(const System& system) {
  record_.last = examine_camera(system, prior_, CameraVerdictOptions().min_gain);
}

void SelfCalibration::find(Settings settings, CameraChoice& camera, const std::string& where) {
  if (contradicts()) settings.camera = record_.last.camera;  // a better start than the given one
  const CameraFinding found = find_camera_by_tracking(dataset_, settings, masks_, prior_);
  if (found.verdict == CameraVerdict::kOpen && !contradicts()) {
    if (!Interrupt::asked())
      warnings_.push_back("the images do not determine the camera (does it only move straight ahead?): " +
                          source_ + " is kept");
    return;
  }
  camera.camera = found.verdict == CameraVerdict::kOpen ? record_.last.camera : found.camera;
  camera.source = "found (" + source_ + ")";
  record_.replaced = true;
  const std::string text = camera_text(camera.camera) + "; " + where + " has it";
  if (guess_)
    print_note("the camera was found from the images: " + text);
  else
    warnings_.push_back(source_ + ": the images contradict this calibration (" + camera_text(record_.given) +
                        "); they were tracked with the camera that was found: " + text +
                        " (--calibration fixed keeps the given one)");
}

bool SelfCalibration::refuted(std::size_t with_given, std::size_t with_found) {
  if (!record_.replaced || 10 * with_found >= 9 * with_given) return false;
  record_.replaced = false;
  record_.last = {};
  record_.last.camera = record_.given;
  warnings_ = {source_ +
               ": the images seem to contradict this calibration, but with the camera that was found " +
               std::to_string(with_found) + " frames have a pose, with the given one " +
               std::to_string(with_given) + ": the given one is kept"};
  return true;
}

void SelfCalibration::keep(const CameraChoice& camera, CheckpointHead& head) const {
  head.used = camera.camera;
  head.camera_source = camera.source;
  head.camera_replaced = record_.replaced;
  head.camera_warnings = warnings_;
}

void SelfCalibration::go_on(const CheckpointHead& head, CameraChoice& camera) {
  camera.camera = head.used;
  camera.source = head.camera_source;
  record_.replaced = head.camera_replaced;
  warnings_ = head.camera_warnings;
}

std::string SelfCalibration::advice(const std::string& where) const {
  return source_ + ": the images contradict this calibration (" + camera_text(record_.given) +
         "); they fit " + camera_text(record_.last.camera) + "; track them again with --camera " + where;
}

}  // namespace sslam::cli
