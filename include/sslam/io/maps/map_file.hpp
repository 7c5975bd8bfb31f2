// SPDX-License-Identifier: BSD-3-Clause
// A map in a file, to go on in it later: a sealed file of the fields of map_fields.hpp.
#pragma once

#include <filesystem>
#include <string>

#include "sslam/io/maps/map_check.hpp"
#include "sslam/io/maps/map_fields.hpp"
#include "sslam/io/maps/sealed_file.hpp"

namespace sslam::io {

inline constexpr SealedKind kMapFile{"SSLAMMAP", 2, "map", "a map.sslam that `sslam run` has written"};

// The map that an archive holds next. Throws Error when it contradicts itself.
[[nodiscard]] inline Map<double> read_map(ByteReader& archive) {
  Map<double> map;
  MapFields(archive).walk(map);
  check_map(map);
  map.collect_free_ids();
  return map;
}

// Throws Error when it cannot be written.
inline void save_map(const std::filesystem::path& path, const Map<double>& map) {
  ByteWriter payload;
  MapFields(payload).walk(const_cast<Map<double>&>(map));  // a writer only reads
  write_sealed(path, kMapFile, payload.bytes);
}

// Throws Error when the file is missing, no map, of another version, cut off, or damaged.
[[nodiscard]] inline Map<double> load_map(const std::filesystem::path& path) {
  const std::string bytes = read_sealed(path, kMapFile);
  try {
    ByteReader payload{bytes};
    return read_map(payload);
  } catch (const Error& error) {
    throw Error(path.string() + ": " + error.what());
  }
}

}  // namespace sslam::io
