// SPDX-License-Identifier: BSD-3-Clause
// Map files as they lie on the disk, with a mended checksum. What is taken is worked on: keyframes and
// landmarks go.
#include "fuzz/fuzz_input.hpp"
#include "fuzz/sealed_input.hpp"
#include "fuzz/worked_map.hpp"
#include "sslam/io/maps/map_file.hpp"

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most,
                                               unsigned int seed) {
  return sslam::fuzzing::mutate_sealed(sslam::io::kMapFile, data, size, most, seed);
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return sslam::fuzzing::read_as_file(data, size, [](const std::filesystem::path& path) {
    sslam::Map<double> map = sslam::io::load_map(path);
    for (std::size_t k = 0; k < map.keyframes.size(); ++k)
      if (!map.pose(static_cast<sslam::KeyframeId>(k)).translation.allFinite()) std::abort();
    sslam::io::save_map(path, map);
    (void)sslam::io::load_map(path);
    sslam::fuzzing::take_apart(map);
  });
}
