// SPDX-License-Identifier: BSD-3-Clause
#include "cli/input/normal_choice.hpp"

#include <filesystem>
#include <utility>

#include "cli/input/shipped_model.hpp"
#include "sslam/io/files/error.hpp"
#include "sslam/io/files/text.hpp"
#include "sslam/opencv/normals/normal_picture.hpp"

namespace sslam::cli {
namespace {

namespace fs = std::filesystem;

// Without an encoding.txt beside the images: that of the normals published with the paper's code.
FileNormals open_files(const fs::path& folder) {
  FileNormals files;
  files.options.folder = folder;
  std::error_code ignored;
  if (!fs::is_directory(folder, ignored)) {
    throw io::Error("--normals files:" + folder.string() +
                    ": no such folder; it wants one with an image of normals for each frame");
  }
  const fs::path encoding = folder / "encoding.txt";
  if (fs::exists(encoding, ignored) && !parse_normal_encoding(io::read_text(encoding), files.options)) {
    throw io::Error(encoding.string() +
                    ": expected one axis for each channel, such as 'r=+x g=+y b=+z', "
                    "and at most 'plane_sigma_deg=4.7' after them");
  }
  return files;
}

}  // namespace

cv::Mat NormalChoice::small_picture() const {
  constexpr int kColumns = 128;
  if (const auto* network = std::get_if<OnnxNormals>(&source)) {
    if (network->manifest().kind != NetworkOutput::kNormals)
      return small_normal_picture(network->depth().grid());
    const double min_planar = network->options.evidence.min_planar;
    return small_normal_picture(sample_normals(network->dense(), min_planar, kColumns));
  }
  if (const auto* depth = std::get_if<DepthNormals>(&source)) return small_normal_picture(depth->grid());
  if (const auto* files = std::get_if<FileNormals>(&source)) return small_normal_picture(files->grid());
  return {};
}

void collect_normal_parameters(ParameterTable& table) {
  const DepthNormalsOptions depth;
  const FileNormalsOptions files;
  const OnnxNormalsOptions network;
  table.collect([&](auto& visit) {
    visit_within("normals.depth.", depth, visit);
    visit_within("normals.files.", files, visit);
    visit_within("normals.onnx.", network, visit);
  });
}

NormalChoice choose_normals(const std::string& text) {
  constexpr std::string_view kFiles = "files:", kOnnx = "onnx:";
  if (text == "none") return {NoNormals{}};
  if (text == "depth") return {DepthNormals{}};
  if (text == "onnx") return {OnnxNormals(shipped_model("name one with --normals onnx:FILE"))};
  if (text.starts_with(kFiles)) return {open_files(text.substr(kFiles.size()))};
  if (text.starts_with(kOnnx)) return {OnnxNormals(text.substr(kOnnx.size()))};
  throw io::Error("--normals " + text + ": not known; use none, depth, files:DIR, onnx or onnx:FILE");
}

}  // namespace sslam::cli
