// SPDX-License-Identifier: BSD-3-Clause
// Lenses that see more than a pinhole can, for programs that read images by themselves.
#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <filesystem>

#include "bindings/bindings.hpp"
#include "bindings/free.hpp"
#include "bindings/images.hpp"
#include "cli/input/camera_choice.hpp"
#include "cli/input/camera_fit.hpp"
#include "cli/input/size_text.hpp"
#include "sslam/opencv/camera/camera_file.hpp"
#include "sslam/opencv/camera/wide_view.hpp"

namespace sslam::python {
namespace {

struct Lens {
  cli::CameraChoice choice;
  WideView view;
};

cli::CameraChoice choose(const std::filesystem::path& path, double fov) {
  cli::CameraChoice choice = cli::camera_from_file(path);
  if (!choice.all.empty())
    throw Error(choice.source + ": has several cameras; name one, as in FILE#" + choice.all.front().name);
  if (!choice.wide)
    throw Error(choice.source + ": has a lens that is not too wide for a pinhole; use sslam.Camera");
  const Camera<double>& camera = choice.camera;
  if (camera.width == 0 || camera.height == 0)
    throw Error(choice.source + ": says no width and height of the images, which are needed here");
  cli::fit_camera(choice.camera, camera.width, camera.height, choice.source, choice.notes, choice.warnings);
  cli::take_view(choice, fov);
  return choice;
}

// What is made of an image, or of a mask.
template <class Make>
nb::object made_of(const Lens& lens, const PixelArray& pixels, const char* name, Make make) {
  const cv::Mat given = mat_of(pixels);
  const Camera<double>& camera = lens.choice.camera;
  if (given.cols != camera.width || given.rows != camera.height)
    throw nb::value_error((std::string(name) + ": has " + cli::size_text(given.cols, given.rows) +
                           " pixels; the lens's images have " + cli::size_text(camera.width, camera.height))
                              .c_str());
  cv::Mat made;
  {
    const Free free;
    made = make(given);
  }
  return image_array(std::move(made));
}

}  // namespace

void bind_wide_lens(nb::module_& module) {
  nb::class_<Lens>(module, "Lens")
      .def(
          "__init__",
          [](Lens* self, const std::filesystem::path& path, double fov) {
            cli::CameraChoice choice = choose(path, fov);
            WideView view(*choice.wide, choice.view_fov);
            new (self) Lens{std::move(choice), std::move(view)};
          },
          nb::arg("path"), nb::arg("fov"))
      .def_prop_ro("camera", [](const Lens& l) { return l.choice.camera; })
      .def_prop_ro("fov", [](const Lens& l) { return l.choice.view_fov; })
      .def_prop_ro("warnings", [](const Lens& l) { return l.choice.warnings; })
      .def(
          "image",
          [](const Lens& l, const PixelArray& image) {
            return made_of(l, image, "image", [&](const cv::Mat& given) { return l.view.of(given); });
          },
          nb::arg("image"),
          nb::sig("def image(self, image: numpy.typing.NDArray[numpy.uint8]) -> "
                  "numpy.typing.NDArray[numpy.uint8]"))
      .def(
          "mask",
          [](const Lens& l, const std::optional<PixelArray>& mask) {
            if (!mask) return image_array(l.view.seen().clone());
            return made_of(l, *mask, "mask", [&](const cv::Mat& given) { return l.view.mask(given); });
          },
          nb::arg("mask").none(),
          nb::sig("def mask(self, mask: numpy.typing.NDArray[numpy.uint8] | None) -> "
                  "numpy.typing.NDArray[numpy.uint8]"));
  module.def(
      "is_wide",
      [](const std::filesystem::path& path) { return read_wide_camera_file(path).wide.has_value(); },
      nb::arg("path"));
}

}  // namespace sslam::python
