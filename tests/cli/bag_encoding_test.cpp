// SPDX-License-Identifier: BSD-3-Clause
// Bags whose images are in a form that is not read: one line before the first frame.
#include <fstream>
#include <string>

#include "cli/input/bag_reader.hpp"
#include "cli/input/first_image.hpp"
#include "io/bags/made_bags.hpp"
#include "io/errors.hpp"
#include "support/catch.hpp"
#include "support/scratch_folder.hpp"

namespace bag_encoding_test {

using namespace sslam;
using namespace sslam::made_bags;
using testing::contains;

namespace {

// Of a bag with these messages, for a camera that is known.
std::string error(const std::string& records) {
  const testing::ScratchFolder scratch;
  io::Dataset dataset = io::unread_bag(scratch.write("walk.bag", bag_1(records)));
  cli::list_bag_frames(dataset);
  cli::CameraWish wish;
  wish.file = scratch
                  .write("camera.yaml",
                         "Camera.fx: 2\nCamera.fy: 2\nCamera.cx: 1\nCamera.cy: 0.5\nCamera.width: 2\n"
                         "Camera.height: 1\n")
                  .string();
  return testing::error_of([&] { (void)cli::camera_for_images(wish, dataset); });
}

}  // namespace

TEST_CASE("An encoding of a bag's images that is not read is named, with its topic and what is read") {
  const std::string raw = connection_1(3, "/cam/image_raw", "sensor_msgs/Image") +
                          message_1(3, image_1(1, "nv12")) + message_1(3, image_1(2, "nv12"));
  CHECK(contains(error(raw), "walk.bag frame 0 on /cam/image_raw: has the encoding nv12; read are mono8, "));
  const std::string packed = connection_1(3, "/cam/image", "sensor_msgs/CompressedImage") +
                             message_1(3, header_1(1) + with_length("h264") + with_length("no image"));
  CHECK(contains(
      error(packed),
      "walk.bag frame 0 on /cam/image: has the format \"h264\", which is not read; read are JPEG, "));
}

}  // namespace bag_encoding_test
