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
  const Camera<double> camera{{fx, fy, cx, cy}, {k1, k2, p1, p2, k3}, width, height};
  if (const CameraCheck check = check_camera(camera); !check.fault.empty())
    throw nb::value_error(("camera: " + check.fault).c_str());
  return camera;
}

// An argument, looked at by the Python side: one wording for all that is refused.
nb::object checked(const char* check, const char* name, nb::handle value) {
  return nb::module_::import_("sslam._check").attr(check)(name, value);
}

double real(const char* name, nb::handle value) {
  return nb::cast<double>(checked("real", name, value));
}

int pixels(const char* name, nb::handle value) {
  return nb::cast<int>(nb::module_::import_("sslam._check").attr("whole")(name, value, 1));
}

nb::tuple values_of(const Camera<double>& c) {
  const Pinhole<double>& p = c.pinhole;
  const RadTan<double>& d = c.distortion;
  return nb::make_tuple(p.fx, p.fy, p.cx, p.cy, c.width, c.height, d.k1, d.k2, d.p1, d.p2, d.k3);
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
          [](C* self, nb::handle fx, nb::handle fy, nb::handle cx, nb::handle cy, nb::handle width,
             nb::handle height, nb::handle k1, nb::handle k2, nb::handle p1, nb::handle p2, nb::handle k3) {
            new (self) C(make(real("fx", fx), real("fy", fy), real("cx", cx), real("cy", cy),
                              pixels("width", width), pixels("height", height), real("k1", k1),
                              real("k2", k2), real("p1", p1), real("p2", p2), real("k3", k3)));
          },
          nb::arg("fx").none(), nb::arg("fy").none(), nb::arg("cx").none(), nb::arg("cy").none(),
          nb::arg("width").none(), nb::arg("height").none(), nb::arg("k1").none() = 0.0,
          nb::arg("k2").none() = 0.0, nb::arg("p1").none() = 0.0, nb::arg("p2").none() = 0.0,
          nb::arg("k3").none() = 0.0,
          nb::sig("def __init__(self, fx: float, fy: float, cx: float, cy: float, width: int, height: int, "
                  "k1: float = 0.0, k2: float = 0.0, p1: float = 0.0, p2: float = 0.0, k3: float = 0.0) -> "
                  "None"))
      .def_static(
          "from_file",
          [](nb::handle path) {
            return read_camera_file(nb::cast<std::filesystem::path>(checked("path", "path", path))).camera;
          },
          nb::arg("path").none(), nb::sig("def from_file(path: str | os.PathLike) -> Camera"),
          "Reads a camera file in any format that docs/inputs.md lists. Raises sslam.Error.")
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
      .def(
          "__eq__", [](const C& a, const C& b) { return values_of(a).equal(values_of(b)); },
          nb::is_operator(), nb::sig("def __eq__(self, other: object) -> bool"))
      .def("__hash__", [](const C& c) { return nb::hash(values_of(c)); })
      .def("__reduce__",
           [](nb::handle self) {  // copies, and other processes
             return nb::make_tuple(self.type(), values_of(nb::cast<const C&>(self)));
           })
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
