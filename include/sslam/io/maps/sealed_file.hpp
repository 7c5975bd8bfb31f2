// SPDX-License-Identifier: BSD-3-Clause
// Bytes in a file that tells when it is cut off or damaged. Little-endian: a word that says what it is, the
// version, the length of what follows, its checksum (FNV-1a, 64 bit), and then the bytes.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <string_view>

#include "sslam/io/files/output_file.hpp"
#include "sslam/io/files/pipe_text.hpp"
#include "sslam/io/files/text.hpp"
#include "sslam/io/maps/byte_archive.hpp"
#include "sslam/io/maps/checksum.hpp"

namespace sslam::io {

// What such a file is.
struct SealedKind {
  std::string_view magic;  // eight letters, the first of it
  std::uint32_t version;
  const char* name;      // for people
  const char* expected;  // where there is none: which file it would be
};

struct SealedHeader {
  std::uint32_t version = 0;
  std::uint64_t size = 0, checksum = 0;

  template <class Archive>
  void fields(Archive& archive) {
    archive(version);
    archive(size);
    archive(checksum);
  }
};

// All that stands before those bytes.
[[nodiscard]] inline std::string sealed_head(const SealedKind& kind, std::string_view bytes) {
  ByteWriter head;
  SealedHeader header{kind.version, bytes.size(), checksum(bytes)};
  header.fields(head);
  return std::string(kind.magic) + head.bytes;
}

// Throws Error when it cannot be written.
inline void write_sealed(const std::filesystem::path& path, const SealedKind& kind, std::string_view bytes) {
  OutputFile file(path);
  file.stream() << sealed_head(kind, bytes) << bytes;
  file.commit();
}

// The bytes. Throws Error when the file is missing, of another kind or version, cut off, or damaged.
[[nodiscard]] inline std::string read_sealed(const std::filesystem::path& path, const SealedKind& kind) {
  const std::string name = kind.name;
  constexpr std::size_t kLargest = std::size_t{1} << 36;  // more than a map in memory can have
  std::ifstream file;
  std::istringstream piped;
  const bool pipe = is_pipe(path);
  if (pipe)
    piped.str(read_pipe(path, kLargest));
  else
    file.open(path, std::ios::binary);
  if (!file || std::filesystem::is_directory(path)) throw Error(path.string() + ": cannot read this " + name);
  std::istream& in = pipe ? static_cast<std::istream&>(piped) : file;
  std::string magic(kind.magic.size(), '\0');
  in.read(magic.data(), static_cast<std::streamsize>(magic.size()));
  if (magic != kind.magic) throw Error(path.string() + ": is no " + name + "; expected " + kind.expected);
  std::string bytes = read_rest(in, path, kLargest);
  try {
    ByteReader head{bytes};
    SealedHeader header;
    header.fields(head);
    if (header.version != kind.version)
      throw Error("has version " + std::to_string(header.version) + "; this sslam reads version " +
                  std::to_string(kind.version));
    const std::string_view sealed = head.left();
    if (sealed.size() != header.size)
      throw Error("holds " + std::to_string(sealed.size()) + " bytes of " + name + " where " +
                  std::to_string(header.size) + " belong: cut off, or written to since");
    if (checksum(sealed) != header.checksum) throw Error("is damaged: its checksum is wrong");
    bytes.erase(0, bytes.size() - sealed.size());
    return bytes;
  } catch (const Error& error) {
    throw Error(path.string() + ": " + error.what());
  }
}

}  // namespace sslam::io
