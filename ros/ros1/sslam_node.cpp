// SPDX-License-Identifier: BSD-3-Clause
// sslam as a node of ROS 1: images and their camera in; pose, path, points and tf out. See ros/README.md.
#include <nav_msgs/Path.h>
#include <ros/ros.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/PointCloud2.h>
#include <std_msgs/String.h>
#include <tf2_msgs/TFMessage.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <exception>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "slam_node.hpp"

namespace {

// ~set/lines/merge/max_gap sets lines.merge.max_gap: names of ROS 1 have no dots.
std::vector<std::pair<std::string, double>> values_of_set(const ros::NodeHandle& own) {
  std::vector<std::string> keys;
  own.getParamNames(keys);
  const std::string prefix = own.resolveName("set") + "/";
  std::vector<std::pair<std::string, double>> values;
  for (const std::string& key : keys) {
    if (key.compare(0, prefix.size(), prefix) != 0) continue;
    std::string name = key.substr(prefix.size());
    std::replace(name.begin(), name.end(), '/', '.');
    double value = 0;
    if (!own.getParam(key, value)) throw std::runtime_error("set: " + name + " is no number");
    values.emplace_back(name, value);
  }
  return values;
}

sslam_ros::NodeSettings settings_of(const ros::NodeHandle& own) {
  sslam_ros::NodeSettings settings;
  own.getParam("preset", settings.preset);
  own.getParam("model", settings.model);
  own.getParam("load", settings.load);
  own.getParam("save", settings.save);
  own.getParam("live", settings.live);
  own.getParam("localise_only", settings.localise_only);
  settings.set = values_of_set(own);
  return settings;
}

std::array<double, 9> copy_of(const boost::array<double, 9>& from) {
  std::array<double, 9> to;
  std::copy(from.begin(), from.end(), to.begin());
  return to;
}

class Node {
 public:
  Node() : slam_(settings_of(own_)) {
    own_.getParam("world_frame", world_frame_);
    own_.getParam("publish_tf", publish_tf_);
    const int queue = std::max(1, own_.param("queue", 1));
    pose_ = own_.advertise<geometry_msgs::PoseStamped>("pose", 10);
    state_ = own_.advertise<std_msgs::String>("state", 10, true);
    path_ = own_.advertise<nav_msgs::Path>("path", 1, true);
    points_ = own_.advertise<sensor_msgs::PointCloud2>("points", 1, true);
    if (publish_tf_) tf_ = ros_.advertise<tf2_msgs::TFMessage>("/tf", 10);
    camera_ = ros_.subscribe("camera_info", 1, &Node::take_camera, this);
    images_ = ros_.subscribe("image", static_cast<std::uint32_t>(queue), &Node::take_image, this);
  }

  void finish() { slam_.finish(); }

 private:
  // The first one is that of the run.
  void take_camera(const sensor_msgs::CameraInfo::ConstPtr& info) {
    try {
      slam_.take_camera({info->width, info->height, info->distortion_model, info->D, copy_of(info->K)});
      camera_.shutdown();
    } catch (const std::exception& error) {
      ROS_ERROR_THROTTLE(5, "%s", error.what());
    }
  }

  void take_image(const sensor_msgs::Image::ConstPtr& image) {
    if (!slam_.has_camera()) {
      ROS_WARN_THROTTLE(5, "images come, but no camera_info that can be used");
      return;
    }
    try {
      const sslam_ros::Tracked tracked =
          slam_.track({image->data, image->width, image->height, image->step, image->encoding},
                      image->header.stamp.toSec());
      if (tracked.pose) publish_pose(*tracked.pose, image->header);
      map_is_new_ = map_is_new_ || tracked.map_changed;
      if (map_is_new_) publish_map(image->header.stamp);
      std_msgs::String state;  // last: who hears it has the rest
      state.data = tracked.state;
      state_.publish(state);
    } catch (const std::exception& error) {
      ROS_ERROR_THROTTLE(5, "%s", error.what());
    }
  }

  void publish_pose(const sslam_ros::Pose& tracked, const std_msgs::Header& header) {
    geometry_msgs::PoseStamped pose;
    pose.header.stamp = header.stamp;
    pose.header.frame_id = world_frame_;
    sslam_ros::fill_pose(tracked, pose.pose.position, pose.pose.orientation);
    pose_.publish(pose);
    if (!publish_tf_) return;
    tf2_msgs::TFMessage tf;
    tf.transforms.resize(1);
    tf.transforms[0].header = pose.header;
    tf.transforms[0].child_frame_id = header.frame_id;
    sslam_ros::fill_pose(tracked, tf.transforms[0].transform.translation,
                         tf.transforms[0].transform.rotation);
    tf_.publish(tf);
  }

  // Where anybody listens; else a later image does it.
  void publish_map(const ros::Time& stamp) {
    if (path_.getNumSubscribers() == 0 && points_.getNumSubscribers() == 0) return;
    nav_msgs::Path path;
    path.header.stamp = stamp;
    path.header.frame_id = world_frame_;
    for (const sslam_ros::StampedPose& entry : slam_.path()) {
      geometry_msgs::PoseStamped pose;
      pose.header.stamp.fromNSec(static_cast<std::uint64_t>(sslam_ros::nanoseconds(entry.seconds)));
      pose.header.frame_id = world_frame_;
      sslam_ros::fill_pose(entry.pose, pose.pose.position, pose.pose.orientation);
      path.poses.push_back(pose);
    }
    path_.publish(path);
    sensor_msgs::PointCloud2 cloud;
    cloud.header = path.header;
    sslam_ros::fill_cloud(slam_.points(), cloud);
    points_.publish(cloud);
    map_is_new_ = false;
  }

  ros::NodeHandle ros_, own_{"~"};
  sslam_ros::SlamNode slam_;
  std::string world_frame_ = "map";
  bool publish_tf_ = true, map_is_new_ = false;
  ros::Publisher pose_, state_, path_, points_, tf_;
  ros::Subscriber camera_, images_;
};

}  // namespace

int main(int argc, char** argv) {
  ros::init(argc, argv, "sslam");
  try {
    Node node;
    ros::spin();
    node.finish();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "sslam: %s\n", error.what());  // ROS's own words have ended with the node
    return 1;
  }
  return 0;
}
