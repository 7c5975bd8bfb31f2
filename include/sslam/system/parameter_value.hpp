// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace sslam {

// A new value of a parameter, by its name, such as "rotation.squareness", in the unit that users see.
struct ParameterValue {
  std::string name;
  double value = 0;
};

}  // namespace sslam
