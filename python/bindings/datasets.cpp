// SPDX-License-Identifier: BSD-3-Clause
// Recordings, read as the command line reads them.
#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/unique_ptr.h>
#include <nanobind/stl/vector.h>

#include <memory>
#include <mutex>

#include "bindings/arrays.hpp"
#include "bindings/bindings.hpp"
#include "bindings/messages.hpp"
#include "cli/input/first_image.hpp"
#include "cli/input/frame_reader.hpp"
#include "cli/input/open_images.hpp"

namespace sslam::python {
namespace {

// A dataset and the camera of its images.
struct Recording {
  io::Dataset dataset;
  cli::CameraChoice camera;
  std::vector<std::string> messages;
};

std::unique_ptr<Recording> open(const std::filesystem::path& path, const std::string& camera, double focal,
                                double fov, double frame_rate, std::int64_t start, std::int64_t end,
                                std::int64_t stride) {
  const nb::gil_scoped_release free;
  auto recording = std::make_unique<Recording>();
  (void)take_messages();
  io::Dataset& dataset = recording->dataset;
  dataset = cli::open_frames(path, {frame_rate}, {}, end);
  io::apply_slice(dataset, {start, end, stride});
  recording->camera = cli::camera_for_images({camera, focal, fov}, dataset);
  recording->messages = dataset.warnings;
  for (const std::vector<std::string>& more :
       {recording->camera.notes, recording->camera.warnings, take_messages()})
    recording->messages.insert(recording->messages.end(), more.begin(), more.end());
  return recording;
}

nb::object array_of(cv::Mat image) {
  if (image.empty()) return nb::none();
  auto kept = std::make_unique<cv::Mat>(image.isContinuous() ? std::move(image) : image.clone());
  const auto rows = static_cast<std::size_t>(kept->rows), columns = static_cast<std::size_t>(kept->cols);
  const auto channels = static_cast<std::size_t>(kept->channels());
  const int depth = kept->depth();
  void* const data = kept->data;
  const nb::capsule owner(kept.release(), [](void* all) noexcept { delete static_cast<cv::Mat*>(all); });
  std::vector<std::size_t> shape{rows, columns};
  if (channels > 1) shape.push_back(channels);
  const auto cast = [&]<class T>(T) {
    return nb::cast(Made<T>(static_cast<T*>(data), shape.size(), shape.data(), owner));
  };
  if (depth == CV_8U) return cast(std::uint8_t{});
  if (depth == CV_16U) return cast(std::uint16_t{});
  if (depth == CV_32F) return cast(float{});
  throw Error("image: has pixels of a type that numpy gets none of");
}

// The frames one after the other. Threads take turns.
class Frames {
 public:
  explicit Frames(const Recording& recording)
      : recording_(recording),
        reader_(recording.dataset, {recording.camera.camera.width, recording.camera.camera.height}) {}

  // (image or None, why there is none, stamp, depth or None, name, index, pose or None); None at the end.
  nb::object next(bool with_depth) {
    const io::FrameEntry* entry = nullptr;
    cv::Mat image, depth;
    std::string why, name;
    {
      const nb::gil_scoped_release free;
      const std::lock_guard lock(mutex_);
      if (at_ < recording_.dataset.frames.size()) {
        entry = &recording_.dataset.frames[at_++];
        image = reader_.read(*entry, why);
        name = reader_.stem(*entry);
        if (with_depth && !image.empty() && !entry->depth.empty()) depth = reader_.read_depth(*entry, why);
      }
    }
    if (entry == nullptr) return nb::none();
    const SE3<double>* const truth = recording_.dataset.world_from_cam(*entry);
    return nb::make_tuple(array_of(image), why, entry->stamp, array_of(depth), name, entry->index,
                          truth != nullptr ? nb::cast(matrix_array<4, 4>(matrix_of(*truth))) : nb::none());
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
      .def_prop_ro("layout", [](const Recording& r) { return std::string(io::name(r.dataset.layout)); })
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
  module.def("open_recording", &open);
  nb::class_<Frames>(module, "Frames")
      .def(nb::init<const Recording&>(), nb::keep_alive<1, 2>())
      .def("next", &Frames::next, nb::arg("with_depth"),
           nb::sig("def next(self, with_depth: bool) -> tuple | None"));
}

}  // namespace sslam::python
