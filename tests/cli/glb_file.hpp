// SPDX-License-Identifier: BSD-3-Clause
// Binary glTF read back by the rules of its specification.
#pragma once

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "support/catch.hpp"
#include "support/scratch_folder.hpp"

namespace sslam::testing {

inline std::uint32_t word_at(const std::string& bytes, std::size_t at) {
  std::uint32_t word = 0;
  std::memcpy(&word, bytes.data() + at, sizeof word);
  return word;
}

struct Glb {
  nlohmann::json json;
  std::string binary;
};

// Of glTF 2.0's container: a head, a chunk of JSON, a chunk of bytes.
inline Glb read_glb(const std::filesystem::path& file) {
  const std::string bytes = text_of(file);
  REQUIRE(bytes.size() > 20);
  REQUIRE(bytes.substr(0, 4) == "glTF");
  REQUIRE(word_at(bytes, 4) == 2);
  REQUIRE(word_at(bytes, 8) == bytes.size());
  const std::size_t json_size = word_at(bytes, 12);
  REQUIRE(bytes.substr(16, 4) == "JSON");
  REQUIRE(json_size % 4 == 0);
  const std::size_t second = 20 + json_size;
  REQUIRE(word_at(bytes, second) == bytes.size() - second - 8);
  REQUIRE(bytes.substr(second + 4, 4) == std::string("BIN\0", 4));
  return {nlohmann::json::parse(bytes.substr(20, json_size)), bytes.substr(second + 8)};
}

inline std::string part(const Glb& glb, std::size_t view) {
  const auto& v = glb.json["bufferViews"][view];
  return glb.binary.substr(v["byteOffset"], v["byteLength"]);
}

}  // namespace sslam::testing
