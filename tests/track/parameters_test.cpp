// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/track/parameters.hpp"

#include <set>

#include "sslam/track/presets.hpp"
#include "support/catch.hpp"

namespace {

using namespace sslam;

template <class Pipeline>
ParameterTable table_of(const Pipeline& pipeline) {
  ParameterTable table;
  collect_parameters(pipeline, table);
  return table;
}

TEST_CASE("every parameter has a name of its own, a meaning, and a default within its range") {
  const presets::Structure<double> pipeline;
  std::set<std::string> names;
  visit_parameters(pipeline, [&](const char* name, const auto&, Unit, double, double, const char* meaning) {
    INFO(name);
    REQUIRE(names.insert(name).second);
    REQUIRE(std::string_view(meaning).size() > 3);
  });
  const ParameterTable table = table_of(pipeline);
  REQUIRE(table.entries().size() == names.size());
  for (const Parameter& parameter : table.entries()) {
    INFO(parameter.name);
    REQUIRE(parameter.least < parameter.most);
    REQUIRE(parameter.initial >= parameter.least);
    REQUIRE(parameter.initial <= parameter.most);
    if (parameter.unit == Unit::kShare) REQUIRE(parameter.most <= 1);
    if (parameter.unit == Unit::kCount) REQUIRE(parameter.whole);
  }
  REQUIRE(table.check().ok());
}

TEST_CASE("the names that users have had stay") {
  const presets::Structure<double> pipeline;
  const ParameterTable table = table_of(pipeline);
  for (const char* name : {"rotation.squareness",
                           "rotation.max_sigma",
                           "rotation.frames",
                           "rotation.told_apart",
                           "rotation.agreement",
                           "rotation.confirmations",
                           "rotation.min_normal_share",
                           "rotation.widest_kernel",
                           "rotation.narrowest_kernel",
                           "initialisation.min_points",
                           "initialisation.min_matches",
                           "initialisation.min_parallax",
                           "initialisation.max_direction_sigma",
                           "initialisation.search_radius",
                           "translation.point_radius",
                           "translation.line_radius",
                           "translation.min_inliers",
                           "translation.min_inlier_share",
                           "fallback.point_radius",
                           "fallback.line_radius",
                           "fallback.widening",
                           "fallback.min_inliers",
                           "fallback.min_inlier_share",
                           "refinement.point_radius",
                           "refinement.line_radius",
                           "refinement.max_keyframes",
                           "refinement.min_inliers",
                           "refinement.min_inliers_turned",
                           "refinement.min_inlier_share",
                           "refinement.max_position_sigma",
                           "refinement.max_rotation_sigma",
                           "motion.horizon",
                           "keyframes.min_shared",
                           "keyframes.max_baseline",
                           "keyframes.max_turn",
                           "keyframes.min_gap",
                           "mapping.min_point_parallax",
                           "mapping.min_line_parallax",
                           "mapping.max_neighbours",
                           "mapping.probation",
                           "mapping.redundant_share",
                           "planes.min_members",
                           "planes.tolerance",
                           "planes.max_sigma",
                           "planes.min_spread",
                           "planes.min_contrast",
                           "planes.max_turn",
                           "planes.few_landmarks",
                           "planes.flatness",
                           "atlas.leave_after",
                           "atlas.most",
                           "loops.candidates",
                           "loops.min_inliers",
                           "loops.max_turn",
                           "loops.max_scale_drift"}) {
    INFO(name);
    REQUIRE(table.find(name) != nullptr);
  }
}

TEST_CASE("a null stage has no parameters") {
  const ParameterTable table = table_of(presets::Features<double>());
  REQUIRE(table.find("rotation.squareness") == nullptr);
  REQUIRE(table.find("translation.point_radius") == nullptr);
  REQUIRE(table.find("fallback.point_radius") != nullptr);
  REQUIRE(table_of(presets::Paper<double>()).find("planes.flatness") == nullptr);
}

TEST_CASE("what is set reaches the options of its stage and no other") {
  presets::Structure<double> pipeline;
  ParameterTable table = table_of(pipeline);
  REQUIRE(table.set("fallback.point_radius", 60).ok());
  REQUIRE(table.set("keyframes.max_turn", 8).ok());
  write_parameters(table, pipeline);
  REQUIRE(pipeline.fallback.options.match.point_radius == 60);
  REQUIRE(pipeline.translation.options.match.point_radius == 20);
  REQUIRE(pipeline.keyframes.options.max_turn == radians(8.0));
}

struct OwnRotation : NoRotation<double> {
  struct Options {
    double drift = 0.5;

    template <class Self, class Visit>
    static void parameters(Self& self, Visit&& visit) {
      visit("drift", self.drift, Unit::kDegrees, 0, 10, "of the gyroscope in a minute");
    }
  } options;
};

TEST_CASE("a user's own stage with described options is reached by its slot") {
  struct {
    OwnRotation rotation;
  } pipeline;
  ParameterTable table;
  table.collect([&](auto& visit) { visit_stage("rotation.", pipeline.rotation, visit); });
  REQUIRE(table.entries().size() == 1);
  REQUIRE(table.find("rotation.drift") != nullptr);
}

}  // namespace
