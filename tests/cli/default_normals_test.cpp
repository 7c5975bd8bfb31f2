// SPDX-License-Identifier: BSD-3-Clause
// Which source of normals a run takes when nobody names one.
#include "cli/input/default_normals.hpp"

#include <vector>

#include "support/catch.hpp"
#include "support/scratch_folder.hpp"

namespace default_normals_test {

using namespace sslam;

TEST_CASE("The network on demand is the default where it is installed and of use") {
  CHECK(cli::default_normals("model.json", true).source == "on-demand");
  CHECK(cli::default_normals("model.json", true).note.empty());
  CHECK(cli::default_normals("model.json", false).source == "none");
  CHECK(cli::default_normals("model.json", false).note.empty());
}

TEST_CASE("Without the network lines alone are the default, with one line that says so") {
  const cli::DefaultNormals chosen = cli::default_normals(std::nullopt, true);
  CHECK(chosen.source == "none");
  CHECK(chosen.note.find("not installed: the axes come from lines alone") != std::string::npos);
  CHECK(chosen.note.find('\n') == std::string::npos);
  CHECK(cli::default_normals(std::nullopt, false).note.empty());
}

TEST_CASE("A manifest without its model is no model") {
  const testing::ScratchFolder scratch;
  const auto lonely = scratch.write("a/m.json"), whole = scratch.write("b/m.json");
  scratch.write("b/m.onnx");
  const std::vector<std::filesystem::path> places{scratch.path() / "none.json", lonely, whole};
  CHECK(cli::first_model(places) == whole);
  CHECK_FALSE(cli::first_model(std::vector<std::filesystem::path>{lonely}));
}

}  // namespace default_normals_test
