// SPDX-License-Identifier: BSD-3-Clause
#include "cli/normal_choice.hpp"

#include <filesystem>

#include "sslam/io/error.hpp"

namespace sslam::cli {

NormalChoice choose_normals(const std::string& text) {
  NormalChoice choice;
  if (text == "none") return choice;
  if (text == "depth") {
    choice.source = DepthNormals{};
    return choice;
  }
  constexpr std::string_view kFiles = "files:";
  if (text.starts_with(kFiles)) {
    FileNormals files;
    files.options.folder = text.substr(kFiles.size());
    std::error_code ignored;
    if (!std::filesystem::is_directory(files.options.folder, ignored))
      throw io::Error("--normals " + text +
                      ": no such folder; files:DIR wants a folder with one image of normals a frame");
    choice.source = std::move(files);
    return choice;
  }
  throw io::Error("--normals " + text + ": not known; use none, depth or files:DIR");
}

}  // namespace sslam::cli
