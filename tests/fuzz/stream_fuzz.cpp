// SPDX-License-Identifier: BSD-3-Clause
// Images that follow each other in a pipe, in pieces of any size: what is cut out begins as an image, in the
// order in which it came, and nothing comes twice.
#include "cli/stream/image_splitter.hpp"
#include "fuzz/seeds.hpp"
#include "fuzz/spoilt_numbers.hpp"

namespace stream_fuzz {

using namespace std::string_literals;

inline const std::vector<std::string>& seeds() {
  static const std::string kJpeg =
      "\xff\xd8\xff\xc0\0\x0b\x08\0\x18\0\x28\x01\x01\x11\0\xff\xda\0\x08\x01\x01\0\0\x3f\0\x12\x34\xff\0\x56\xff\xd9"s;
  static const std::string kPng =
      "\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\0\x28\0\0\0\x18\x08\x02\0\0\0abcd\0\0\0\0IEND\xae\x42\x60\x82"s;
  static const std::vector<std::string> kSeeds{
      "\x07"s + kJpeg + kJpeg + kPng, "\x40"s + kPng + "between" + kJpeg,
      "\x20P5\n4 2\n255\nabcdefghP6 2 1 255\nabcdef"s, "\x20"s + "RIFF\x0c\0\0\0WEBPVP8 abcd"s + kJpeg,
      "\x20"s + "BM\x3a\0\0\0\0\0\0\0\x36\0\0\0\x28\0\0\0\x01\0\0\0\x01\0\0\0\x01\0\x18\0"s +
          std::string(28, 'x') + kPng};
  return kSeeds;
}

}  // namespace stream_fuzz

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most,
                                               unsigned seed) {
  return sslam::fuzzing::mutate_or_begin(stream_fuzz::seeds(), data, size, most, seed);
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace sslam;
  if (size == 0) return 0;
  const std::size_t piece = 1 + data[0];
  const cli::Bytes all(data + 1, size - 1);
  cli::ImageSplitter splitter;
  std::size_t at = 0;  // behind the images so far
  for (std::size_t given = 0; given < all.size(); given += piece) {
    splitter.add(all.subspan(given, std::min(piece, all.size() - given)));
    while (const auto image = splitter.next()) {
      fuzzing::demand(!image->empty() && cli::begins_image(*image));
      const auto found =
          std::search(all.begin() + static_cast<std::ptrdiff_t>(at), all.end(), image->begin(), image->end());
      fuzzing::demand(found != all.end());
      at = static_cast<std::size_t>(found - all.begin()) + image->size();
    }
  }
  return 0;
}
