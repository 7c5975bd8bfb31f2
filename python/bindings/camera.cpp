// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/geometry/camera.hpp"

#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/string.h>

#include <cmath>
#include <filesystem>

#include "bindings/arrays.hpp"
#include "bindings/bindings.hpp"
#include "sslam/geometry/camera_check.hpp"
#include "sslam/opencv/camera/camera_file.hpp"

namespace sslam::python {
namespace {

Camera<double> make(double fx, double fy, double cx, double cy, int width, int height, double k1, double k2,
                    double p1, double p2, double k3) {
  const std::pair<const char*, double> finite[] = {{"fx", fx}, {"fy", fy}, {"cx", cx}, {"cy", cy}, {"k1", k1},
                                                   {"k2", k2}, {"p1", p1}, {"p2", p2}, {"k3", k3}};
  for (const auto& [name, value] : finite)
    if (!std::isfinite(value)) throw nb::value_error((std::string(name) + ": not a finite number").c_str());
  if (width <= 0 || height <= 0)
    throw nb::value_error(
        (std::string(width <= 0 ? "width" : "height") + ": expected a number of pixels, above 0").c_str());
  const Camera<double> camera{{fx, fy, cx, cy}, {k1, k2, p1, p2, k3}, width, height};
  if (const CameraCheck check = check_camera(camera); !check.fault.empty())
    throw nb::value_error(("camera: " + check.fault).c_str());
  return camera;
}

Mat3<double> matrix(const Camera<double>& camera) {
  const Pinhole<double>& p = camera.pinhole;
  Mat3<double> k;
  k << p.fx, 0, p.cx, 0, p.fy, p.cy, 0, 0, 1;
  return k;
}

}  // namespace

void bind_camera(nb::module_& module) {
  using C = Camera<double>;
  nb::class_<C>(
      module, "Camera",
      "A pinhole camera with radial-tangential distortion, OpenCV's model. Focal lengths fx, fy and the\n"
      "principal point cx, cy are in pixels; the middle of the top left pixel is (0, 0). width and height\n"
      "are those of its images, pixels.")
      .def(
          "__init__",
          [](C* self, double fx, double fy, double cx, double cy, int width, int height, double k1, double k2,
             double p1, double p2,
             double k3) { new (self) C(make(fx, fy, cx, cy, width, height, k1, k2, p1, p2, k3)); },
          nb::arg("fx"), nb::arg("fy"), nb::arg("cx"), nb::arg("cy"), nb::arg("width"), nb::arg("height"),
          nb::arg("k1") = 0.0, nb::arg("k2") = 0.0, nb::arg("p1") = 0.0, nb::arg("p2") = 0.0,
          nb::arg("k3") = 0.0)
      .def_static(
          "from_file", [](const std::filesystem::path& path) { return read_camera_file(path).camera; },
          nb::arg("path"), "Reads a camera file in any format that docs/inputs.md lists. Raises sslam.Error.")
      .def_prop_ro("fx", [](const C& c) { return c.pinhole.fx; })
      .def_prop_ro("fy", [](const C& c) { return c.pinhole.fy; })
      .def_prop_ro("cx", [](const C& c) { return c.pinhole.cx; })
      .def_prop_ro("cy", [](const C& c) { return c.pinhole.cy; })
      .def_prop_ro("k1", [](const C& c) { return c.distortion.k1; })
      .def_prop_ro("k2", [](const C& c) { return c.distortion.k2; })
      .def_prop_ro("p1", [](const C& c) { return c.distortion.p1; })
      .def_prop_ro("p2", [](const C& c) { return c.distortion.p2; })
      .def_prop_ro("k3", [](const C& c) { return c.distortion.k3; })
      .def_ro("width", &C::width, "pixels")
      .def_ro("height", &C::height, "pixels")
      .def_prop_ro(
          "matrix", [](const C& c) { return matrix_array<3, 3>(matrix(c)); }, "K, (3, 3)")
      .def("__repr__", [](const C& c) {
        char text[400];
        std::snprintf(
            text, sizeof text,
            "sslam.Camera(fx=%.9g, fy=%.9g, cx=%.9g, cy=%.9g, width=%d, height=%d, k1=%.9g, k2=%.9g, "
            "p1=%.9g, p2=%.9g, k3=%.9g)",
            c.pinhole.fx, c.pinhole.fy, c.pinhole.cx, c.pinhole.cy, c.width, c.height, c.distortion.k1,
            c.distortion.k2, c.distortion.p1, c.distortion.p2, c.distortion.k3);
        return std::string(text);
      });
}

}  // namespace sslam::python
