// SPDX-License-Identifier: BSD-3-Clause
// Recordings, read as the command line reads them.
#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/unique_ptr.h>
#include <nanobind/stl/vector.h>

#include <memory>
#include <mutex>
#include <optional>

#include "bindings/arrays.hpp"
#include "bindings/bindings.hpp"
#include "bindings/free.hpp"
#include "bindings/images.hpp"
#include "bindings/messages.hpp"
#include "cli/input/first_image.hpp"
#include "cli/input/frame_reader.hpp"
#include "cli/input/open_images.hpp"
#include "sslam/opencv/camera/wide_view.hpp"

namespace sslam::python {
namespace {

// A dataset and the camera of its images.
struct Recording {
  io::Dataset dataset;
  cli::CameraChoice camera;
  std::optional<WideView> view;  // of a wide lens: its images are undistorted to it
  std::vector<std::string> messages;
};

// Depth belongs to the images as they come.
void look_through(Recording& recording) {
  recording.view.emplace(*recording.camera.wide, recording.camera.view_fov);
  bool any = false;
  for (io::FrameEntry& frame : recording.dataset.frames) {
    any = any || !frame.depth.empty();
    frame.depth.clear();
  }
  if (any)
    recording.dataset.warnings.push_back(recording.dataset.root.string() +
                                         ": its depth images are those of a wide lens, and are left out");
}

std::unique_ptr<Recording> open(const std::filesystem::path& path, const io::BagTopics& topics,
                                const cli::CameraWish& wish, double frame_rate, const io::Slice& slice) {
  const Free free;
  auto recording = std::make_unique<Recording>();
  (void)take_messages();
  io::Dataset& dataset = recording->dataset;
  dataset = cli::open_frames(path, {frame_rate}, topics, slice.end);
  io::apply_slice(dataset, slice);
  recording->camera = cli::camera_for_images(wish, dataset);
  if (recording->camera.wide) look_through(*recording);
  recording->messages = dataset.warnings;
  for (const std::vector<std::string>& more :
       {recording->camera.notes, recording->camera.warnings, take_messages()})
    recording->messages.insert(recording->messages.end(), more.begin(), more.end());
  return recording;
}

// The frames one after the other. Threads take turns.
class Frames {
 public:
  explicit Frames(const Recording& recording)
      : recording_(recording),
        reader_(recording.dataset, {recording.camera.camera.width, recording.camera.camera.height}) {}

  // (image or None, why there is none, stamp, depth or None, name, index, pose or None, mask or None); None
  // at the end.
  nb::object next(bool with_depth) {
    const io::FrameEntry* entry = nullptr;
    cv::Mat image, depth;
    std::string why, name;
    {
      const Free free;
      const std::lock_guard lock(mutex_);
      if (at_ < recording_.dataset.frames.size()) {
        entry = &recording_.dataset.frames[at_++];
        image = reader_.read(*entry, why);
        name = reader_.stem(*entry);
        if (recording_.view && !image.empty()) image = recording_.view->of(image);
        if (with_depth && !image.empty() && !entry->depth.empty()) depth = reader_.read_depth(*entry, why);
      }
    }
    if (entry == nullptr) return nb::none();
    const SE3<double>* const truth = recording_.dataset.world_from_cam(*entry);
    return nb::make_tuple(image_array(image), why, entry->stamp, image_array(depth), name, entry->index,
                          truth != nullptr ? nb::cast(matrix_array<4, 4>(matrix_of(*truth))) : nb::none(),
                          recording_.view ? image_array(recording_.view->seen().clone()) : nb::none());
  }

 private:
  const Recording& recording_;
  cli::FrameReader reader_;
  std::mutex mutex_;
  std::size_t at_ = 0;
};

}  // namespace

void bind_datasets(nb::module_& module) {
  nb::class_<Recording>(module, "Recording")
      .def_prop_ro("camera", [](const Recording& r) { return r.camera.camera; })
      .def_prop_ro("camera_source", [](const Recording& r) { return r.camera.source; })
      .def_prop_ro("depth_factor", [](const Recording& r) { return r.camera.depth_factor; })
      .def_prop_ro("layout",
                   [](const Recording& r) { return std::string(cli::layout_name(r.dataset.layout)); })
      .def_prop_ro("messages", [](const Recording& r) { return r.messages; })
      .def_prop_ro("seconds_per_stamp", [](const Recording& r) { return r.dataset.seconds_per_stamp; })
      .def_prop_ro("has_depth",
                   [](const Recording& r) {
                     return std::any_of(r.dataset.frames.begin(), r.dataset.frames.end(),
                                        [](const io::FrameEntry& f) { return !f.depth.empty(); });
                   })
      .def("__len__", [](const Recording& r) { return r.dataset.frames.size(); })
      .def("stamps",
           [](const Recording& r) {
             std::vector<double> stamps = io::frame_stamps(r.dataset);
             const std::size_t count = stamps.size();
             return make_array(std::move(stamps), {count});
           })
      .def("ground_truth", [](const Recording& r) { return trajectory_arrays(r.dataset.ground_truth); });
  module.def(
      "open_recording",
      [](const std::filesystem::path& path, const std::string& topic, const std::string& depth_topic,
         const std::string& camera, double focal, double fov, double undistort_fov, double frame_rate,
         std::int64_t start, std::int64_t end, std::int64_t stride) {
        return open(path, {topic, depth_topic}, {camera, focal, fov, undistort_fov}, frame_rate,
                    {start, end, stride});
      },
      nb::arg("path"), nb::arg("topic"), nb::arg("depth_topic"), nb::arg("camera"), nb::arg("focal"),
      nb::arg("fov"), nb::arg("undistort_fov"), nb::arg("frame_rate"), nb::arg("start"), nb::arg("end"),
      nb::arg("stride"));
  nb::class_<Frames>(module, "Frames")
      .def(nb::init<const Recording&>(), nb::keep_alive<1, 2>())
      .def("next", &Frames::next, nb::arg("with_depth"),
           nb::sig("def next(self, with_depth: bool) -> tuple | None"));
}

}  // namespace sslam::python
