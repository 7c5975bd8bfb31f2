// SPDX-License-Identifier: BSD-3-Clause
// sslam as a node of ROS 2: images and their camera in; pose, path, points and tf out. See ros/README.md: it
// has never been run with ROS 2.
#include <algorithm>
#include <cstdio>
#include <exception>
#include <geometry_msgs/msg/pose_stamped.hpp>
#include <memory>
#include <nav_msgs/msg/path.hpp>
#include <rclcpp/rclcpp.hpp>
#include <sensor_msgs/msg/camera_info.hpp>
#include <sensor_msgs/msg/image.hpp>
#include <sensor_msgs/msg/point_cloud2.hpp>
#include <std_msgs/msg/string.hpp>
#include <string>
#include <tf2_msgs/msg/tf_message.hpp>

#include "slam_node.hpp"

namespace {

constexpr int kSayAgainAfter = 5000;  // ms

class Node : public rclcpp::Node {
 public:
  Node() : rclcpp::Node("sslam"), slam_(read_settings()) {
    world_frame_ = declare_parameter<std::string>("world_frame", "map");
    const auto queue =
        static_cast<std::size_t>(std::max<std::int64_t>(1, declare_parameter<std::int64_t>("queue", 1)));
    pose_ = create_publisher<geometry_msgs::msg::PoseStamped>("~/pose", 10);
    state_ = create_publisher<std_msgs::msg::String>("~/state", 10);
    path_ = create_publisher<nav_msgs::msg::Path>("~/path", rclcpp::QoS(1).transient_local());
    points_ = create_publisher<sensor_msgs::msg::PointCloud2>("~/points", rclcpp::QoS(1).transient_local());
    if (declare_parameter<bool>("publish_tf", true))
      tf_ = create_publisher<tf2_msgs::msg::TFMessage>("/tf", 10);
    camera_ = create_subscription<sensor_msgs::msg::CameraInfo>(
        "camera_info", rclcpp::SensorDataQoS(),
        [this](sensor_msgs::msg::CameraInfo::ConstSharedPtr info) { take_camera(*info); });
    images_ = create_subscription<sensor_msgs::msg::Image>(
        "image", rclcpp::SensorDataQoS().keep_last(queue),
        [this](sensor_msgs::msg::Image::ConstSharedPtr image) { take_image(*image); });
  }

  void finish() { slam_.finish(); }

 private:
  // set.lines.merge.max_gap sets lines.merge.max_gap.
  sslam_ros::NodeSettings read_settings() {
    sslam_ros::NodeSettings settings;
    settings.preset = declare_parameter<std::string>("preset", settings.preset);
    settings.model = declare_parameter<std::string>("model", "");
    settings.load = declare_parameter<std::string>("load", "");
    settings.save = declare_parameter<std::string>("save", "");
    settings.live = declare_parameter<bool>("live", settings.live);
    settings.localise_only = declare_parameter<bool>("localise_only", false);
    const std::string prefix = "set.";
    for (const auto& [key, value] : get_node_parameters_interface()->get_parameter_overrides()) {
      if (key.compare(0, prefix.size(), prefix) != 0) continue;
      const bool whole = value.get_type() == rclcpp::ParameterType::PARAMETER_INTEGER;
      settings.set.emplace_back(key.substr(prefix.size()),
                                whole ? static_cast<double>(value.get<std::int64_t>()) : value.get<double>());
    }
    return settings;
  }

  // The first one is that of the run.
  void take_camera(const sensor_msgs::msg::CameraInfo& info) {
    if (slam_.has_camera()) return;
    try {
      slam_.take_camera({info.width, info.height, info.distortion_model, info.d, info.k});
    } catch (const std::exception& error) {
      RCLCPP_ERROR_THROTTLE(get_logger(), *get_clock(), kSayAgainAfter, "%s", error.what());
    }
  }

  void take_image(const sensor_msgs::msg::Image& image) {
    if (!slam_.has_camera()) {
      RCLCPP_WARN_THROTTLE(get_logger(), *get_clock(), kSayAgainAfter,
                           "images come, but no camera_info that can be used");
      return;
    }
    try {
      const sslam_ros::Tracked tracked =
          slam_.track({image.data, image.width, image.height, image.step, image.encoding},
                      rclcpp::Time(image.header.stamp).seconds());
      if (tracked.pose) publish_pose(*tracked.pose, image.header);
      map_is_new_ = map_is_new_ || tracked.map_changed;
      if (map_is_new_) publish_map(image.header.stamp);
      std_msgs::msg::String state;  // last: who hears it has the rest
      state.data = tracked.state;
      state_->publish(state);
    } catch (const std::exception& error) {
      RCLCPP_ERROR_THROTTLE(get_logger(), *get_clock(), kSayAgainAfter, "%s", error.what());
    }
  }

  void publish_pose(const sslam_ros::Pose& tracked, const std_msgs::msg::Header& header) {
    geometry_msgs::msg::PoseStamped pose;
    pose.header.stamp = header.stamp;
    pose.header.frame_id = world_frame_;
    sslam_ros::fill_pose(tracked, pose.pose.position, pose.pose.orientation);
    pose_->publish(pose);
    if (!tf_) return;
    tf2_msgs::msg::TFMessage tf;
    tf.transforms.resize(1);
    tf.transforms[0].header = pose.header;
    tf.transforms[0].child_frame_id = header.frame_id;
    sslam_ros::fill_pose(tracked, tf.transforms[0].transform.translation,
                         tf.transforms[0].transform.rotation);
    tf_->publish(tf);
  }

  // Where anybody listens; else a later image does it.
  void publish_map(const builtin_interfaces::msg::Time& stamp) {
    if (path_->get_subscription_count() == 0 && points_->get_subscription_count() == 0) return;
    nav_msgs::msg::Path path;
    path.header.stamp = stamp;
    path.header.frame_id = world_frame_;
    for (const sslam_ros::StampedPose& entry : slam_.path()) {
      geometry_msgs::msg::PoseStamped pose;
      pose.header.stamp = rclcpp::Time(sslam_ros::nanoseconds(entry.seconds));
      pose.header.frame_id = world_frame_;
      sslam_ros::fill_pose(entry.pose, pose.pose.position, pose.pose.orientation);
      path.poses.push_back(pose);
    }
    path_->publish(path);
    sensor_msgs::msg::PointCloud2 cloud;
    cloud.header = path.header;
    sslam_ros::fill_cloud(slam_.points(), cloud);
    points_->publish(cloud);
    map_is_new_ = false;
  }

  sslam_ros::SlamNode slam_;
  std::string world_frame_;
  bool map_is_new_ = false;
  rclcpp::Publisher<geometry_msgs::msg::PoseStamped>::SharedPtr pose_;
  rclcpp::Publisher<std_msgs::msg::String>::SharedPtr state_;
  rclcpp::Publisher<nav_msgs::msg::Path>::SharedPtr path_;
  rclcpp::Publisher<sensor_msgs::msg::PointCloud2>::SharedPtr points_;
  rclcpp::Publisher<tf2_msgs::msg::TFMessage>::SharedPtr tf_;
  rclcpp::Subscription<sensor_msgs::msg::CameraInfo>::SharedPtr camera_;
  rclcpp::Subscription<sensor_msgs::msg::Image>::SharedPtr images_;
};

}  // namespace

int main(int argc, char** argv) {
  rclcpp::init(argc, argv);
  int code = 0;
  try {
    const auto node = std::make_shared<Node>();
    rclcpp::spin(node);
    node->finish();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "sslam: %s\n", error.what());
    code = 1;
  }
  rclcpp::shutdown();
  return code;
}
