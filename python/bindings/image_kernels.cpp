// SPDX-License-Identifier: BSD-3-Clause
// Kernels on images: line segments, and the normals that a network sees.
#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/map.h>
#include <nanobind/stl/string.h>

#include <filesystem>
#include <map>
#include <mutex>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "bindings/bindings.hpp"
#include "bindings/free.hpp"
#include "bindings/images.hpp"
#include "sslam/core/parameter_table.hpp"
#include "sslam/opencv/lines/line_extractor.hpp"
#include "sslam/opencv/normals/onnx_normals.hpp"
#include "sslam/system/settings.hpp"

namespace sslam::python {
namespace {

// The parameters "lines.*" of a system, with these values.
LineOptions line_options(const std::map<std::string, double>& values) {
  ParameterTable table;
  const auto every = [](LineOptions& options) {
    return [&options](auto& visit) { visit_within("lines.", options, visit); };
  };
  LineOptions options;
  table.collect(every(options));
  for (const auto& [name, value] : values)
    if (const ParameterAnswer answer = table.set(name, value); !answer.ok())
      throw SettingsError("parameters", answer.message);
  table.write(every(options));
  return options;
}

cv::Mat grey_of(const cv::Mat& image, bool rgb) {
  cv::Mat grey = image;
  if (image.channels() == 3) cv::cvtColor(image, grey, rgb ? cv::COLOR_RGB2GRAY : cv::COLOR_BGR2GRAY);
  if (image.channels() == 4) cv::cvtColor(image, grey, rgb ? cv::COLOR_RGBA2GRAY : cv::COLOR_BGRA2GRAY);
  return grey;
}

// (segments (N, 4), sigmas (N,)), longest first
nb::tuple line_segments(const PixelArray& image, bool rgb, const std::map<std::string, double>& values) {
  const cv::Mat pixels = mat_of(image);
  std::vector<double> ends, sigmas;
  {
    const Free free;
    LineExtractor extractor;
    extractor.options = line_options(values);
    std::vector<LineFeature<double>> lines;
    extractor.extract(grey_of(pixels, rgb), lines);
    for (const LineFeature<double>& line : lines) {
      append(ends, line.segment.start);
      append(ends, line.segment.end);
      sigmas.push_back(line.sigma);
    }
  }
  const std::size_t count = sigmas.size();
  return nb::make_tuple(make_array(std::move(ends), {count, 4}), make_array(std::move(sigmas), {count}));
}

// A network of normals. Threads take turns.
class Network {
 public:
  explicit Network(const std::filesystem::path& file) : model_(file) {
    if (model_.manifest().kind != NetworkOutput::kNormals)
      throw Error(model_.manifest().file.string() + ": output.kind: expected normals, not depth");
  }

  // (status, normals (h, w, 3), probabilities of a plane (h, w) or None, camera of these pixels)
  nb::tuple normals(const PixelArray& image, bool rgb, const Camera<double>& camera) {
    const cv::Mat pixels = mat_of(image);
    DenseNormals dense;
    NormalStatus status = NormalStatus::kOk;
    {
      const Free free;
      const cv::Mat bgr = bgr_of(pixels, rgb);
      const std::lock_guard lock(in_use_);
      status = model_.infer(bgr, camera, dense);
    }
    if (status != NormalStatus::kOk) return nb::make_tuple(status, nb::none(), nb::none(), nb::none());
    const Camera<double> grid{dense.pinhole, {}, dense.normal.cols, dense.normal.rows};
    return nb::make_tuple(status, image_array(dense.normal.clone()), image_array(dense.planar.clone()), grid);
  }

 private:
  std::mutex in_use_;
  OnnxNormals model_;
};

}  // namespace

void bind_image_kernels(nb::module_& module) {
  nb::enum_<NormalStatus>(module, "NormalStatus", nb::is_arithmetic(),
                          "Whether an image has normals, or why not.")
      .value("OK", NormalStatus::kOk)
      .value("NO_INPUT", NormalStatus::kNoInput, "no depth image, or no file of normals")
      .value("UNREADABLE", NormalStatus::kUnreadable, "a file that cannot be decoded")
      .value("WRONG_SIZE", NormalStatus::kWrongSize, "the shape does not fit the camera's images")
      .value("WRONG_TYPE", NormalStatus::kWrongType, "the wrong type of pixels")
      .value("FACES_AWAY", NormalStatus::kFacesAway, "most normals point away from the camera")
      .value("TOO_SMALL", NormalStatus::kTooSmall, "the image has too few pixels for the network")
      .value("BAD_OUTPUT", NormalStatus::kBadOutput,
             "the network's values are not finite, not of unit length or not in their range")
      .value("OUT_OF_RANGE", NormalStatus::kOutOfRange, "hardly any depth is in the range that is used")
      .value("NO_EVIDENCE", NormalStatus::kNoEvidence,
             "too few pixels are planar, or their normals disagree");
  module.def("line_segments", &line_segments);
  nb::class_<Network>(module, "Network")
      .def("__init__",
           [](Network* self, const std::filesystem::path& file) {
             const Free free;
             new (self) Network(file);
           })
      .def("normals", &Network::normals);
}

}  // namespace sslam::python
