// SPDX-License-Identifier: BSD-3-Clause
#include <nanobind/nanobind.h>

#include <opencv2/core.hpp>
#include <string>

#include "bindings/bindings.hpp"
#include "bindings/free.hpp"
#include "bindings/tracking.hpp"
#include "sslam/core/error.hpp"
#include "sslam/core/status.hpp"
#include "sslam/system/settings.hpp"
#include "sslam/version.hpp"

namespace nb = nanobind;
using namespace sslam;

namespace {

// The types are the Python side's own, so that they may have two bases.
PyObject* error_type(const char* name) {
  return nb::module_::import_("sslam._errors").attr(name).ptr();
}

void translate(const std::exception_ptr& thrown, void*) {
  try {
    std::rethrow_exception(thrown);
  } catch (const python::Finished& error) {
    PyErr_SetString(error_type("FinishedError"), error.what());
  } catch (const SettingsError& error) {
    PyErr_SetString(error_type("SettingsError"), error.what());
  } catch (const Error& error) {
    PyErr_SetString(error_type("Error"), error.what());
  } catch (const cv::Exception& error) {
    PyErr_SetString(error_type("Error"), ("OpenCV: " + error.err).c_str());
  }
}

}  // namespace

NB_MODULE(_sslam, module) {
  module.doc() = "The compiled part of sslam: use the package `sslam`, which checks arguments.";
  nb::register_exception_translator(translate);
  python::wait_at_exit();
  nb::set_leak_warnings(false);  // a daemon thread that goes on to the end keeps what it has
  module.attr("__version__") = SSLAM_VERSION;
  nb::enum_<Status>(module, "Status", nb::is_arithmetic(),
                    "The result code of a kernel: one for success, and one for each kind of failure.")
      .value("OK", Status::kOk, "the result may be used")
      .value("TOO_FEW", Status::kTooFew, "fewer observations than unknowns, or than the minimum")
      .value("DEGENERATE", Status::kDegenerate,
             "the observations do not determine the result in some direction")
      .value("LOW_PARALLAX", Status::kLowParallax, "the views are too close together for a depth")
      .value("BEHIND", Status::kBehind, "the result lies behind a camera")
      .value("NO_CONSENSUS", Status::kNoConsensus, "no model agrees with enough of the observations")
      .value("NOT_CONVERGED", Status::kNotConverged,
             "the iterations ran out; the best state so far is returned")
      .value("NOT_FINITE", Status::kNotFinite, "an input was NaN or infinite");
  python::bind_camera(module);
  python::bind_wide_lens(module);
  python::bind_map(module);
  python::bind_system(module);
  python::bind_kernels(module);
  python::bind_image_kernels(module);
  python::bind_map_kernels(module);
  python::bind_datasets(module);
  python::bind_evaluation(module);
}
