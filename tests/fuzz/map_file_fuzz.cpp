// SPDX-License-Identifier: BSD-3-Clause
// The fields of a map file. A checksum stands before them in the file; here they come without, since no
// fuzzer guesses it. What is taken must be of use: it is written and read again.
#include "fuzz/fuzz_input.hpp"
#include "fuzz/worked_map.hpp"
#include "sslam/io/maps/map_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace sslam;
  Map<double> map;
  try {
    io::ByteReader reader{std::string_view(reinterpret_cast<const char*>(data), size)};
    io::MapFields(reader).walk(map);
    io::check_map(map);
  } catch (const Error&) {
    return 0;
  }
  map.collect_free_ids();
  for (std::size_t k = 0; k < map.keyframes.size(); ++k)
    if (!map.pose(static_cast<KeyframeId>(k)).translation.allFinite()) std::abort();
  io::ByteWriter written;
  io::MapFields(written).walk(map);
  io::ByteReader again{written.bytes};
  Map<double> same;
  io::MapFields(again).walk(same);
  io::check_map(same);
  fuzzing::take_apart(map);
  return 0;
}
