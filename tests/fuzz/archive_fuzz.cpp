// SPDX-License-Identifier: BSD-3-Clause
// Archives as `sslam fetch` unpacks them. A fuzzer guesses neither gzip's checksums nor tar's: those of the
// headers are mended, and all is packed here, unless the first byte says otherwise.
#include <zlib.h>

#include <array>
#include <cstdio>

#include "cli/fetch/unpack.hpp"
#include "fuzz/made_folder.hpp"
#include "fuzz/seeds.hpp"

namespace archive_fuzz {

using namespace sslam;

inline constexpr std::size_t kBlock = 512, kSizeAt = 124, kSumAt = 148, kSumSize = 8, kTypeAt = 156;

inline std::string padded(std::string text, std::size_t size) {
  text.resize(size);
  return text;
}

// One entry as POSIX has it; `type`: '0' a file, '1' and '2' links, '5' a folder, 'x' and 'L' what the next
// entry is.
inline std::string tar_entry(const std::string& name, char type, const std::string& content,
                             const std::string& link = "") {
  char size[16];
  std::snprintf(size, sizeof size, "%011zo", content.size());
  std::string head = padded(name, 100) + padded("0000644", 8) + padded("0000000", 8) + padded("0000000", 8) +
                     padded(size, 12) + padded("00000000000", 12) + padded("", kSumSize) + type +
                     padded(link, 100) +
                     std::string(
                         "ustar\0"
                         "00",
                         8);
  return padded(head, kBlock) + padded(content, (content.size() + kBlock - 1) / kBlock * kBlock);
}

inline void mend_sums(std::string& tar) {
  for (std::size_t at = 0; at + kBlock <= tar.size();) {
    tar.replace(at + kSumAt, kSumSize, kSumSize, ' ');
    unsigned sum = 0;
    for (std::size_t i = at; i < at + kBlock; ++i) sum += static_cast<unsigned char>(tar[i]);
    char text[16];
    std::snprintf(text, sizeof text, "%06o", sum);
    tar.replace(at + kSumAt, 7, text, 7);
    const std::size_t size = std::strtoull(tar.substr(at + kSizeAt, 11).c_str(), nullptr, 8);
    if (size > tar.size()) return;
    at += kBlock + (size + kBlock - 1) / kBlock * kBlock;
  }
}

inline std::string gzipped(const std::string& bytes) {
  z_stream stream{};
  constexpr int kGzip = 16 + MAX_WBITS;
  deflateInit2(&stream, Z_BEST_SPEED, Z_DEFLATED, kGzip, MAX_MEM_LEVEL, Z_DEFAULT_STRATEGY);
  std::string packed(deflateBound(&stream, bytes.size()), '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(packed.data());
  stream.avail_out = static_cast<uInt>(packed.size());
  deflate(&stream, Z_FINISH);
  packed.resize(stream.total_out);
  deflateEnd(&stream);
  return packed;
}

inline const std::vector<std::string>& seeds() {
  const std::string end(2 * kBlock, '\0');
  static const std::vector<std::string> kSeeds{
      '\0' + tar_entry("room/", '5', "") + tar_entry("room/rgb.txt", '0', "0 a.png\n") +
          tar_entry("room/rgb/a.png", '0', "png") + end,
      '\0' + tar_entry("PaxHeader", 'x', "25 path=room/\xc3\xa9\xff/b.txt\n14 size=4\n") +
          tar_entry("room/b", '0', "text") + end,
      '\0' + tar_entry("././@LongLink", 'L', std::string("room/" + std::string(200, 'n'))) +
          tar_entry("room/c", '0', "text") + end,
      '\0' + tar_entry("room/d", '2', "", "/etc/passwd") + tar_entry("room/d/e", '0', "text") +
          tar_entry("room/f", '1', "", "room/d") + end,
      '\0' + tar_entry("room/g", '0', "text") + tar_entry("room/g/h", '0', "text") +
          tar_entry("room", '0', "text") + end,
      '\0' + tar_entry("../out", '0', "text") + end,
      '\0' + tar_entry("/abs", '0', "text") + end,
      '\1' + gzipped(tar_entry("room/i", '0', "text") + end)};
  return kSeeds;
}

}  // namespace archive_fuzz

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most,
                                               unsigned seed) {
  return sslam::fuzzing::mutate_or_begin(archive_fuzz::seeds(), data, size, most, seed);
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace archive_fuzz;
  namespace fs = std::filesystem;
  if (size == 0) return 0;
  std::string bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
  if ((data[0] & 2) == 0) mend_sums(bytes);
  const fs::path folder = fuzzing::empty_folder(), file = folder / "a.tar.gz",
                 inside = folder / "in" / "side";
  fs::create_directories(inside);
  fuzzing::write_bytes(file, (data[0] & 1) == 0 ? gzipped(bytes) : bytes);
  fuzzing::expect_message([&] { cli::unpack(file, inside, "room"); });
  // Nothing beside the folder, and in it files and folders alone.
  std::size_t beside = 0;
  for (const fs::path& parent : {folder, folder / "in"})
    for (const auto& entry : fs::directory_iterator(parent)) beside += entry.path().empty() ? 0 : 1;
  if (beside != 3) std::abort();
  for (const auto& entry : fs::recursive_directory_iterator(inside))
    if (entry.is_symlink() || !(entry.is_directory() || entry.is_regular_file())) std::abort();
  return 0;
}
