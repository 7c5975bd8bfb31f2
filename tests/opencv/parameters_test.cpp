// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/opencv/parameters.hpp"

#include <string_view>

#include "sslam/opencv/normals/depth_normals.hpp"
#include "sslam/opencv/normals/file_normals.hpp"
#include "sslam/opencv/normals/onnx_normals.hpp"
#include "support/catch.hpp"

namespace {

using namespace sslam;

void require_sound(const ParameterTable& table) {
  for (const Parameter& parameter : table.entries()) {
    INFO(parameter.name);
    REQUIRE(parameter.meaning.size() > 3);
    REQUIRE(parameter.initial >= parameter.least);
    REQUIRE(parameter.initial <= parameter.most);
    if (parameter.unit == Unit::kShare) REQUIRE(parameter.most <= 1);
  }
}

TEST_CASE("the parameters of a front end are those of its points, lines and source of normals") {
  const ImageFrontend<DepthNormals> frontend;
  ParameterTable table;
  collect_frontend_parameters(frontend, table);
  require_sound(table);
  REQUIRE(table.check().ok());
  REQUIRE(table.find("points.points")->initial == 1200);
  REQUIRE(table.find("lines.detector.max_angle")->initial == 22.5);
  REQUIRE(table.find("normals.mask.max_angle")->initial == 8);
  ParameterTable without;
  collect_frontend_parameters(ImageFrontend<NoNormals>(), without);
  REQUIRE(without.find("normals.mask.max_angle") == nullptr);
}

TEST_CASE("what is set reaches the extractors of a front end") {
  ImageFrontend<DepthNormals> frontend;
  ParameterTable table;
  collect_frontend_parameters(frontend, table);
  REQUIRE(table.set("points.points", 800).ok());
  REQUIRE(table.set("lines.merge.max_gap", 20).ok());
  REQUIRE(table.set("normals.max_depth", 5).ok());
  write_frontend_parameters(table, frontend);
  REQUIRE(frontend.points.options.points == 800);
  REQUIRE(frontend.lines.options.merge.max_gap == 20);
  REQUIRE(frontend.normals.options.max_depth == 5);
}

TEST_CASE("the parameters of every source of normals are within their ranges") {
  const FileNormalsOptions files;
  const OnnxNormalsOptions network;
  ParameterTable table;
  table.collect([&](auto& visit) {
    visit_within("files.", files, visit);
    visit_within("onnx.", network, visit);
  });
  require_sound(table);
  REQUIRE(table.find("onnx.evidence.agree_angle")->initial == 15);
}

}  // namespace
