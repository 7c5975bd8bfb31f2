// SPDX-License-Identifier: BSD-3-Clause
// Bad manifests and bad models: one line that names the file and the field.
#include <fstream>

#include "model_fixture.hpp"
#include "support/catch.hpp"

using namespace sslam;
using namespace sslam::test;

namespace {

std::string complaint(const std::filesystem::path& file) {
  try {
    const OnnxNormals source(file);
  } catch (const NormalModelError& error) {
    return error.what();
  }
  return "";
}

void check_complaint(const std::filesystem::path& file, const std::string& field) {
  const std::string text = complaint(file);
  INFO(text);
  CHECK(text.find(field) != std::string::npos);
  CHECK(text.find(file.parent_path().string()) != std::string::npos);
  CHECK(text.find('\n') == std::string::npos);
}

}  // namespace

TEST_CASE("a manifest is read", "[normals]") {
  const NormalManifest m = read_normal_manifest(fixtures() / "tiny_normals.json");
  CHECK(m.model == fixtures() / "tiny_normals.onnx");
  CHECK(m.input.width == 64);
  CHECK(m.input.height == 48);
  CHECK(m.input.rgb);
  CHECK(m.input.mean[2] == 127.5);
  CHECK(near(m.input.scale[0], 1 / 127.5));
  CHECK(m.input.focal == 0);
  CHECK(m.kind == NetworkOutput::kNormals);
  CHECK(m.output == "normal");
  CHECK(m.mask == "planar");
  CHECK(m.confidence == "confidence");
  CHECK(m.plane_sigma_deg == 5);  // unless the manifest says otherwise
  const testing::ScratchFolder folder;
  const auto unsealed =
      changed(folder, fixtures() / "tiny_normals.json", {{"\"format\"", "\"sha256\": \"\", \"format\""}});
  CHECK(read_normal_manifest(unsealed).sha256.empty());
}

TEST_CASE("a wrong field of a manifest is named", "[normals]") {
  const std::vector<std::pair<Changes, std::string>> cases{
      {{{"sslam-normals-1", "other"}}, "manifest.format"},
      {{{"\"tiny_normals.onnx\"", "\"absent.onnx\""}}, "manifest.model"},
      {{{"\"format\"", "\"sha256\": \"12ab\", \"format\""}}, "manifest.sha256"},
      {{{"\"format\"", "\"sha256\": \"" + std::string(64, '0') + "\", \"format\""}}, "is another model"},
      {{{"\"width\": 64", "\"width\": \"wide\""}}, "input.width"},
      {{{"\"height\": 48", "\"height\": 0"}}, "input.height"},
      {{{"\"rgb\"", "\"cmyk\""}}, "input.channels"},
      {{{"127.5", "1e999"}}, "input.mean: holds a number beyond 1e9"},
      {{{"\"mean\"", "\"means\""}}, "input.means"},
      {{{"127.5,", ""}}, "input.mean"},
      {{{"\"normals\"", "\"heights\""}}, "output.kind"},
      {{{"\"name\": \"normal\"", "\"name\": \"absent\""}}, "output.name"},
      {{{"\"name\": \"normal\"", "\"name\": \"planar\""}}, "output.name"},
      {{{"\"x\"", "\"y\""}}, "output.axes"},
      {{{"\"signs\": [\n      1", "\"signs\": [\n      2"}}, "output.signs"},
      {{{"\"mask\": \"planar\"", "\"mask\": \"absent\""}}, "output.mask"},
      {{{"\"mask\": \"planar\"", "\"mask\": \"raw\""}}, "output.mask"},
      {{{"\"confidence\": \"confidence\"", "\"confidence\": \"normal\""}}, "output.confidence"},
      {{{"\"confidence\": \"confidence\"", "\"range\": [1, 0]"}}, "output.range"},
      {{{"\"confidence\": \"confidence\"", "\"plane_sigma_deg\": -1"}}, "output.plane_sigma_deg"},
  };
  for (const auto& [changes, field] : cases) {
    const testing::ScratchFolder folder;
    check_complaint(changed(folder, fixtures() / "tiny_normals.json", changes), field);
  }
}

TEST_CASE("a file that is no manifest or no model is named", "[normals]") {
  const testing::ScratchFolder folder;
  folder.write("text.json", "{ not json");
  folder.write("empty.json", "");
  folder.write("junk.onnx", "no model at all");
  check_complaint(folder.path() / "absent.json", "no such manifest");
  check_complaint(folder.path() / "absent.onnx", "no such model");
  check_complaint(folder.path() / "text.json", "text.json");
  check_complaint(folder.path() / "empty.json", "empty.json");
  folder.write("deep.json", std::string(100000, '['));
  check_complaint(folder.path() / "deep.json", "deep.json: is nested too deeply");
  check_complaint(folder.path() / "junk.onnx", "junk.json: no such manifest");
  const auto junk =
      changed(folder, fixtures() / "tiny_normals.json", {{"\"tiny_normals.onnx\"", "\"junk.onnx\""}});
  check_complaint(junk, "junk.onnx: no ONNX model");
}

TEST_CASE("a model whose vectors are not unit is refused", "[normals]") {
  const testing::ScratchFolder folder;
  check_complaint(
      changed(folder, fixtures() / "tiny_normals.json", {{"\"name\": \"normal\"", "\"name\": \"raw\""}}),
      "output.name: 100 % of 'raw' is not finite or not of unit length");
}

TEST_CASE("a model whose mask or confidence is none is refused", "[normals]") {
  for (const std::string field : {"mask", "confidence"}) {
    const testing::ScratchFolder folder;
    const std::string output = field == "mask" ? "planar" : field;
    check_complaint(changed(folder, fixtures() / "tiny_normals.json",
                            {{"\"" + field + "\": \"" + output + "\"", "\"" + field + "\": \"depth\""}}),
                    "output." + field + ": ");
  }
}
