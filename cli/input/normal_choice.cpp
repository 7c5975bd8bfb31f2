// SPDX-License-Identifier: BSD-3-Clause
#include "cli/input/normal_choice.hpp"

#include <filesystem>
#include <utility>

#include "cli/input/shipped_model.hpp"
#include "cli/shell/exit_code.hpp"
#include "sslam/core/error.hpp"
#include "sslam/io/files/text.hpp"

namespace sslam::cli {
namespace {

namespace fs = std::filesystem;

// Without an encoding.txt beside the images: that of the normals published with the paper's code.
FileNormals open_files(const fs::path& folder) {
  FileNormals files;
  files.options.folder = folder;
  std::error_code ignored;
  if (!fs::is_directory(folder, ignored)) {
    throw Error("--normals files:" + folder.string() +
                ": no such folder; expected one with an image of normals for each frame");
  }
  const fs::path encoding = folder / "encoding.txt";
  if (fs::exists(encoding, ignored) && !parse_normal_encoding(io::read_text(encoding), files.options)) {
    throw Error(encoding.string() +
                ": expected one axis for each channel, such as 'r=+x g=+y b=+z', "
                "and at most 'plane_sigma_deg=4.7' after them");
  }
  return files;
}

}  // namespace

std::string source_of_normals(const std::string& text) {
  const std::string prefix = std::string(kOnDemand) + ":";
  if (text == kOnDemand) return "onnx";
  return text.starts_with(prefix) ? text.substr(prefix.size()) : text;
}

NormalChoice choose_normals(const std::string& text) {
  if (const std::string source = source_of_normals(text); source != text) {
    NormalChoice choice = choose_normals(source);
    choice.on_demand = true;
    return choice;
  }
  constexpr std::string_view kFiles = "files:", kOnnx = "onnx:";
  if (text == "none") return {NoNormals{}};
  if (text == "depth") return {DepthNormals{}};
  if (text == "onnx") return {OnnxNormals(shipped_model("name one with --normals onnx:FILE"))};
  if (text.starts_with(kFiles)) return {open_files(text.substr(kFiles.size()))};
  if (text.starts_with(kOnnx)) return {OnnxNormals(text.substr(kOnnx.size()))};
  throw UsageError("--normals " + text +
                   ": not known; use on-demand, none, depth, files:DIR, onnx, onnx:FILE or on-demand:SOURCE");
}

}  // namespace sslam::cli
