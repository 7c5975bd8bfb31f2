// SPDX-License-Identifier: BSD-3-Clause
// Videos whose names do not say that they are: told by the first bytes of their container.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>

#include "sslam/io/files/files.hpp"
#include "sslam/io/files/text.hpp"

namespace sslam::io {

// MP4 and MOV, Matroska and WebM, AVI, Ogg, FLV, GIF, ASF, MXF, NUT, Y4M, MPEG and bare H.264 and H.265.
[[nodiscard]] inline bool starts_as_video(std::string_view bytes) {
  using namespace std::string_view_literals;
  using Start = std::pair<std::size_t, std::string_view>;  // the place, and what stands there
  constexpr std::array kStarts{Start{4, "ftyp"sv},
                               Start{4, "moov"sv},
                               Start{4, "wide"sv},
                               Start{0, "\x1A\x45\xDF\xA3"sv},
                               Start{8, "AVI "sv},
                               Start{0, "OggS"sv},
                               Start{0, "FLV\1"sv},
                               Start{0, "GIF8"sv},
                               Start{0, "\x30\x26\xB2\x75"sv},
                               Start{0, "\6\x0E\x2B\x34"sv},
                               Start{0, "nut/multimedia"sv},
                               Start{0, "YUV4MPEG2 "sv},
                               Start{0, "\0\0\1\xBA"sv},
                               Start{0, "\0\0\1\xB3"sv},
                               Start{0, "\0\0\0\1\x67"sv},
                               Start{0, "\0\0\0\1\x27"sv},
                               Start{0, "\0\0\0\1\x09"sv},
                               Start{0, "\0\0\0\1\x40\1"sv}};
  const auto stands = [bytes](std::size_t at, std::string_view what) {
    return bytes.size() >= at + what.size() && bytes.substr(at, what.size()) == what;
  };
  // Of the same family as MP4.
  for (const std::string_view still : {"ftypheic"sv, "ftypmif1"sv, "ftypavif"sv, "ftypM4A"sv})
    if (stands(4, still)) return false;
  for (const auto& [at, what] : kStarts)
    if (stands(at, what)) return true;
  constexpr std::size_t kPacket = 188;  // of MPEG-TS
  return stands(0, "G"sv) && stands(kPacket, "G"sv) && stands(2 * kPacket, "G"sv);
}

// A list of other files, such as those of HLS, DASH and FFmpeg: whoever follows it waits for files that it
// promises to name later.
[[nodiscard]] inline bool starts_as_playlist(std::string_view bytes) {
  return bytes.starts_with("#EXTM3U") || bytes.starts_with("ffconcat version") ||
         bytes.find("<MPD") != std::string_view::npos;
}

// By its name or by its content, whatever else the name says.
[[nodiscard]] inline bool is_video_file(const std::filesystem::path& file) {
  if (is_video_name(file)) return true;
  return starts_as_video(first_bytes(file));
}

}  // namespace sslam::io
