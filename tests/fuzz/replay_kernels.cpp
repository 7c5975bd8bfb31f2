// SPDX-License-Identifier: BSD-3-Clause
// Fuzz targets of the kernels.
#include <cstring>

#include "fuzz/replay.hpp"
#include "sslam/core/random.hpp"
#include "support/catch.hpp"

// Each target under a name of its own.
#define LLVMFuzzerTestOneInput fuzz_bundle
#include "fuzz/bundle_fuzz.cpp"
#undef LLVMFuzzerTestOneInput
#define LLVMFuzzerTestOneInput fuzz_pose_graph
#include "fuzz/pose_graph_fuzz.cpp"
#undef LLVMFuzzerTestOneInput
#define LLVMFuzzerTestOneInput fuzz_manhattan_search
#include "fuzz/manhattan_search_fuzz.cpp"
#undef LLVMFuzzerTestOneInput
#define LLVMFuzzerTestOneInput fuzz_manhattan
#include "fuzz/manhattan_fuzz.cpp"
#undef LLVMFuzzerTestOneInput
#define LLVMFuzzerTestOneInput fuzz_pose
#include "fuzz/pose_fuzz.cpp"
#undef LLVMFuzzerTestOneInput
#define LLVMFuzzerTestOneInput fuzz_triangulation
#include "fuzz/triangulation_fuzz.cpp"
#undef LLVMFuzzerTestOneInput
#define LLVMFuzzerTestOneInput fuzz_two_view
#include "fuzz/two_view_fuzz.cpp"
#undef LLVMFuzzerTestOneInput

namespace {

using namespace sslam;
using fuzzing::replay;

// Spoilings of a scene, as spoilt_numbers.hpp reads them: a number at a place.
std::string at(std::size_t place, double number) {
  const auto low = static_cast<std::uint16_t>(place);
  std::string bytes(1 + sizeof low + sizeof number, 'A');
  std::memcpy(bytes.data() + 1, &low, sizeof low);
  std::memcpy(bytes.data() + 1 + sizeof low, &number, sizeof number);
  return bytes;
}

}  // namespace

TEST_CASE("a bundle adjustment of spoilt numbers") {
  replay(fuzz_bundle, fuzzing::random_bytes(50, 100), 600);
}

TEST_CASE("a pose graph of spoilt numbers") {
  replay(fuzz_pose_graph, fuzzing::random_bytes(50, 100), 1000);
}

TEST_CASE("a first Manhattan frame from spoilt votes") {
  replay(fuzz_manhattan_search, fuzzing::random_bytes(50, 200), 300);
}

TEST_CASE("a Manhattan rotation from spoilt votes") {
  replay(fuzz_manhattan, fuzzing::random_bytes(50, 200), 2000);
}

TEST_CASE("a camera's pose from spoilt landmarks") {
  replay(fuzz_pose, fuzzing::random_bytes(50, 200), 2000);
}

TEST_CASE("points and lines from spoilt views") {
  replay(fuzz_triangulation, fuzzing::random_bytes(50, 200), 4000);
}

TEST_CASE("a relative pose from spoilt matches") {
  std::vector<std::string> inputs = fuzzing::random_bytes(50, 200);
  // Found: errors so large that the information's inverse overflows.
  std::string vague{1, 8};
  for (std::size_t match = 0; match < 8; ++match) vague += at(7 * match + 6, 1e153);
  inputs.push_back(vague);
  replay(fuzz_two_view, inputs, 1500);
}
