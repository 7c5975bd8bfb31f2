// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace sslam::python {

// What the readers have said in this thread since it was asked last.
[[nodiscard]] std::vector<std::string> take_messages();

}  // namespace sslam::python
