// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "sslam/core/parameter.hpp"

namespace sslam {

// A parameter by its name, such as "rotation.squareness", in the unit that users see.
struct ParameterValue {
  std::string name;
  double value = 0;
};

struct ParameterInfo : ParameterValue {
  Unit unit = Unit::kNumber;
  std::string meaning;
};

}  // namespace sslam
