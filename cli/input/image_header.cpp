// SPDX-License-Identifier: BSD-3-Clause
#include "cli/input/image_header.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string_view>

namespace sslam::cli {
namespace {

// Reads numbers at a place; 0 beyond the end, which no format takes for a good value.
class ByteReader {
 public:
  ByteReader(Bytes bytes, bool big_endian) : bytes_(bytes), big_endian_(big_endian) {}

  [[nodiscard]] std::uint32_t number(std::size_t at, int size) const {
    std::uint32_t value = 0;
    for (int i = 0; i < size; ++i) {
      const std::size_t place = at + static_cast<std::size_t>(big_endian_ ? i : size - 1 - i);
      value = value << 8 | (place < bytes_.size() ? bytes_[place] : 0U);
    }
    return value;
  }
  [[nodiscard]] std::size_t size() const noexcept { return bytes_.size(); }

 private:
  Bytes bytes_;
  bool big_endian_;
};

bool says(Bytes bytes, std::size_t at, std::string_view text) {
  return bytes.size() >= at + text.size() &&
         std::equal(text.begin(), text.end(), bytes.begin() + static_cast<std::ptrdiff_t>(at),
                    [](char a, std::uint8_t b) { return static_cast<std::uint8_t>(a) == b; });
}

cv::Size size_of(std::uint32_t width, std::uint32_t height) {
  constexpr std::uint32_t kMost = 1U << 30;  // more is no size, and would not fit
  if (width == 0 || height == 0 || width > kMost || height > kMost) return {};
  return {static_cast<int>(width), static_cast<int>(height)};
}

// Whether a page is there that is neither a preview nor a mask of another.
bool is_page(const ByteReader& reader, std::size_t directory) {
  constexpr std::uint32_t kPreview = 1, kMask = 4;
  if (directory == 0 || directory + 2 > reader.size()) return false;
  const std::uint32_t entries = reader.number(directory, 2);
  for (std::uint32_t i = 0; i < entries && directory + 2 + 12 * (i + 1) <= reader.size(); ++i) {
    const std::size_t at = directory + 2 + std::size_t{12} * i;
    if (reader.number(at, 2) == 0xfe && (reader.number(at + 8, 4) & (kPreview | kMask)) != 0) return false;
  }
  return entries > 0;
}

// TIFF's first directory, which EXIF is made of as well.
void read_tiff(Bytes bytes, ImageHeader& header, bool with_size) {
  const bool big = says(bytes, 0, "MM");
  const ByteReader reader(bytes, big);
  const std::size_t directory = reader.number(4, 4);
  const std::uint32_t entries = reader.number(directory, 2);
  std::uint32_t width = 0, height = 0;
  for (std::uint32_t i = 0; i < entries && directory + 2 + 12 * (i + 1) <= bytes.size(); ++i) {
    const std::size_t at = directory + 2 + std::size_t{12} * i;
    const bool is_short = reader.number(at + 2, 2) == 3;
    const std::uint32_t tag = reader.number(at, 2), value = reader.number(at + 8, is_short ? 2 : 4);
    if (tag == 0x100) width = value;
    if (tag == 0x101) height = value;
    if (tag == 0x112 && value >= 1 && value <= 8) header.turn = static_cast<ImageTurn>(value);
  }
  if (!with_size) return;
  header.size = size_of(width, height);
  header.several = is_page(reader, reader.number(directory + 2 + std::size_t{12} * entries, 4));
}

bool is_tiff(Bytes bytes) {
  using namespace std::string_view_literals;
  return says(bytes, 0, "II*\0"sv) || says(bytes, 0, "MM\0*"sv);
}

// The next marker behind entropy-coded data, where 0xff 0x00 and restart marks belong to the data.
std::size_t end_of_scan(Bytes bytes, std::size_t at) {
  for (;; ++at) {
    at = static_cast<std::size_t>(
        std::find(bytes.begin() + static_cast<std::ptrdiff_t>(std::min(at, bytes.size())), bytes.end(),
                  0xff) -
        bytes.begin());
    if (at + 1 >= bytes.size()) return bytes.size();
    const std::uint8_t code = bytes[at + 1];
    if (code != 0 && code != 0xff && (code < 0xd0 || code > 0xd7)) return at;
  }
}

void read_jpeg(Bytes bytes, ImageHeader& header) {
  constexpr std::uint8_t kStart = 0xd8, kEnd = 0xd9, kScan = 0xda, kApp1 = 0xe1;
  const ByteReader reader(bytes, true);
  header.complete = false;
  bool scanned = false;
  std::size_t at = 2;
  while (at + 2 <= bytes.size()) {
    const std::uint8_t code = bytes[at + 1];
    if (bytes[at] != 0xff) {  // stray bytes between segments: decoders pass over them
      ++at;
      continue;
    }
    if (code == kEnd) {
      header.complete = true;
      header.end = at + 2;
      return;
    }
    if (code == kStart && scanned) {  // of the next image in a stream: this one has lost its end
      header.end = at;
      return;
    }
    if (code == 0xff || code == 0 || code == 1 || (code >= 0xd0 && code <= 0xd8)) {  // padding, or no length
      at += code == 0xff ? 1 : 2;
      continue;
    }
    const std::size_t length = reader.number(at + 2, 2);
    const bool frame = code >= 0xc0 && code <= 0xcf && code != 0xc4 && code != 0xc8 && code != 0xcc;
    if (frame && header.size.empty())
      header.size = size_of(reader.number(at + 7, 2), reader.number(at + 5, 2));
    constexpr std::size_t kExif = 6;  // "Exif", and two zeros
    if (code == kApp1 && says(bytes, at + 4, "Exif") && length > 2 + kExif && at + 2 + length <= bytes.size())
      read_tiff(bytes.subspan(at + 4 + kExif, length - 2 - kExif), header, false);
    at += 2 + std::max<std::size_t>(length, 2);
    if (code == kScan) {
      scanned = true;
      at = end_of_scan(bytes, at);
    }
  }
}

void read_png(Bytes bytes, ImageHeader& header) {
  const ByteReader reader(bytes, true);
  header.size = size_of(reader.number(16, 4), reader.number(20, 4));
  header.complete = false;
  for (std::size_t at = 8; at + 12 <= bytes.size();) {
    const std::size_t length = reader.number(at, 4);
    if (says(bytes, at + 4, "eXIf") && length < bytes.size() - at - 8)
      read_tiff(bytes.subspan(at + 8, length), header, false);
    if (says(bytes, at + 4, "acTL")) header.several = reader.number(at + 8, 4) > 1;
    if (says(bytes, at + 4, "IEND")) {
      header.complete = true;
      header.end = at + 12;
      return;
    }
    at += 12 + length;
  }
}

void read_webp(Bytes bytes, ImageHeader& header) {
  const ByteReader reader(bytes, false);
  constexpr std::size_t kShortest = 20;  // the head, and that of one chunk
  const std::size_t end = std::max(std::size_t{reader.number(4, 4)} + 8, kShortest);
  header.complete = bytes.size() >= end;
  if (header.complete) header.end = end;
  if (says(bytes, 12, "VP8X")) {
    constexpr std::uint32_t kAnimation = 2;
    header.several = (reader.number(20, 1) & kAnimation) != 0;
    header.size = size_of(reader.number(24, 3) + 1, reader.number(27, 3) + 1);
  } else if (says(bytes, 12, "VP8L")) {
    const std::uint32_t bits = reader.number(21, 4);
    header.size = size_of((bits & 0x3fff) + 1, (bits >> 14 & 0x3fff) + 1);
  } else if (says(bytes, 12, "VP8 ")) {
    header.size = size_of(reader.number(26, 2) & 0x3fff, reader.number(28, 2) & 0x3fff);
  }
  for (std::size_t at = 12; at + 8 <= bytes.size();) {
    const std::size_t length = reader.number(at + 4, 4);
    if (says(bytes, at, "EXIF") && length <= bytes.size() - at - 8) {
      Bytes exif = bytes.subspan(at + 8, length);
      if (says(exif, 0, "Exif") && exif.size() > 6) exif = exif.subspan(6);
      read_tiff(exif, header, false);
    }
    at += 8 + length + length % 2;
  }
}

void read_bmp(Bytes bytes, ImageHeader& header) {
  const ByteReader reader(bytes, false);
  const auto height = static_cast<std::int32_t>(reader.number(22, 4));  // negative: rows from the top
  header.size = size_of(reader.number(18, 4), height < 0 ? 0U - static_cast<std::uint32_t>(height)
                                                         : static_cast<std::uint32_t>(height));
  const std::uint32_t end = reader.number(2, 4);  // some programs leave it 0
  if (end > 54 && end <= bytes.size()) header.end = end;
}

// Binary PGM and PPM: "P6", width, height and largest value in decimal digits, with comments in between; then
// one blank and the pixels.
void read_pnm(Bytes bytes, ImageHeader& header) {
  constexpr std::uint32_t kMost = 1U << 30;
  std::array<std::uint32_t, 3> numbers{};
  std::size_t at = 2;
  const auto is_digit = [&] { return at < bytes.size() && bytes[at] >= '0' && bytes[at] <= '9'; };
  const auto is_blank = [&] {
    return at < bytes.size() && (bytes[at] == ' ' || (bytes[at] >= '\t' && bytes[at] <= '\r'));
  };
  header.complete = false;
  for (std::uint32_t& number : numbers) {
    while (is_blank() || (at < bytes.size() && bytes[at] == '#')) {
      const bool comment = bytes[at] == '#';
      while (comment && at < bytes.size() && bytes[at] != '\n') ++at;
      ++at;
    }
    if (!is_digit()) return;
    for (; is_digit(); ++at) number = std::min(number * 10 + (bytes[at] - std::uint32_t{'0'}), kMost / 16);
  }
  header.size = size_of(numbers[0], numbers[1]);
  const std::size_t samples = std::size_t{numbers[0]} * numbers[1] * (bytes[1] == '6' ? 3 : 1);
  const std::size_t end = at + 1 + samples * (numbers[2] > 255 ? 2 : 1);
  header.complete = is_blank() && end <= bytes.size();
  if (header.complete) header.end = end;
}

bool is_pnm(Bytes bytes) {
  const bool named = says(bytes, 0, "P5") || says(bytes, 0, "P6");
  return named && bytes.size() > 2 &&
         (bytes[2] == '#' || bytes[2] == ' ' || (bytes[2] >= '\t' && bytes[2] <= '\r'));
}

}  // namespace

ImageHeader read_image_header(Bytes bytes) {
  ImageHeader header;
  if (says(bytes, 0, "\xff\xd8\xff")) {
    header.format = ImageFormat::kJpeg;
    read_jpeg(bytes, header);
  } else if (says(bytes, 0, "\x89PNG\r\n\x1a\n")) {
    header.format = ImageFormat::kPng;
    read_png(bytes, header);
  } else if (says(bytes, 0, "RIFF") && says(bytes, 8, "WEBP")) {
    header.format = ImageFormat::kWebp;
    read_webp(bytes, header);
  } else if (is_tiff(bytes)) {
    header.format = ImageFormat::kTiff;
    read_tiff(bytes, header, true);
  } else if (says(bytes, 0, "BM")) {
    header.format = ImageFormat::kBmp;
    read_bmp(bytes, header);
  } else if (is_pnm(bytes)) {
    header.format = ImageFormat::kPnm;
    read_pnm(bytes, header);
  } else if (says(bytes, 4, "ftyphei") || says(bytes, 4, "ftypmif") || says(bytes, 4, "ftypavi")) {
    header.format = ImageFormat::kHeif;
  }
  return header;
}

}  // namespace sslam::cli
