// SPDX-License-Identifier: BSD-3-Clause
#include "cli/fetch/unpack.hpp"

#include <archive.h>
#include <archive_entry.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <string>

#include "cli/shell/exit_code.hpp"
#include "cli/shell/interrupt.hpp"
#include "sslam/io/files/output_file.hpp"

namespace sslam::cli {
namespace {

namespace fs = std::filesystem;
using Archive = std::unique_ptr<archive, int (*)(archive*)>;

// libarchive does not look at gzip's checksum, zlib does: so zlib reads, and libarchive takes the tar apart.
struct GzipReader {
  gzFile file;
  std::array<char, 1 << 16> buffer{};

  explicit GzipReader(const fs::path& path) : file(gzopen(path.c_str(), "rb")) {
    if (file == nullptr) throw Error(path.string() + ": cannot open");
  }
  GzipReader(const GzipReader&) = delete;
  GzipReader& operator=(const GzipReader&) = delete;
  ~GzipReader() { gzclose(file); }

  // Bytes in the buffer; 0 at the end, less where the file is damaged.
  [[nodiscard]] int next() { return gzread(file, buffer.data(), static_cast<unsigned>(buffer.size())); }
};

la_ssize_t next_block(archive* reader, void* context, const void** block) {
  auto& gzip = *static_cast<GzipReader*>(context);
  *block = gzip.buffer.data();
  const int count = gzip.next();
  int code = Z_OK;
  if (count < 0) archive_set_error(reader, ARCHIVE_FATAL, "%s", gzerror(gzip.file, &code));
  return count;
}

[[noreturn]] void fail(const fs::path& file, archive* reader) {
  const char* const why = archive_error_string(reader);
  throw BadArchive(file.string() + ": is damaged (" + (why != nullptr ? why : "cannot be read") + ")");
}

// Below the folder; empty for the folder itself.
fs::path place_of(const fs::path& file, const fs::path& entry, const std::string& name) {
  const fs::path plain = entry.lexically_normal();
  const bool outside = plain.is_absolute() || std::find(plain.begin(), plain.end(), "..") != plain.end();
  if (outside)
    throw BadArchive(file.string() + ": holds '" + entry.string() + "', which leads out of its folder");
  fs::path rest;
  bool first = true;
  for (const fs::path& part : plain) {
    if (!(first && part == name) && part != ".") rest /= part;
    first = false;
  }
  return rest;
}

// `room`: bytes that all files of the archive together may still take.
void write_entry(const fs::path& file, archive* reader, const fs::path& target, std::uintmax_t& room) {
  std::array<char, 1 << 16> buffer;
  std::error_code error;
  fs::create_directories(target.parent_path(), error);
  if (error == std::errc::not_a_directory || error == std::errc::file_exists || fs::is_directory(target))
    throw BadArchive(file.string() + ": holds '" + target.filename().string() +
                     "' both as a file and as a folder");
  if (error) throw Error(target.parent_path().string() + ": cannot write: " + error.message());
  io::OutputFile out(target);
  la_ssize_t count = 0;
  while ((count = archive_read_data(reader, buffer.data(), buffer.size())) > 0) {
    if (static_cast<std::uintmax_t>(count) > room)
      throw BadArchive(file.string() +
                       ": unpacks to more than a hundred times its size; expected images and lists");
    room -= static_cast<std::uintmax_t>(count);
    out.stream().write(buffer.data(), count);
  }
  if (count < 0) fail(file, reader);
  out.commit();
}

}  // namespace

void unpack(const fs::path& file, const fs::path& folder, const std::string& name) {
  const Archive reader(archive_read_new(), archive_read_free);
  archive_read_support_format_tar(reader.get());
  GzipReader gzip(file);
  if (archive_read_open(reader.get(), &gzip, nullptr, next_block, nullptr) != ARCHIVE_OK)
    fail(file, reader.get());
  const Interrupt interrupt;
  constexpr std::uintmax_t kLeast = 1U << 20U,
                           kMostTimes = 100;  // images hardly pack, lists by a factor of ten
  std::uintmax_t room = std::max(kLeast, fs::file_size(file)) * kMostTimes;
  archive_entry* entry = nullptr;
  int code = ARCHIVE_OK;
  while ((code = archive_read_next_header(reader.get(), &entry)) == ARCHIVE_OK || code == ARCHIVE_WARN) {
    if (Interrupt::asked()) throw Stop{ExitCode::kInterrupted};
    const char* const path = archive_entry_pathname(entry);
    if (path == nullptr) throw BadArchive(file.string() + ": holds a file whose name cannot be read");
    const fs::path rest = place_of(file, path, name);
    // No sequence has links, and a link could lead elsewhere.
    if (archive_entry_filetype(entry) == AE_IFREG && !rest.empty())
      write_entry(file, reader.get(), folder / rest, room);
  }
  if (code != ARCHIVE_EOF) fail(file, reader.get());
  // The checksum stands at the very end, behind the tar's own.
  int rest = 0;
  while ((rest = gzip.next()) > 0) continue;
  if (rest < 0) throw BadArchive(file.string() + ": is damaged (" + gzerror(gzip.file, &rest) + ")");
}

}  // namespace sslam::cli
