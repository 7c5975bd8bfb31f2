// SPDX-License-Identifier: BSD-3-Clause
// A map in a file, to go on in it later. Little-endian: "SSLAMMAP", the version, the length of what follows,
// its checksum (FNV-1a, 64 bit), and then the fields of map_fields.hpp.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include "sslam/io/files/output_file.hpp"
#include "sslam/io/files/text.hpp"
#include "sslam/io/maps/checksum.hpp"
#include "sslam/io/maps/map_check.hpp"
#include "sslam/io/maps/map_fields.hpp"

namespace sslam::io {

namespace map_file_detail {

inline constexpr std::string_view kMagic = "SSLAMMAP";
inline constexpr std::uint32_t kVersion = 2;

struct Header {
  std::uint32_t version = kVersion;
  std::uint64_t size = 0, checksum = 0;

  template <class Archive>
  void fields(Archive& archive) {
    archive(version);
    archive(size);
    archive(checksum);
  }
};

}  // namespace map_file_detail

// Throws Error when it cannot be written.
inline void save_map(const std::filesystem::path& path, const Map<double>& map) {
  namespace detail = map_file_detail;
  ByteWriter payload;
  MapFields(payload).walk(const_cast<Map<double>&>(map));  // a writer only reads
  detail::Header header;
  header.size = payload.bytes.size();
  header.checksum = checksum(payload.bytes);
  ByteWriter head;
  header.fields(head);
  OutputFile file(path);
  file.stream() << detail::kMagic << head.bytes << payload.bytes;
  file.commit();
}

// Throws Error when the file is missing, no map, of another version, cut off, or damaged.
[[nodiscard]] inline Map<double> load_map(const std::filesystem::path& path) {
  namespace detail = map_file_detail;
  std::ifstream in(path, std::ios::binary);
  if (!in || std::filesystem::is_directory(path)) throw Error(path.string() + ": cannot read this map");
  std::string magic(detail::kMagic.size(), '\0');
  in.read(magic.data(), static_cast<std::streamsize>(magic.size()));
  if (magic != detail::kMagic)
    throw Error(path.string() + ": is no map; expected a map.sslam that `sslam run` has written");
  constexpr std::size_t kLargest = std::size_t{1} << 36;  // more than a map in memory can have
  const std::string bytes = read_rest(in, path, kLargest);
  try {
    ByteReader head{bytes};
    detail::Header header;
    header.fields(head);
    if (header.version != detail::kVersion)
      throw Error("has version " + std::to_string(header.version) + "; this sslam reads version " +
                  std::to_string(detail::kVersion));
    if (head.left().size() != header.size)
      throw Error("holds " + std::to_string(head.left().size()) + " bytes of map where " +
                  std::to_string(header.size) + " belong: cut off, or written to since");
    if (checksum(head.left()) != header.checksum) throw Error("is damaged: its checksum is wrong");
    ByteReader payload{head.left()};
    Map<double> map;
    MapFields(payload).walk(map);
    check_map(map);
    map.collect_free_ids();
    return map;
  } catch (const Error& error) {
    throw Error(path.string() + ": " + error.what());
  }
}

}  // namespace sslam::io
