// SPDX-License-Identifier: BSD-3-Clause
// The parts of the extension module sslam._sslam. It takes numbers as numpy has them and answers in kind;
// names, defaults and checks of arguments that need no C++ are in Python, beside it.
#pragma once

#include <nanobind/nanobind.h>

namespace sslam::python {

void bind_camera(nanobind::module_& module);
void bind_wide_lens(nanobind::module_& module);
void bind_system(nanobind::module_& module);
void bind_map(nanobind::module_& module);
void bind_kernels(nanobind::module_& module);
void bind_image_kernels(nanobind::module_& module);
void bind_map_kernels(nanobind::module_& module);
void bind_datasets(nanobind::module_& module);
void bind_evaluation(nanobind::module_& module);

}  // namespace sslam::python
