// SPDX-License-Identifier: BSD-3-Clause
// What io throws: what() is one line that names the file and says what would be right.
#pragma once

#include <stdexcept>

namespace sslam::io {

struct Error : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace sslam::io
