// SPDX-License-Identifier: BSD-3-Clause
// The node for ROS 2 on stand-ins for ROS 2: it gets images of a rendered room, and tells the poses of a
// System that gets the same. ros2_test CAMERA.yaml IMAGE...
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <rclcpp/rclcpp.hpp>
#include <string>
#include <vector>

#include "sslam/opencv/camera/camera_file.hpp"
#include "sslam/system/system.hpp"

namespace {

std::vector<std::string> words;

void demand(bool holds, const char* what) {
  if (holds) return;
  std::fprintf(stderr, "does not hold: %s\n", what);
  std::exit(1);
}

// A map's place in ROS's world, which has z up.
bool same_place(const geometry_msgs::msg::Point& told, const sslam::Vec3<double>& wanted) {
  return std::abs(told.x - wanted.x()) < 1e-9 && std::abs(told.y - wanted.z()) < 1e-9 &&
         std::abs(told.z + wanted.y()) < 1e-9;
}

// Of the camera's own axis in that world: it looks along z, and down is y.
bool same_view(const geometry_msgs::msg::Quaternion& q, const sslam::SE3<double>& world_from_cam) {
  const sslam::Vec3<double> ahead(2 * (q.x * q.z + q.y * q.w), 2 * (q.y * q.z - q.x * q.w),
                                  1 - 2 * (q.x * q.x + q.y * q.y));
  const sslam::Vec3<double> wanted = world_from_cam.rotation.matrix().col(2);
  return (ahead - sslam::Vec3<double>(wanted.x(), wanted.z(), -wanted.y())).norm() < 1e-9;
}

template <class Message>
void publish(const std::string& topic, const Message& message) {
  rclcpp::listeners<Message>().at(topic)(std::make_shared<const Message>(message));
}

template <class Message>
std::vector<Message>& heard(const std::string& topic) {
  static std::vector<Message> all;
  rclcpp::listeners<Message>()[topic] = [](const std::shared_ptr<const Message>& message) {
    all.push_back(*message);
  };
  return all;
}

}  // namespace

void rclcpp::init(int argc, char** argv) {
  words.assign(argv + 1, argv + argc);
  if (words.size() < 2) std::exit(2);
  overrides().emplace("live", ParameterValue(false));
  overrides().emplace("set.lines.max_lines", ParameterValue(std::int64_t{150}));
}

void rclcpp::play() {
  const sslam::Camera<double> camera = sslam::read_camera_file(words[0]).camera;
  sslam::Settings settings;
  settings.camera = camera;
  settings.final_pass = false;
  settings.parameters = {{"lines.max_lines", 150}};
  sslam::System system(settings);

  const auto& poses = heard<geometry_msgs::msg::PoseStamped>("~/pose");
  const auto& states = heard<std_msgs::msg::String>("~/state");
  const auto& paths = heard<nav_msgs::msg::Path>("~/path");
  const auto& clouds = heard<sensor_msgs::msg::PointCloud2>("~/points");
  const auto& tf = heard<tf2_msgs::msg::TFMessage>("/tf");
  sensor_msgs::msg::CameraInfo info;
  info.width = static_cast<std::uint32_t>(camera.width);
  info.height = static_cast<std::uint32_t>(camera.height);
  info.distortion_model = "plumb_bob";
  const auto& lens = camera.distortion;
  info.d = {lens.k1, lens.k2, lens.p1, lens.p2, lens.k3};
  const auto& p = camera.pinhole;
  info.k = {p.fx, 0, p.cx, 0, p.fy, p.cy, 0, 0, 1};

  std::size_t tracked = 0;
  for (std::size_t i = 1; i < words.size(); ++i) {
    cv::Mat picture = cv::imread(words[i]);
    sensor_msgs::msg::Image image;
    image.header.frame_id = "optical";
    image.header.stamp.sec = 100;
    image.header.stamp.nanosec = static_cast<std::uint32_t>(i) * 10'000'000;
    const auto report = system.track(picture, Time(image.header.stamp).seconds());
    cv::cvtColor(picture, picture, cv::COLOR_BGR2RGB);
    image.encoding = "rgb8";
    image.width = info.width;
    image.height = info.height;
    image.step = 3 * info.width;
    image.data.assign(picture.data, picture.data + picture.total() * 3);
    if (i == 1) publish("image", image);  // before there is a camera: left out
    publish("camera_info", info);
    publish("image", image);
    demand(states.size() == i, "each image has an answer");
    if (!report.has_pose() || report.state == sslam::State::kUncertain) continue;
    const sslam::SE3<double> pose = report.cam_from_world.inverse();
    demand(poses.size() == ++tracked && tf.size() == tracked, "a pose for each that the system has");
    demand(same_place(poses.back().pose.position, pose.translation), "the place");
    demand(same_view(poses.back().pose.orientation, pose), "the turn");
    const auto& transform = tf.back().transforms.at(0);
    demand(transform.header.frame_id == "map" && transform.child_frame_id == "optical", "the frames of tf");
    demand(same_place(transform.transform.translation, pose.translation), "the place in tf");
    demand(transform.header.stamp.nanosec == image.header.stamp.nanosec, "the stamp");
  }
  demand(2 * tracked > words.size(), "most images have poses");
  demand(paths.size() > 1 && paths.back().poses.size() > paths.front().poses.size(), "the path grows");
  demand(clouds.back().width > 50 && clouds.back().data.size() == clouds.back().width * 12, "points");
  sensor_msgs::msg::Image strange;
  strange.encoding = "yuv422";
  publish("image", strange);  // said on standard error, and nothing else
  demand(states.size() + 1 == words.size(), "no answer to an image that cannot be read");
}
