// SPDX-License-Identifier: BSD-3-Clause
// Recordings in formats of their own that are not read: told by their extension, with the way to images.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <string_view>

#include "sslam/io/files/files.hpp"

namespace sslam::io {

// "is a recording of the ZED SDK; export it ..."; empty: nothing is known about it.
[[nodiscard]] inline std::string other_recording(const std::filesystem::path& file) {
  struct Kind {
    std::string_view extension, text;
  };
  constexpr std::array<Kind, 10> kKinds{
      {{".sens",
        "is a recording of ScanNet; extract it with ScanNet's SensReader to color/, depth/, pose/ and "
        "intrinsic/"},
       {".svo", "is a recording of the ZED SDK; export it with ZED's own tools as a video or images"},
       {".svo2", "is a recording of the ZED SDK; export it with ZED's own tools as a video or images"},
       {".r3d", "is a recording of Record3D; export it in Record3D as RGBD images, or as a video"},
       {".oni", "is a recording of OpenNI; export it as images"},
       {".klg", "is a recording of Kintinuous; export it as images"},
       {".aedat4", "is a recording of an event camera; export its frames as a video or images"},
       {".txt",
        "is a text, neither a folder nor a video; a list of images is read as rgb.txt in a folder, which is "
        "what to name"},
       {".csv",
        "is a table, neither a folder nor a video; a list of images is read as rgb.txt in a folder, which is "
        "what to name"},
       {".zip", "is an archive; unpack it, and name the folder"}}};
  const std::string own = lower_case(file.extension().string());
  for (const Kind& kind : kKinds)
    if (kind.extension == own) return std::string(kind.text);
  const std::string name = lower_case(file.filename().string());
  for (const std::string_view end : {".tar", ".tgz", ".tar.gz", ".tar.bz2", ".tar.xz", ".7z", ".gz"})
    if (name.ends_with(end)) return "is an archive; unpack it, and name the folder";
  return {};
}

}  // namespace sslam::io
