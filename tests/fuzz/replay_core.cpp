// SPDX-License-Identifier: BSD-3-Clause
// Fuzz targets of the readers that need no other library.
#include "fuzz/replay.hpp"
#include "support/catch.hpp"
#include "support/map_scene.hpp"
#include "support/scratch_folder.hpp"

// Each target under a name of its own.
#define LLVMFuzzerTestOneInput fuzz_lists
#include "fuzz/lists_fuzz.cpp"
#undef LLVMFuzzerTestOneInput
#define LLVMFuzzerTestOneInput fuzz_map_file
#include "fuzz/map_file_fuzz.cpp"
#undef LLVMFuzzerTestOneInput
#define LLVMFuzzerTestOneInput fuzz_whole_map
#define LLVMFuzzerCustomMutator mutate_whole_map
#include "fuzz/whole_map_fuzz.cpp"
#undef LLVMFuzzerCustomMutator
#undef LLVMFuzzerTestOneInput
#define LLVMFuzzerTestOneInput fuzz_truth
#define LLVMFuzzerCustomMutator seed_of_truth
#include "fuzz/truth_fuzz.cpp"
#undef LLVMFuzzerCustomMutator
#undef LLVMFuzzerTestOneInput
#define LLVMFuzzerTestOneInput fuzz_layout
#define LLVMFuzzerCustomMutator seed_of_layout
#include "fuzz/layout_fuzz.cpp"
#undef LLVMFuzzerCustomMutator
#undef LLVMFuzzerTestOneInput

namespace {

using namespace sslam;
using fuzzing::replay;

Map<double> small_map() {
  testing::MapSceneOptions options;
  options.points = 12;
  options.lines = 4;
  std::vector<SE3<double>> path;
  for (int k = 0; k < 3; ++k) path.push_back(testing::look({0.3 * k, 0, -2}, 0.05 * k, 0));
  return testing::MapScene(options, path).make_map();
}

}  // namespace

TEST_CASE("lists of poses and tables that are spoilt") {
  replay(fuzz_lists,
         {"# stamp tx ty tz qx qy qz qw\n0.0 0 0 0 0 0 0 1\n0.1 1e3 -2 0.5 0 0 0.7071 0.7071\n",
          "stamp,name,value\n0.1,\"a, \"\"b\"\"\",nan\r\n0.2,,1e999\n",
          "\xef\xbb\xbf"
          "1;2;3;4;5;6;7;8\n",
          "\xff\xfe"
          "1\0",
          "1 nan 0 0 0 0 0 1\n1 inf 0 0 0 0 0 0\n"},
         4000);
}

TEST_CASE("fields of a map that are spoilt") {
  Map<double> map = small_map();
  io::ByteWriter writer;
  io::MapFields(writer).walk(map);
  replay(fuzz_map_file, {writer.bytes}, 4000);
}

TEST_CASE("map files that are spoilt") {
  const testing::ScratchFolder scratch;
  io::save_map(scratch.path() / "map", small_map());
  const std::string file = testing::text_of(scratch.path() / "map");
  replay(fuzz_whole_map, {file, file.substr(0, file.size() / 2), std::string(fuzzing::kSealedHead, '\0')},
         2000, mutate_whole_map);
}

TEST_CASE("files of poses that are spoilt") {
  replay(fuzz_truth, truth_fuzz::seeds(), 3000);
}

TEST_CASE("folders of datasets that are spoilt") {
  replay(fuzz_layout, layout_fuzz::seeds(), 1500);
}
