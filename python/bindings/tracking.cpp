// SPDX-License-Identifier: BSD-3-Clause
#include "bindings/tracking.hpp"

#include <unistd.h>

#include <chrono>
#include <cmath>
#include <utility>

#include "bindings/images.hpp"
#include "bindings/own_normals.hpp"
#include "sslam/io/files/text.hpp"

namespace sslam::python {
namespace {

std::string size_of(const cv::Mat& image) {
  return std::to_string(image.cols) + "x" + std::to_string(image.rows);
}

}  // namespace

Tracking::Tracking(Settings settings, double normals_sigma)
    : process_(getpid()),
      system_(std::make_unique<System>(std::move(settings))),
      normals_sigma_(normals_sigma) {
  system_->add_observer(*this);
}

// The threads of a system end with it; after a fork there are none, and it is left as it is.
Tracking::~Tracking() {
  if (getpid() != process_) (void)system_.release();
}

void Tracking::demand_same_process() const {
  if (getpid() != process_)
    throw Error(
        "System: was made before this process was forked, and its threads are not here; make one here");
}

void Tracking::demand_unfinished(const char* call) const {
  if (finished_) throw Finished(std::string(call) + ": the system has finished; make another one");
}

Result Tracking::track(const Given& given) {
  const Turn turn(*this);
  demand_unfinished("track");
  ImageInput input;
  input.index = system_->frames();
  input.stamp = given.stamp;
  input.name = given.name;
  input.image = bgr_of(given.image, given.rgb);
  input.mask = given.mask;
  input.depth = given.depth;
  input.depth_factor = system_->settings().depth_factor;
  heard_ = {};
  system_->extract(input, extraction_);
  if (extraction_.usable() && !given.normals.empty()) add_normals(given.normals);
  static_cast<FrameReport&>(heard_) = system_->track(extraction_);
  if (heard_.input != InputStatus::kOk) throw nanobind::value_error(fault(heard_.input, given).c_str());
  last_stamp_ = given.stamp;
  return std::move(heard_);
}

void Tracking::keyframe_made(const FrameEvent& event) {
  colours_.note(event.frame.frame, event.input.picture, system_->camera());
}

CloudRows Tracking::cloud() {
  const Turn turn(*this);
  const Map<double>& map = system_->map();
  return {points_of(map), colours_of(map, colours_.of(map))};
}

void Tracking::add_normals(const cv::Mat& normals) {
  const auto begin = std::chrono::steady_clock::now();
  extraction_.report.normals =
      take_normals(normals, system_->camera(), own_normals_options(system_->parameters()), normals_sigma_,
                   extraction_.frame.normals);
  extraction_.report.normals_time =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

std::string Tracking::fault(InputStatus status, const Given& given) const {
  const Camera<double>& camera = system_->settings().camera;
  switch (status) {
    case InputStatus::kWrongSize:
      return "image: has " + size_of(given.image) + " pixels; the camera's images have " +
             std::to_string(camera.width) + "x" + std::to_string(camera.height);
    case InputStatus::kWrongMask:
      return "mask: has " + size_of(given.mask) + " pixels, and the image " + size_of(given.image);
    case InputStatus::kBadStamp:
      return "stamp: " + io::exact_decimal(given.stamp) +
             (last_stamp_
                  ? " is not later than " + io::exact_decimal(*last_stamp_) + ", that of the frame before"
                  : " is not finite");
    default:
      return std::string("image: ") + name(status);
  }
}

bool Tracking::finish() {
  const Turn turn(*this);
  finished_ = true;
  return system_->finish();
}

void Tracking::load(const std::filesystem::path& path) {
  const Turn turn(*this);
  demand_unfinished("load");
  system_->load(path);
}

void Tracking::localise_only(bool on) {
  const Turn turn(*this);
  demand_unfinished("localise_only");
  system_->localise_only(on);
}

}  // namespace sslam::python
