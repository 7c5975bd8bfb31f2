// SPDX-License-Identifier: BSD-3-Clause
// The focal length that a camera or a phone wrote into its JPEG (Exif 2.3, the tags of its photo directory).
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "sslam/io/files/text.hpp"

namespace sslam::cli {

// Numbers of a TIFF block, in the byte order that it names; 0 beyond its end.
class TiffBlock {
 public:
  explicit TiffBlock(std::string_view bytes) : bytes_(bytes), big_(bytes.starts_with("MM")) {}

  [[nodiscard]] std::uint32_t number(std::size_t at, std::size_t size) const noexcept {
    std::uint32_t value = 0;
    if (at > bytes_.size() || bytes_.size() - at < size) return 0;
    for (std::size_t i = 0; i < size; ++i) {
      const auto byte = static_cast<unsigned char>(bytes_[at + (big_ ? i : size - 1 - i)]);
      value = value << 8U | byte;
    }
    return value;
  }

  // Where the value of a tag stands in the directory at `directory`; 0: it has none.
  [[nodiscard]] std::size_t find(std::size_t directory, std::uint32_t tag) const noexcept {
    const std::uint32_t entries = number(directory, 2);
    for (std::uint32_t i = 0; directory != 0 && i < entries; ++i) {
      const std::size_t entry = directory + 2 + std::size_t{12} * i;
      if (number(entry, 2) == tag) return entry + 8;
    }
    return 0;
  }

 private:
  std::string_view bytes_;
  bool big_;
};

// FocalLengthIn35mmFilm in pixels of an image of this size; 0 where the file does not say it, or what no lens
// has. Such lengths compare diagonals, and that of the film is 43.27 mm.
[[nodiscard]] inline double exif_focal(const std::filesystem::path& jpeg, int width, int height) {
  constexpr std::size_t kHead = 1U << 17U;  // the block stands first, and has 64 KiB at most
  constexpr std::uint32_t kPhotoDirectory = 0x8769, kFilmFocal = 0xA405;
  const std::string head = io::first_bytes(jpeg, kHead);
  const std::size_t mark = head.find(std::string_view("Exif\0\0", 6));
  if (!head.starts_with("\xff\xd8") || mark == std::string::npos) return 0;
  const TiffBlock tiff(std::string_view(head).substr(mark + 6));
  const std::size_t photo = tiff.find(tiff.number(4, 4), kPhotoDirectory);
  if (photo == 0) return 0;
  const std::size_t focal = tiff.find(tiff.number(photo, 4), kFilmFocal);
  if (focal == 0) return 0;
  constexpr double kFilmDiagonal = 43.267, kLeast = 5, kMost = 1000;  // millimetres
  const double film = tiff.number(focal, 2);
  return film < kLeast || film > kMost ? 0 : film / kFilmDiagonal * std::hypot(width, height);
}

}  // namespace sslam::cli
