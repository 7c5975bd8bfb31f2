// SPDX-License-Identifier: BSD-3-Clause
// Files of a run's results that hold bytes: views, colours of a map, the textured model. The first byte says
// which.
#include "cli/results/map_colours.hpp"
#include "cli/results/textured_mesh.hpp"
#include "cli/results/view_file.hpp"
#include "fuzz/fuzz_input.hpp"
#include "fuzz/seeds.hpp"

namespace result_files_fuzz {

using namespace sslam;
using namespace std::string_literals;

inline std::string word(std::size_t value) {
  const auto number = static_cast<std::uint32_t>(value);
  return {reinterpret_cast<const char*>(&number), sizeof number};
}

// One triangle.
inline std::string small_glb(std::string json) {
  json.resize((json.size() + 3) / 4 * 4, ' ');
  const std::string binary(96 + 12 + 8, '\0');
  return "glTF" + word(2) + word(12 + 8 + json.size() + 8 + binary.size()) + word(json.size()) + "JSON" +
         json + word(binary.size()) + "BIN\0"s + binary;
}

inline const std::vector<std::string>& seeds() {
  static const std::vector<std::string> kSeeds{
      "\0SSLAMVW1\3\0\0\0abc\0\0\0\0\1\0\0\0d"s, "\1SSLAMCO1\2\0\0\0\1\xff\x80\1\0\0\0\0\1\0\0\0\1\1\2\3"s,
      "\2" +
          small_glb(
              R"({"meshes":[{"primitives":[{"attributes":{"POSITION":0,"NORMAL":1,"TEXCOORD_0":2},"indices":3}]}],
          "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"},{"bufferView":1,"componentType":5126,"count":3,"type":"VEC3"},
          {"bufferView":2,"componentType":5126,"count":3,"type":"VEC2"},{"bufferView":3,"componentType":5125,"count":3,"type":"SCALAR"}],
          "bufferViews":[{"byteOffset":0,"byteLength":36},{"byteOffset":36,"byteLength":36},{"byteOffset":72,"byteLength":24},
          {"byteOffset":96,"byteLength":12},{"byteOffset":108,"byteLength":8}],"images":[{"bufferView":4}]})")};
  return kSeeds;
}

inline void read_one(unsigned which, const std::filesystem::path& path) {
  if (which == 0) {
    io::Warnings warnings;
    (void)cli::read_views(path, warnings);
  } else if (which == 1) {
    Map<double> map;
    map.points.resize(2);
    map.lines.resize(1);
    (void)cli::read_colours(path, map);
  } else {
    const cli::TexturedMesh mesh = cli::read_glb(path);
    for (const std::uint32_t index : mesh.indices)
      if (index >= mesh.places.size() || !mesh.places[index].allFinite()) std::abort();
  }
}

}  // namespace result_files_fuzz

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most,
                                               unsigned seed) {
  return sslam::fuzzing::mutate_or_begin(result_files_fuzz::seeds(), data, size, most, seed);
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  return sslam::fuzzing::read_as_file(
      data + 1, size - 1, [&](const auto& path) { result_files_fuzz::read_one(data[0] % 3, path); });
}
