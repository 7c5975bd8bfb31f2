// SPDX-License-Identifier: BSD-3-Clause
// The words of `sslam synth` for what a house can be.
#pragma once

#include <array>
#include <map>
#include <string>

#include "cli/synth/image_fixed.hpp"
#include "sslam/synth/house.hpp"

namespace sslam::cli {

inline const std::map<std::string, synth::Richness> kRichnessNames{
    {"rich", synth::Richness::kRich}, {"mixed", synth::Richness::kMixed}, {"poor", synth::Richness::kPoor}};
inline const std::map<std::string, synth::World> kWorldNames{{"manhattan", synth::World::kManhattan},
                                                             {"turned", synth::World::kTurned},
                                                             {"oblique", synth::World::kOblique},
                                                             {"free", synth::World::kFree}};
inline const std::map<std::string, synth::PathKind> kPathNames{
    {"loop", synth::PathKind::kLoop}, {"sweep", synth::PathKind::kSweep}, {"pivot", synth::PathKind::kPivot}};

inline const std::map<std::string, ImageFixed> kImageFixedNames{{"none", ImageFixed::kNone},
                                                                {"text", ImageFixed::kText},
                                                                {"bar", ImageFixed::kBar},
                                                                {"dots", ImageFixed::kDots}};

template <class Value>
[[nodiscard]] std::string name_of(const std::map<std::string, Value>& names, Value value) {
  for (const auto& [name, named] : names) {
    if (named == value) return name;
  }
  return {};
}

}  // namespace sslam::cli
