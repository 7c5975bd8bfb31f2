// SPDX-License-Identifier: BSD-3-Clause
// Map files as they lie on the disk. A mutator of our own mends length and checksum, which no fuzzer guesses.
#include <algorithm>

#include "fuzz/fuzz_input.hpp"
#include "sslam/io/maps/map_file.hpp"

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most);

namespace {

constexpr std::size_t kHead = 8 + 4 + 8 + 8;

std::size_t mend(std::uint8_t* data, std::size_t size) {
  const std::string_view fields(reinterpret_cast<const char*>(data) + kHead, size - kHead);
  const std::string start = sslam::io::sealed_head(sslam::io::kMapFile, fields);
  std::copy(start.begin(), start.end(), data);
  return size;
}

}  // namespace

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most,
                                               unsigned int seed) {
  size = LLVMFuzzerMutate(data, size, most);
  if (size < kHead && kHead <= most) {
    std::fill(data + size, data + kHead, std::uint8_t{0});
    size = kHead;
  }
  return seed % 16 == 0 || size < kHead ? size : mend(data, size);
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return sslam::fuzzing::read_as_file(data, size, [](const std::filesystem::path& path) {
    const sslam::Map<double> map = sslam::io::load_map(path);
    for (std::size_t k = 0; k < map.keyframes.size(); ++k)
      if (!map.pose(static_cast<sslam::KeyframeId>(k)).translation.allFinite()) std::abort();
    sslam::io::save_map(path, map);
    (void)sslam::io::load_map(path);
  });
}
