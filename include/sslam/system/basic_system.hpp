// SPDX-License-Identifier: BSD-3-Clause
// The members of BasicSystem, for programs with their own front end; src/system.cpp compiles those of System.
#pragma once

#include <cmath>
#include <string>
#include <utility>

#include "sslam/io/maps/map_file.hpp"
#include "sslam/opencv/camera/working_size.hpp"
#include "sslam/system/parameters.hpp"
#include "sslam/system/settings_check.hpp"
#include "sslam/system/system.hpp"

namespace sslam {

template <class Frontend>
BasicSystem<Frontend>::BasicSystem(Settings settings) : settings_(std::move(settings)) {
  check_settings(settings_);
  try {
    preset_ = find_preset(settings_.preset);
  } catch (const Error& error) {
    throw SettingsError("preset", error.what());
  }
  if (settings_.live && preset_.make_live == nullptr)
    throw SettingsError("live", "the preset " + preset_.name + " has no mapping in a thread of its own");
  engine_ = settings_.live ? preset_.make_live() : preset_.make();
  engine_->seed(settings_.seed);
  engine_->keep_frames(settings_.final_pass);
  engine_->create_points(preset_.new_points);
  reads_depth_ = settings_.normals.from_depth();
  frontend_ = std::make_unique<Frontend>();
  camera_ = shrunk_camera(settings_.camera, settings_.longest_side);
  frontend_->camera = camera_;
  frontend_->normals = std::move(settings_.normals);
  normals_on_demand_ = frontend_->normals.any() && frontend_->normals.on_demand;
  frontend_->normals_later = normals_on_demand_;
  set_parameters();
}

template <class Frontend>
void BasicSystem<Frontend>::set_parameters() {
  parameters_ = all_parameters(*engine_, *frontend_);
  const ParameterAnswer answer = sslam::set_parameters(settings_.parameters, parameters_);
  if (!answer.ok()) throw SettingsError("parameters", answer.message);
  engine_->write(parameters_);
  write_frontend_parameters(parameters_, *frontend_);
}

template <class Frontend>
BasicSystem<Frontend>::~BasicSystem() = default;

template <class Frontend>
void BasicSystem<Frontend>::extract(const ImageInput& given, Extraction& out) {
  const cv::Size full(settings_.camera.width, settings_.camera.height);
  const bool shrinks = full != cv::Size(camera_.width, camera_.height);
  if (shrinks && !given.image.empty() && given.image.size() != full) {
    out.report = {};
    out.report.image = ImageStatus::kWrongSize;
    return;
  }
  const ImageInput input = shrinks && !given.image.empty() ? shrunk_input(given, camera_) : given;
  out.report = frontend_->process(input, out.frame);
  out.picture = out.normal_picture = out.picture_mask = cv::Mat();
  if (!out.usable()) return;
  if (settings_.keep_pictures) {
    out.picture = input.image;
    out.picture_mask = input.mask;
  }
  if (normals_on_demand_) {
    keep_copy(input, out.asked_of);
  } else {
    keep_normal_picture(out);
  }
  if (!preset_.use_points) out.frame.points.clear();
  if (!preset_.use_lines) out.frame.lines.clear();
}

template <class Frontend>
void BasicSystem<Frontend>::keep_normal_picture(Extraction& out) const {
  const bool seen =
      out.report.normals == NormalStatus::kOk || out.report.normals == NormalStatus::kNoEvidence;
  if (!settings_.keep_pictures || !seen) return;
  out.normal_picture = frontend_->normals.small_picture();
  out.normal_pinhole = frontend_->normals.small_pinhole(camera_, out.normal_picture.size());
}

// Keeps normals that the frame already has, for example from the caller.
template <class Frontend>
void BasicSystem<Frontend>::ask_for_normals(Extraction& extraction, FrameReport& report) {
  Frame<double>& frame = extraction.frame;
  const bool given = frame.normals.size() > 0;
  if (given || !normals_on_demand_) {
    if (given || frontend_->normals.any()) report.normal_need = NormalNeed::kEveryFrame;
    return;
  }
  if (!preset_.use_normals) return;
  report.normal_need = engine_->normal_need(frame);
  if (report.normal_need == NormalNeed::kNotNeeded) return;
  frontend_->ask(extraction.asked_of, frame.normals, extraction.report);
  keep_normal_picture(extraction);
}

template <class Frontend>
FrameReport BasicSystem<Frontend>::track(const ImageInput& input) {
  extract(input, extraction_);
  return track(extraction_);
}

template <class Frontend>
FrameReport BasicSystem<Frontend>::track(const cv::Mat& image, const cv::Mat& depth, double stamp) {
  ImageInput input;
  input.index = frames_;
  input.stamp = stamp;
  input.image = image;
  input.depth = depth;
  input.depth_factor = settings_.depth_factor;
  return track(input);
}

template <class Frontend>
FrameReport BasicSystem<Frontend>::track(const cv::Mat& image, double stamp) {
  return track(image, cv::Mat(), stamp);
}

template <class Frontend>
FrameReport BasicSystem<Frontend>::track(const ImageRef& image, double stamp) {
  return track(to_mat(image), cv::Mat(), stamp);
}

template <class Frontend>
FrameReport BasicSystem<Frontend>::track(Extraction& extraction) {
  FrameReport report;
  report.input = input_status(extraction.report.image);
  const double stamp = extraction.frame.stamp;
  if (finished_) {
    report.input = InputStatus::kFinished;
  } else if (extraction.usable() && (!std::isfinite(stamp) || (last_stamp_ && !(stamp > *last_stamp_)))) {
    report.input = InputStatus::kBadStamp;
  }
  if (report.input != InputStatus::kOk) return report;
  last_stamp_ = stamp;
  ++frames_;
  ask_for_normals(extraction, report);
  report.points = static_cast<int>(extraction.frame.points.size());
  report.lines = static_cast<int>(extraction.frame.lines.size());
  report.normals = static_cast<int>(extraction.frame.normals.size());
  report.normal_status = extraction.report.normals;
  const auto milliseconds = [](double seconds) { return static_cast<float>(seconds * 1e3); };
  report.points_ms = milliseconds(extraction.report.points_time);
  report.lines_ms = milliseconds(extraction.report.lines_time);
  report.normals_ms = milliseconds(extraction.report.normals_time);
  report.extraction_ms = milliseconds(extraction.report.total_time);
  static_cast<TrackResult<double>&>(report) = engine_->track(extraction.frame);
  report.tracking_ms = engine_->tracking_ms();
  report.stage_ms = engine_->stage_ms();
  note_latest(report);
  warn_of_image_fixed(report);
  tell(report, extraction);
  return report;
}

template <class Frontend>
void BasicSystem<Frontend>::warn_of_image_fixed(const FrameReport& report) {
  constexpr int kMany = 10;  // features
  if (report.image_fixed < kMany || std::exchange(told_of_image_fixed_, true)) return;
  warn("frame " + std::to_string(report.index) + ": " + std::to_string(report.image_fixed) +
       " features do not move in the image while the rest does (burnt-in text, a part of the robot?) and are "
       "left out from here on; a mask leaves them out from the first frame");
}

template <class Frontend>
void BasicSystem<Frontend>::note_latest(const FrameReport& report) {
  const std::lock_guard lock(latest_mutex_);
  latest_ = {report.stamp, report.state, std::nullopt, report.world};
  if (report.has_pose()) latest_.world_from_cam = report.cam_from_world.inverse();
}

template <class Frontend>
LatestPose BasicSystem<Frontend>::latest() const {
  const std::lock_guard lock(latest_mutex_);
  return latest_;
}

template <class Frontend>
void BasicSystem<Frontend>::tell(const FrameReport& report, const Extraction& extraction) {
  const bool another_map = std::exchange(last_world_, report.world) != report.world;
  if (observers_.empty()) return;
  const FrameEvent event{report, extraction, engine_->last_frame(), engine_->map(), engine_->trajectory()};
  const auto each = [&](void (Observer::*called)(const FrameEvent&)) {
    for (Observer* observer : observers_) (observer->*called)(event);
  };
  each(&Observer::frame_tracked);
  if (report.keyframe) each(&Observer::keyframe_made);
  if (report.loop_closed) each(&Observer::loop_closed);
  if (report.maps_joined) each(&Observer::maps_joined);
  if (report.keyframe || report.loop_closed || report.maps_joined || another_map)
    each(&Observer::map_changed);
}

template <class Frontend>
bool BasicSystem<Frontend>::finish() {
  return !std::exchange(finished_, true) && engine_->finish();
}

template <class Frontend>
io::Trajectory BasicSystem<Frontend>::trajectory() const {
  io::Trajectory poses;
  const TrajectoryLog<double>& log = engine_->trajectory();
  poses.reserve(log.entries().size());
  for (const auto& entry : log.entries())
    poses.push_back({entry.stamp, TrajectoryLog<double>::pose(engine_->map(), entry).inverse()});
  io::sort_by_stamp(poses);
  return poses;
}

template <class Frontend>
void BasicSystem<Frontend>::save(const std::filesystem::path& path) const {
  io::save_map(path, engine_->map());
}

template <class Frontend>
void BasicSystem<Frontend>::load(const std::filesystem::path& path) {
  resume(io::load_map(path));
}

template <class Frontend>
void BasicSystem<Frontend>::resume(Map<double> map) {
  engine_->resume(std::move(map));
}

template <class Frontend>
void BasicSystem<Frontend>::add_observer(Observer& observer) {
  observers_.push_back(&observer);
}

template <class Frontend>
void BasicSystem<Frontend>::remove_observer(Observer& observer) {
  std::erase(observers_, &observer);
}

template <class Frontend>
void BasicSystem<Frontend>::warn(const std::string& line) {
  for (Observer* observer : observers_) observer->warning(line);
}

}  // namespace sslam
