// SPDX-License-Identifier: BSD-3-Clause
// A parameter and the value that it is to have.
#pragma once

#include <string>

namespace sslam {

// By its name, such as "rotation.squareness", in the unit that users see.
struct ParameterValue {
  std::string name;
  double value = 0;
};

}  // namespace sslam
