// SPDX-License-Identifier: BSD-3-Clause
#include "cli/foxglove/live_stream.hpp"

#include <memory>
#include <opencv2/imgcodecs.hpp>
#include <string_view>
#include <utility>

#include "cli/results/frame_table.hpp"
#include "cli/results/ros_messages.hpp"
#include "cli/shell/messages.hpp"
#include "cli/view/map_copy.hpp"
#include "sslam/io/bags/cdr_writer.hpp"

namespace sslam::cli {
namespace {

// By their places in the list.
enum Channel : std::size_t {
  kTf,
  kPath,
  kPoints,
  kLines,
  kPlanes,
  kCamera,
  kImage,
  kLog,
  kDiagnostics,
  kNormals
};

std::vector<StreamChannel> channels() {
  return {{ros_topics::kTf, false},    {ros_topics::kPath, true},   {ros_topics::kPoints, true},
          {ros_topics::kLines, true},  {ros_topics::kPlanes, true}, {ros_topics::kCamera, true},
          {ros_topics::kImage, true},  {ros_topics::kLog, false},   {ros_topics::kDiagnostics, false},
          {ros_topics::kNormals, true}};
}

// At most so often a map is copied, which costs the tracker a few milliseconds.
constexpr auto kBetweenMaps = std::chrono::milliseconds(300);

StreamMessage message_of(std::size_t channel, std::int64_t time, std::string bytes) {
  return {channel, time, std::make_shared<const std::string>(std::move(bytes))};
}

// Throws Error for a dataset whose messages would have no time.
double checked_seconds_per_stamp(const io::Dataset& dataset) {
  try {
    for (const io::FrameEntry& frame : dataset.frames)
      (void)io::message_time(frame.stamp * dataset.seconds_per_stamp);
  } catch (const Error& error) {
    throw Error(std::string("--foxglove: ") + error.what());
  }
  return dataset.seconds_per_stamp;
}

}  // namespace

LiveStream::LiveStream(const Endpoint& endpoint, const io::Dataset& dataset)
    : seconds_per_stamp_(checked_seconds_per_stamp(dataset)),
      server_(endpoint, channels(), [this] { return take(); }) {
  if (!dataset.frames.empty()) now_ = io::message_time(dataset.frames.front().stamp * seconds_per_stamp_);
  print_note("open this address in Foxglove: " + server_.address());
}

void LiveStream::begin(const Camera<double>& camera, const FeatureColours& colours) {
  colours_ = &colours;
  hand_over(kCamera, now_, camera_message(now_, camera));
}

void LiveStream::frame_tracked(const FrameEvent& event) {
  now_ = io::message_time(event.report.stamp * seconds_per_stamp_);
  if (event.report.has_pose() && server_.wanted(kTf))
    hand_over(kTf, now_, transform_message(now_, event.report.cam_from_world.inverse()));
  if (server_.wanted(kImage) && !event.input.picture.empty()) {
    const std::lock_guard lock(handing_);
    if (handover_.picture.image.empty()) handover_.picture = {event.input.picture.clone(), now_};
  }
  if (server_.wanted(kNormals) && !event.input.normal_picture.empty()) {
    const std::lock_guard lock(handing_);
    if (handover_.normals.image.empty()) handover_.normals = {event.input.normal_picture.clone(), now_};
  }
  if (server_.wanted(kDiagnostics)) hand_over(kDiagnostics, now_, diagnostics_of(event));
  if (map_is_new_) hand_map_over(event);
  server_.wake();
}

// As `sslam export` makes it of frames.csv.
std::string LiveStream::diagnostics_of(const FrameEvent& event) const {
  const std::vector<std::string> texts = frame_cells({event.report, event.input.label});
  return diagnostics_message(now_, frame_columns(),
                             std::vector<std::string_view>(texts.begin(), texts.end()));
}

void LiveStream::map_changed(const FrameEvent& event) {
  map_is_new_ = true;
  hand_map_over(event);
}

void LiveStream::warning(const std::string& line) {
  hand_over(kLog, now_, log_message(now_, line));
}

bool LiveStream::map_wanted() const {
  for (const std::size_t channel : {kPath, kPoints, kLines, kPlanes})
    if (server_.wanted(channel)) return true;
  return false;
}

// Where a client wants it; else, or where the last one was given a moment ago, a later frame does.
void LiveStream::hand_map_over(const FrameEvent& event) {
  const auto moment = std::chrono::steady_clock::now();
  if (!map_wanted() || moment - map_given_ < kBetweenMaps) return;
  MapState state{now_, {}, {}, trajectory_of(event)};
  state.map = landmarks_of(event.map, colours_->of(event.map), state.colours);
  map_given_ = moment;
  map_is_new_ = false;
  {
    const std::lock_guard lock(handing_);
    handover_.map = std::move(state);
  }
  server_.wake();
}

void LiveStream::hand_over(std::size_t channel, std::int64_t time, std::string message) {
  {
    const std::lock_guard lock(handing_);
    handover_.ready.push_back(message_of(channel, time, std::move(message)));
  }
  server_.wake();
}

void LiveStream::finish(const RunOutcome& outcome) {
  if (outcome.trajectory.empty()) return;
  {
    const std::lock_guard lock(handing_);
    handover_.map = MapState{now_, {}, {}, outcome.trajectory};
    handover_.map->map = landmarks_of(outcome.map, outcome.colours, handover_.map->colours);
  }
  server_.wake();
}

std::vector<StreamMessage> LiveStream::take() {
  Handover taken;
  {
    const std::lock_guard lock(handing_);
    taken = std::exchange(handover_, {});
  }
  std::vector<StreamMessage> messages = std::move(taken.ready);
  const auto add = [&](std::size_t channel, std::int64_t time, std::string bytes) {
    messages.push_back(message_of(channel, time, std::move(bytes)));
  };
  const auto add_picture = [&](std::size_t channel, const Picture& picture) {
    std::vector<unsigned char> jpeg;
    if (!picture.image.empty() && cv::imencode(".jpg", picture.image, jpeg))
      add(channel, picture.time,
          image_message(picture.time, {reinterpret_cast<const char*>(jpeg.data()), jpeg.size()}));
  };
  add_picture(kImage, taken.picture);
  add_picture(kNormals, taken.normals);
  if (taken.map) {
    const MapState& state = *taken.map;
    add(kPath, state.time, path_message(state.time, state.trajectory, seconds_per_stamp_));
    add(kPoints, state.time, points_message(state.time, state.map, state.colours));
    add(kLines, state.time, lines_message(state.time, state.map, state.colours));
    add(kPlanes, state.time, planes_message(state.time, state.map));
  }
  return messages;
}

}  // namespace sslam::cli
