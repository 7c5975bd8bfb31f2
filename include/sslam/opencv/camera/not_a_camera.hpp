// SPDX-License-Identifier: BSD-3-Clause
// Files that are given as camera files and are of another kind: told by what stands first in them.
#pragma once

#include <cctype>
#include <string>
#include <string_view>

namespace sslam {
namespace detail {

// What a file is that is no text of a calibration, and the way out; empty: nothing is known about it.
[[nodiscard]] inline std::string not_a_camera(std::string_view text) {
  using namespace std::string_view_literals;
  const auto starts = [text](std::string_view with) { return text.starts_with(with); };
  constexpr std::string_view kWriteText =
      "; write its numbers as text, such as a row 'fx fy cx cy k1 k2 p1 p2 k3'";
  if (starts("PK\3\4")) return "is an archive (.zip or NumPy's .npz)" + std::string(kWriteText);
  if (starts("\x93NUMPY")) return "is an array of NumPy (.npy)" + std::string(kWriteText);
  if (starts("\x80\2"sv) || starts("\x80\3"sv) || starts("\x80\4"sv) || starts("\x80\5"sv))
    return "is pickled by Python" + std::string(kWriteText);
  if (starts("MATLAB 5.0") || starts("\x89HDF")) return "is of MATLAB or HDF5" + std::string(kWriteText);
  if (starts("\xff\xd8\xff") || starts("\x89PNG") || starts("II*\0"sv) || starts("MM\0*"sv) || starts("BM"))
    if (text.find('\0') != std::string_view::npos) return "is an image; expected a camera file in plain text";
  if (starts("version https://git-lfs"))
    return "is a pointer of Git LFS in place of the file; fetch it with git lfs pull";
  if (starts("{\\rtf")) return "is a document (RTF); expected a camera file in plain text";
  std::string head;
  for (const char c : text.substr(0, 512))
    head += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  if (head.find("<!doctype html") != std::string::npos || head.find("<html") != std::string::npos)
    return "is a web page; expected the camera file that it links to";
  return {};
}

}  // namespace detail
}  // namespace sslam
