// SPDX-License-Identifier: BSD-3-Clause
// What sslam throws above its kernels, which throw nothing: one family, and what() is one line that names the
// file, the option or the argument, what is wrong with it, and what would be right.
#pragma once

#include <stdexcept>

namespace sslam {

struct Error : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace sslam
