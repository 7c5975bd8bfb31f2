// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/opencv.hpp"

int main() {
  sslam::ImageFrontend<> frontend;
  frontend.camera.pinhole = {500, 500, 319.5, 239.5};
  frontend.camera.width = 640;
  frontend.camera.height = 480;
  sslam::ImageInput input;
  input.image = cv::Mat(480, 640, CV_8UC1, cv::Scalar(90));
  input.image(cv::Rect(200, 150, 200, 150)).setTo(200);
  sslam::Frame<double> frame;
  const auto report = frontend.process(input, frame);
  return report.image == sslam::ImageStatus::kOk && !frame.lines.empty() ? 0 : 1;
}
