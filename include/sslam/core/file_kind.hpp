// SPDX-License-Identifier: BSD-3-Clause
// Files that are given where text with numbers is expected, and are of another kind: told by what stands
// first in them.
#pragma once

#include <algorithm>
#include <array>
#include <cctype>
#include <string>
#include <string_view>
#include <utility>

namespace sslam {

// "is a web page"; empty: nothing is known about it.
[[nodiscard]] inline std::string file_kind(std::string_view text) {
  using namespace std::string_view_literals;
  using Kind = std::pair<std::string_view, std::string_view>;
  constexpr std::array kKinds{Kind{"PK\3\4"sv, "is an archive (.zip or NumPy's .npz)"},
                              Kind{"\x1f\x8b"sv, "is compressed (gzip); unpack it"},
                              Kind{"BZh"sv, "is compressed (bzip2); unpack it"},
                              Kind{"\xFD"
                                   "7zXZ"sv,
                                   "is compressed (xz); unpack it"},
                              Kind{"\x28\xB5\x2F\xFD"sv, "is compressed (zstd); unpack it"},
                              Kind{"7z\xBC\xAF"sv, "is an archive (.7z)"},
                              Kind{"\x93NUMPY"sv, "is an array of NumPy (.npy)"},
                              Kind{"\x80\2"sv, "is pickled by Python"},
                              Kind{"\x80\3"sv, "is pickled by Python"},
                              Kind{"\x80\4"sv, "is pickled by Python"},
                              Kind{"\x80\5"sv, "is pickled by Python"},
                              Kind{"MATLAB 5.0"sv, "is a file of MATLAB"},
                              Kind{"\x89HDF"sv, "is a file of HDF5 or MATLAB"},
                              Kind{"\xff\xd8\xff"sv, "is an image"},
                              Kind{"\x89PNG"sv, "is an image"},
                              Kind{"II*\0"sv, "is an image"},
                              Kind{"MM\0*"sv, "is an image"},
                              Kind{"%PDF"sv, "is a document (PDF)"},
                              Kind{"{\\rtf"sv, "is a document (RTF)"},
                              Kind{"version https://git-lfs"sv,
                                   "is a pointer of Git LFS in place of the file (git lfs pull fetches it)"}};
  for (const auto& [start, kind] : kKinds)
    if (text.starts_with(start)) return std::string(kind);
  std::string head(text.substr(0, 512));
  std::transform(head.begin(), head.end(), head.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (head.find("<!doctype html") != std::string::npos || head.find("<html") != std::string::npos)
    return "is a web page";
  return {};
}

}  // namespace sslam
