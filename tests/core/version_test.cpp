// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/version.hpp"

#include <string>

#include "support/catch.hpp"

TEST_CASE("The version as text is made of its three numbers") {
  const std::string numbers = std::to_string(SSLAM_VERSION_MAJOR) + "." +
                              std::to_string(SSLAM_VERSION_MINOR) + "." + std::to_string(SSLAM_VERSION_PATCH);
  REQUIRE(SSLAM_VERSION == numbers);
}
