// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/track/slots.hpp"

#include <concepts>

#include "sslam/track/presets.hpp"
#include "support/catch.hpp"

namespace {

using namespace sslam;

using Structure = presets::Structure<double>;
using Swapped =
    presets::With<Structure, slots::Rotation<NoRotation<double>>, slots::Loops<NoLoopClosing<double>>>;

static_assert(std::same_as<presets::With<Structure>, Structure>);
static_assert(std::same_as<Swapped::Stages::Rotation, NoRotation<double>>);
static_assert(std::same_as<Swapped::Stages::Loops, NoLoopClosing<double>>);
static_assert(std::same_as<Swapped::Stages::Mapping, Structure::Stages::Mapping>);

}  // namespace

TEST_CASE("A stage that is replaced twice is the last one") {
  using Again = presets::With<Swapped, slots::Rotation<ManhattanRotation<double>>>;
  STATIC_REQUIRE(std::same_as<decltype(Again::rotation), ManhattanRotation<double>>);
  STATIC_REQUIRE(std::same_as<decltype(Again::loops), NoLoopClosing<double>>);
}
