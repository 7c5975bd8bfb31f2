// SPDX-License-Identifier: BSD-3-Clause
#include "cli/input/chunk_codec.hpp"

#include <archive.h>
#include <archive_entry.h>
#include <zlib.h>

#include <algorithm>
#include <memory>

#include "sslam/core/error.hpp"

namespace sslam::cli {
namespace {

using Archive = std::unique_ptr<archive, int (*)(archive*)>;

int filter_of(io::Packing packing) {
  if (packing == io::Packing::kLz4) return ARCHIVE_FILTER_LZ4;
  return packing == io::Packing::kZstd ? ARCHIVE_FILTER_ZSTD : ARCHIVE_FILTER_BZIP2;
}

// `out` grows with what comes, not with what was claimed.
bool unpack(io::Packing packing, std::string_view packed, std::size_t size, std::string& out) {
  out.clear();
  if (size == 0) return true;
  const Archive reader(archive_read_new(), archive_read_free);
  archive_entry* entry = nullptr;
  if (archive_read_append_filter(reader.get(), filter_of(packing)) != ARCHIVE_OK ||
      archive_read_support_format_raw(reader.get()) != ARCHIVE_OK ||
      archive_read_open_memory(reader.get(), packed.data(), packed.size()) != ARCHIVE_OK ||
      archive_read_next_header(reader.get(), &entry) != ARCHIVE_OK)
    return false;
  constexpr std::size_t kStep = std::size_t{1} << 20;
  while (out.size() <= size) {
    const std::size_t before = out.size(), room = std::min(kStep, size - before + 1);
    out.resize(before + room);
    const la_ssize_t count = archive_read_data(reader.get(), out.data() + before, room);
    out.resize(before + static_cast<std::size_t>(std::max<la_ssize_t>(count, 0)));
    if (count < 0) return false;
    if (count == 0) break;
  }
  return out.size() == size;
}

la_ssize_t append(archive*, void* target, const void* bytes, std::size_t size) {
  static_cast<std::string*>(target)->append(static_cast<const char*>(bytes), size);
  return static_cast<la_ssize_t>(size);
}

std::string pack(io::Packing packing, std::string_view bytes) {
  std::string packed;
  if (packing == io::Packing::kNone || bytes.empty()) return std::string(bytes);
  const Archive writer(archive_write_new(), archive_write_free);
  const std::unique_ptr<archive_entry, void (*)(archive_entry*)> entry(archive_entry_new(),
                                                                       archive_entry_free);
  archive_entry_set_filetype(entry.get(), AE_IFREG);
  archive_entry_set_pathname(entry.get(), "chunk");
  const bool done =
      archive_write_add_filter(writer.get(), filter_of(packing)) == ARCHIVE_OK &&
      archive_write_set_format_raw(writer.get()) == ARCHIVE_OK &&
      archive_write_set_bytes_in_last_block(writer.get(), 1) == ARCHIVE_OK &&
      archive_write_open(writer.get(), &packed, nullptr, append, nullptr) == ARCHIVE_OK &&
      archive_write_header(writer.get(), entry.get()) == ARCHIVE_OK &&
      archive_write_data(writer.get(), bytes.data(), bytes.size()) == static_cast<la_ssize_t>(bytes.size()) &&
      archive_write_close(writer.get()) == ARCHIVE_OK;
  if (!done) throw Error("libarchive cannot pack here: " + std::string(archive_error_string(writer.get())));
  return packed;
}

std::uint32_t crc(std::string_view bytes) {
  return static_cast<std::uint32_t>(crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

}  // namespace

const io::ChunkCodec& chunk_codec() {
  static constexpr io::ChunkCodec kCodec{unpack, pack, crc};
  return kCodec;
}

}  // namespace sslam::cli
