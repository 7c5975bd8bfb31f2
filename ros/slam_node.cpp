// SPDX-License-Identifier: BSD-3-Clause
#include "slam_node.hpp"

#include <algorithm>

#include "sslam/io/bags/camera_text.hpp"
#include "sslam/io/bags/upright.hpp"
#include "sslam/io/maps/map_file.hpp"
#include "sslam/opencv/camera/camera_file.hpp"
#include "sslam/system/parameters.hpp"
#include "sslam/system/system.hpp"

namespace sslam_ros {
namespace {

sslam::ImageRef image_ref(const Image& image) {
  using sslam::PixelFormat;
  constexpr std::pair<const char*, PixelFormat> kFormats[] = {
      {"mono8", PixelFormat::kGrey8}, {"8UC1", PixelFormat::kGrey8}, {"bgr8", PixelFormat::kBgr8},
      {"8UC3", PixelFormat::kBgr8},   {"rgb8", PixelFormat::kRgb8},  {"bgra8", PixelFormat::kBgra8},
      {"8UC4", PixelFormat::kBgra8},  {"rgba8", PixelFormat::kRgba8}};
  constexpr std::uint32_t kLongest = 100'000;
  for (const auto& [name, format] : kFormats) {
    if (image.encoding != name) continue;
    const std::uint64_t row = std::uint64_t{image.width} * static_cast<unsigned>(channels(format));
    if (image.width > kLongest || image.height > kLongest || image.step < row ||
        image.data.size() < std::uint64_t{image.step} * image.height)
      throw sslam::Error("image: has fewer bytes than its size and step need");
    return {image.data.data(), static_cast<int>(image.width), static_cast<int>(image.height), image.step,
            format};
  }
  throw sslam::Error("image: the encoding " + sslam::io::shown_word(image.encoding) +
                     " is not taken; use mono8, bgr8, rgb8, bgra8 or rgba8 (image_proc makes them)");
}

Pose ros_pose(const sslam::SE3<double>& world_from_cam) {
  const sslam::SE3<double> pose = sslam::io::upright_from_map() * world_from_cam;
  const auto q = pose.rotation.quaternion();
  const auto& t = pose.translation;
  return {{t.x(), t.y(), t.z()}, {q.x(), q.y(), q.z(), q.w()}};
}

}  // namespace

struct SlamNode::Parts : sslam::Observer {
  NodeSettings wanted;
  sslam::Settings settings;
  std::optional<sslam::Map<double>> known;  // of `load`
  std::optional<sslam::System> system;
  bool map_is_new = false;

  void map_changed(const sslam::FrameEvent&) override { map_is_new = true; }
};

SlamNode::SlamNode(NodeSettings wanted) : parts_(std::make_unique<Parts>()) {
  sslam::Settings& settings = parts_->settings;
  settings.preset = wanted.preset;
  settings.live = wanted.live;
  settings.final_pass = false;  // it would keep 100 kB a frame, for hours
  for (const auto& [name, value] : wanted.set) settings.parameters.push_back({name, value});
  if (!wanted.model.empty()) settings.normals = {sslam::OnnxNormals(wanted.model), true};
  if (wanted.localise_only && wanted.load.empty())
    throw sslam::Error("localise_only: there is no map to look for places in; give load");
  sslam::ParameterTable table = sslam::all_parameters(sslam::find_preset(wanted.preset));
  if (const auto answer = sslam::set_parameters(settings.parameters, table); !answer.ok())
    throw sslam::Error("set: " + answer.message);
  if (!wanted.load.empty()) parts_->known = sslam::io::load_map(wanted.load);
  parts_->wanted = std::move(wanted);
}

SlamNode::~SlamNode() = default;

bool SlamNode::has_camera() const {
  return parts_->system.has_value();
}

void SlamNode::take_camera(const CameraInfo& info) {
  if (info.k[0] == 0) throw sslam::Error("camera_info: this camera was not calibrated");
  sslam::io::CameraInfoMessage message;
  message.width = info.width;
  message.height = info.height;
  message.model = sslam::io::shown_word(info.model);
  message.d = info.d;
  message.k = info.k;
  const std::string text = sslam::io::camera_text_of(message, false);
  parts_->settings.camera = sslam::parse_camera_text(text, "camera_info").camera;
  sslam::System& system = parts_->system.emplace(parts_->settings);
  system.add_observer(*parts_);
  if (parts_->known) system.resume(*std::exchange(parts_->known, std::nullopt));
  system.localise_only(parts_->wanted.localise_only);
}

Tracked SlamNode::track(const Image& image, double seconds) {
  const sslam::FrameReport report = parts_->system->track(image_ref(image), seconds);
  Tracked tracked;
  if (report.input != sslam::InputStatus::kOk) {
    tracked.state = std::string("left out: ") + name(report.input);
    return tracked;
  }
  tracked.state = name(report.state);
  if (report.reason != sslam::Reason::kFine) tracked.state += std::string(": ") + name(report.reason);
  if (report.has_pose() && report.state != sslam::State::kUncertain)
    tracked.pose = ros_pose(report.cam_from_world.inverse());
  tracked.map_changed = std::exchange(parts_->map_is_new, false);
  return tracked;
}

std::vector<StampedPose> SlamNode::path() const {
  std::vector<StampedPose> path;
  for (const sslam::io::StampedPose& pose : parts_->system->trajectory())
    path.push_back({pose.stamp, ros_pose(pose.world_from_cam)});
  return path;
}

std::vector<std::array<float, 3>> SlamNode::points() const {
  const sslam::SE3<double> upright = sslam::io::upright_from_map();
  std::vector<std::array<float, 3>> points;
  for (const auto& point : parts_->system->map().points) {
    if (!point.alive) continue;
    const sslam::Vec3<float> place = (upright * point.position).cast<float>();
    points.push_back({place.x(), place.y(), place.z()});
  }
  return points;
}

void SlamNode::finish() {
  if (!has_camera()) return;
  parts_->system->finish();
  if (!parts_->wanted.save.empty()) parts_->system->save(parts_->wanted.save);
}

}  // namespace sslam_ros
