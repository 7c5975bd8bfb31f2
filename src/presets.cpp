// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/system/presets.hpp"

#include <algorithm>
#include <utility>

#include "sslam/core/error.hpp"
#include "sslam/system/compiled_pipelines.hpp"

namespace sslam {
namespace {

Preset preset(std::string name, std::string meaning, std::unique_ptr<Engine> (*make)(),
              std::unique_ptr<Engine> (*make_live)() = nullptr) {
  Preset preset;
  preset.name = std::move(name);
  preset.meaning = std::move(meaning);
  preset.make = make;
  preset.make_live = make_live;
  return preset;
}

std::vector<Preset> shipped() {
  constexpr auto kStructure = make_engine<StructurePipeline>;
  constexpr auto kLive = make_engine<LiveStructurePipeline>;
  std::vector<Preset> all{
      preset("structure", "Manhattan rotation, points and lines, local bundle adjustment", kStructure, kLive),
      preset("paper", "the same without bundle adjustment, as published", make_engine<PaperPipeline>),
      preset("points", "Manhattan rotation from normals, points alone", kStructure, kLive),
      preset("lines", "Manhattan rotation, lines, and no points but those that start the map", kStructure,
             kLive),
      preset("features", "no Manhattan world: points and lines, six degrees of freedom",
             make_engine<FeaturesPipeline>),
      preset("odometry", "frame to frame, no refinement against the local map",
             make_engine<OdometryPipeline>),
  };
  all[2].use_lines = false;
  all[3].new_points = false;
  all[4].use_normals = false;
  return all;
}

std::vector<Preset>& registered() {
  static std::vector<Preset> all = shipped();
  return all;
}

auto position_of(std::string_view name) {
  return std::find_if(registered().begin(), registered().end(),
                      [name](const Preset& preset) { return preset.name == name; });
}

}  // namespace

const std::vector<Preset>& all_presets() {
  return registered();
}

void add_preset(Preset preset) {
  const auto at = position_of(preset.name);
  if (at != registered().end())
    *at = std::move(preset);
  else
    registered().push_back(std::move(preset));
}

const Preset& find_preset(std::string_view name) {
  if (const auto at = position_of(name); at != registered().end()) return *at;
  std::string known;
  for (const Preset& preset : registered()) known += (known.empty() ? "" : ", ") + preset.name;
  throw Error(std::string(name) + ": no such preset; use one of " + known);
}

}  // namespace sslam
