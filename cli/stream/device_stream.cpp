// SPDX-License-Identifier: BSD-3-Clause
#include "cli/stream/device_stream.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <opencv2/imgproc.hpp>
#include <thread>

#include "cli/input/quiet_decoders.hpp"
#include "sslam/core/error.hpp"
#include "sslam/io/files/files.hpp"
#include "sslam/io/files/text.hpp"

namespace sslam::cli {
namespace {

namespace fs = std::filesystem;

std::string cameras_here() {
  std::string list;
  for (int i = 0; i < 64; ++i) {
    const std::string name = "/dev/video" + std::to_string(i);
    std::error_code ignored;
    if (fs::exists(name, ignored)) io::add_to_list(list, name);
  }
  return list.empty() ? "none" : list;
}

// Why the file of a device cannot be used; empty: it can.
std::string trouble_with(const std::string& file) {
  const int device = open(file.c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC);
  if (device >= 0) {
    close(device);
    return {};
  }
  return std::strerror(errno);
}

}  // namespace

DeviceStream::DeviceStream(const std::string& name, cv::Size size, Patience& patience) : patience_(patience) {
  file_ = io::all_digits(name) ? "/dev/video" + name : name;
  if (const std::string trouble = trouble_with(file_); !trouble.empty())
    throw Error(name + ": no camera " + file_ + " (" + trouble + "); there is " + cameras_here());
  // Read by OpenCV at its first wait for a camera: a wait of ten seconds would outlast Ctrl-C.
  setenv("OPENCV_VIDEOIO_V4L_SELECT_TIMEOUT", "1", 0);
  const QuietDecoders quiet;
  if (!camera_.open(file_, cv::CAP_V4L2))
    throw Error(name + ": " + file_ + " gives no video; another program may use it, or it is no camera");
  if (size.empty()) return;
  // A driver takes the nearest size that it has; whether the camera file is for that is asked later.
  camera_.set(cv::CAP_PROP_FRAME_WIDTH, size.width);
  camera_.set(cv::CAP_PROP_FRAME_HEIGHT, size.height);
}

// What a driver does wrong, OpenCV throws at us.
bool DeviceStream::grab(cv::Mat& image) {
  try {
    if (!camera_.grab() || !camera_.retrieve(image) || image.empty()) return false;
    image = image.clone();  // OpenCV's own buffer is filled again
    return true;
  } catch (const cv::Exception&) {
    return false;
  }
}

bool DeviceStream::read(StreamFrame& out) {
  out = {};
  while (!patience_.over()) {
    if (grab(out.image)) {
      if (out.image.channels() == 1) cv::cvtColor(out.image, out.image, cv::COLOR_GRAY2BGR);
      const double milliseconds = camera_.get(cv::CAP_PROP_POS_MSEC);  // of the driver's clock
      if (milliseconds > 0) out.time = milliseconds * 1e-3;
      patience_.heard();
      return true;
    }
    if (!trouble_with(file_).empty()) return false;  // unplugged
    std::this_thread::sleep_for(Patience::kLook);
  }
  return false;
}

}  // namespace sslam::cli
