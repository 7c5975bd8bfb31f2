// SPDX-License-Identifier: BSD-3-Clause
// Publishes images one after the other, each when the node has answered to the one before, and prints what
// the node tells: `pose STAMP FRAME x y z qx qy qz qw`, `tf PARENT CHILD` with the same, `path COUNT`,
// `points COUNT`, `state TEXT`. ros1_player WIDTH HEIGHT FX FY CX CY LIST; a row of LIST: nanoseconds, image
#include <geometry_msgs/PoseStamped.h>
#include <nav_msgs/Path.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/PointCloud2.h>
#include <std_msgs/String.h>
#include <tf2_msgs/TFMessage.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <string>

namespace {

int answers = 0, expected_poses = 0, poses = 0, transforms = 0, cameras_taken = 0;

template <class Place, class Turn>
void print_pose(const Place& t, const Turn& q) {
  std::printf(" %.12g %.12g %.12g %.12g %.12g %.12g %.12g\n", t.x, t.y, t.z, q.x, q.y, q.z, q.w);
}

void print_pose_message(const geometry_msgs::PoseStamped::ConstPtr& message) {
  std::printf("pose %lu %s", static_cast<unsigned long>(message->header.stamp.toNSec()),
              message->header.frame_id.c_str());
  print_pose(message->pose.position, message->pose.orientation);
  ++poses;
}

void print_tf(const tf2_msgs::TFMessage::ConstPtr& message) {
  for (const auto& transform : message->transforms) {
    std::printf("tf %s %s", transform.header.frame_id.c_str(), transform.child_frame_id.c_str());
    print_pose(transform.transform.translation, transform.transform.rotation);
    ++transforms;
  }
}

void print_state(const std_msgs::String::ConstPtr& message) {
  std::printf("state %s\n", message->data.c_str());
  ++answers;
  if (message->data.rfind("manhattan", 0) == 0 || message->data.rfind("fallback", 0) == 0) ++expected_poses;
}

sensor_msgs::Image read_image(const std::string& path, const std_msgs::Header& header) {
  const cv::Mat picture = cv::imread(path);
  sensor_msgs::Image image;
  image.header = header;
  image.width = static_cast<std::uint32_t>(picture.cols);
  image.height = static_cast<std::uint32_t>(picture.rows);
  image.encoding = "bgr8";
  image.step = image.width * 3;
  image.data.assign(picture.data, picture.data + picture.total() * 3);
  return image;
}

void print_path(const nav_msgs::Path::ConstPtr& path) {
  std::printf("path %zu\n", path->poses.size());
}

void print_points(const sensor_msgs::PointCloud2::ConstPtr& cloud) {
  std::printf("points %u\n", cloud->width);
}

template <class Holds>
void wait_until(Holds holds) {
  while (ros::ok() && !holds()) ros::getGlobalCallbackQueue()->callOne(ros::WallDuration(0.1));
}

}  // namespace

int main(int argc, char** argv) {
  ros::init(argc, argv, "player");
  if (argc != 8) return 2;
  ros::NodeHandle ros;
  const ros::Subscriber subscribers[] = {
      ros.subscribe("/sslam/pose", 1000, print_pose_message), ros.subscribe("/tf", 1000, print_tf),
      ros.subscribe("/sslam/state", 1000, print_state),       ros.subscribe("/sslam/path", 1000, print_path),
      ros.subscribe("/sslam/points", 1000, print_points),
  };
  const ros::Publisher images = ros.advertise<sensor_msgs::Image>("image", 10);
  // The node turns away from it when it has a camera.
  const auto taken = [](const ros::SingleSubscriberPublisher&) { ++cameras_taken; };
  const ros::Publisher cameras = ros.advertise<sensor_msgs::CameraInfo>(
      "camera_info", 1, ros::SubscriberStatusCallback(), taken, ros::VoidConstPtr(), true);
  sensor_msgs::CameraInfo camera;
  camera.width = static_cast<std::uint32_t>(std::atoi(argv[1]));
  camera.height = static_cast<std::uint32_t>(std::atoi(argv[2]));
  camera.distortion_model = "plumb_bob";
  camera.D.assign(5, 0);
  camera.K = {std::atof(argv[3]), 0, std::atof(argv[5]), 0, std::atof(argv[4]), std::atof(argv[6]), 0, 0, 1};
  cameras.publish(camera);
  std::ifstream list(argv[7]);
  std::uint64_t stamp = 0;
  std::string path;
  const auto connected = [&] {
    for (const ros::Subscriber& subscriber : subscribers)
      if (subscriber.getNumPublishers() == 0) return false;
    return images.getNumSubscribers() > 0 && cameras_taken > 0;
  };
  wait_until(connected);
  for (int i = 1; list >> stamp >> path; ++i) {
    std_msgs::Header header;
    header.stamp.fromNSec(stamp);
    header.frame_id = "optical";
    images.publish(read_image(path, header));
    wait_until([i] { return answers >= i; });
  }
  wait_until([] { return poses >= expected_poses && transforms >= expected_poses; });
  ros::shutdown();
  return 0;
}
