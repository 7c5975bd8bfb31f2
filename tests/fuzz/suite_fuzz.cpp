// SPDX-License-Identifier: BSD-3-Clause
// Suites of `sslam batch`.
#include "cli/batch/suite.hpp"

#include "fuzz/fuzz_input.hpp"
#include "fuzz/seeds.hpp"

namespace suite_fuzz {

inline const std::vector<std::string>& seeds() {
  static const std::vector<std::string> kSeeds{
      "name = 'a'\nout = 'b'\nseeds = [1, 2]\nstarts = [0, 10]\nmin_tracked = 0.5\nreport = "
      "true\n[[sequence]]\npath = 'room'\nend = 40\n"
      "truth = 't.txt'\n[[sequence]]\nname = 'x'\npath = 'r2'\nstart = 3\nfov = 60\n[[method]]\nname = "
      "'m'\npreset = 'structure'\nnormals = 'none'\n"
      "set = {keyframes.max_turn = [5, 10]}\nrepeats = 2\n[[reference]]\nname = "
      "'r'\n[reference.trajectories]\n",
      "[[sequence]]\npath = 'room'\ncamera = 'c.yaml'\nmask = 'm.png'\n[[method]]\nset = ['a.b=1']\nlive = "
      "true\n"};
  return kSeeds;
}

}  // namespace suite_fuzz

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most,
                                               unsigned seed) {
  return sslam::fuzzing::mutate_or_begin(suite_fuzz::seeds(), data, size, most, seed);
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return sslam::fuzzing::read_as_file(data, size, [](const std::filesystem::path& path) {
    sslam::fuzzing::expect_message([&] {
      const sslam::cli::Suite suite = sslam::cli::read_suite(path);
      if (suite.sequences.empty() || suite.methods.empty() ||
          !(suite.min_tracked >= 0 && suite.min_tracked <= 1))
        std::abort();
    });
  });
}
