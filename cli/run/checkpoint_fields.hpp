// SPDX-License-Identifier: BSD-3-Clause
// What of a run stands in a checkpoint besides colours and maps: one list of fields that a writer and a
// reader both walk.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "cli/results/frame_record.hpp"
#include "cli/run/checkpoint.hpp"
#include "sslam/io/maps/map_fields.hpp"

namespace sslam::cli {

template <class Archive>
class CheckpointFields {
 public:
  explicit CheckpointFields(Archive& archive) : archive_(archive), map_fields_(archive) {}

  void walk(CheckpointHead& head) {
    archive_(head.version);
    list(head.words, [this](std::string& word) { archive_(word); });
    archive_(head.frames);
    archive_(head.frame_list);
    camera(head.given);
    camera(head.used);
    archive_(head.camera_source);
    truth(head.camera_replaced);
    list(head.camera_warnings, [this](std::string& line) { archive_(line); });
    archive_(head.next, {"the position of the next frame", 0, head.frames});
    archive_(head.known_keyframes);
    archive_(head.last_world, {"the number of a world", 0, kMany});
  }

  // What has been recorded so far; the rest of an outcome follows the last frame.
  void walk(RunOutcome& outcome) {
    list(outcome.frames, [this](FrameRecord& frame) { record(frame); });
    list(outcome.warnings, [this](std::string& line) { archive_(line); });
    list(outcome.views, [this](std::string& view) { archive_(view); });
    seconds(outcome.wall_seconds);
    seconds(outcome.processor_seconds);
    archive_(outcome.checkpoints);
    seconds(outcome.checkpoint_seconds);
    list(outcome.resumed_at, [this](std::int64_t& index) { archive_(index); });
  }

  void walk(TrajectoryEntry<double>& entry, std::size_t keyframes) {
    archive_(entry.index);
    archive_(entry.stamp, kStamp);
    archive_(entry.reference, {"a frame's keyframe", 0, static_cast<KeyframeId>(keyframes) - 1});
    map_fields_.walk(entry.frame_from_reference);
  }

 private:
  static constexpr int kMany = 1'000'000'000;
  static constexpr io::FieldRange<double> kStamp{"a stamp", -1e15, 1e15};

  // Each entry takes a byte or more.
  template <class T, class Entry>
  void list(std::vector<T>& values, Entry entry) {
    std::uint64_t size = values.size();
    if constexpr (Archive::kReads) {
      archive_(size, {"the length of a list", 0, archive_.left().size()});
      values.clear();
      for (std::uint64_t i = 0; i < size; ++i) entry(values.emplace_back());
    } else {
      archive_(size);
      for (T& value : values) entry(value);
    }
  }

  template <class E>
  void word(E& value, E last, const char* name) {
    auto number = static_cast<std::uint8_t>(value);
    archive_(number, {name, 0, static_cast<std::uint8_t>(last)});
    value = static_cast<E>(number);
  }

  void truth(bool& value) {
    std::uint8_t byte = value ? 1 : 0;
    archive_(byte, {"a truth value", 0, 1});
    value = byte != 0;
  }

  void count(int& value) { archive_(value, {"a count", 0, kMany}); }
  void seconds(double& value) { archive_(value, {"a duration", 0, 1e12}); }
  void milliseconds(float& value) { archive_(value, {"a duration", 0, 1e12F}); }

  void camera(Camera<double>& camera) {
    Pinhole<double>& k = camera.pinhole;
    RadTan<double>& lens = camera.distortion;
    for (double* value : {&k.fx, &k.fy, &k.cx, &k.cy, &lens.k1, &lens.k2, &lens.p1, &lens.p2, &lens.k3})
      archive_(*value, {"a camera's number", -1e12, 1e12});
    count(camera.width);
    count(camera.height);
  }

  void record(FrameRecord& frame) {
    archive_(frame.image);
    archive_(frame.index);
    archive_(frame.stamp, kStamp);
    word(frame.state, State::kLost, "a frame's state");
    word(frame.reason, Reason::kRelocalised, "a frame's reason");
    map_fields_.walk(frame.cam_from_world);
    for (double& value : frame.covariance.reshaped()) archive_(value, {"a covariance"});
    for (int* value : {&frame.world, &frame.point_inliers, &frame.line_inliers, &frame.axes_seen,
                       &frame.image_fixed, &frame.points, &frame.lines, &frame.normals})
      count(*value);
    for (bool* value : {&frame.structure, &frame.keyframe, &frame.loop_closed, &frame.maps_joined})
      truth(*value);
    word(frame.normal_need, NormalNeed::kUncertain, "why normals were asked for");
    word(frame.normal_status, NormalStatus::kNoEvidence, "what became of normals");
    for (float& value : frame.stage_ms) milliseconds(value);
    for (float* value :
         {&frame.points_ms, &frame.lines_ms, &frame.normals_ms, &frame.extraction_ms, &frame.tracking_ms})
      milliseconds(*value);
  }

  Archive& archive_;
  io::MapFields<Archive> map_fields_;
};

}  // namespace sslam::cli
