// SPDX-License-Identifier: BSD-3-Clause
// The surfaces of `--dense` in the report: those of model.glb, in the room that a page has for them.
#include <cstdint>
#include <filesystem>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

#include "cli/glb_file.hpp"
#include "cli/page_data.hpp"
#include "cli/report/base64.hpp"
#include "cli/report/surface_data.hpp"
#include "cli/room_copy.hpp"
#include "support/catch.hpp"

namespace surface_data_test {

namespace {

namespace fs = std::filesystem;
using namespace sslam::testing;
using sslam::cli::surface_data;
using sslam::cli::TexturedMesh;

// A square with noise on it, which no codec makes small.
TexturedMesh noisy_square(int side) {
  TexturedMesh mesh;
  mesh.places = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  mesh.normals.assign(4, {0, 0, 1});
  mesh.textures = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  mesh.indices = {0, 1, 2, 0, 2, 3};
  cv::Mat noise(side, side, CV_8UC3);
  cv::RNG(1).fill(noise, cv::RNG::UNIFORM, 0, 256);
  cv::imencode(".jpg", noise, mesh.jpeg, {cv::IMWRITE_JPEG_QUALITY, 95});
  return mesh;
}

cv::Mat texture_of(const nlohmann::ordered_json& data) {
  const std::string jpeg = from_base64(data["jpeg"].get<std::string>());
  return cv::imdecode(std::vector<unsigned char>(jpeg.begin(), jpeg.end()), cv::IMREAD_COLOR);
}

}  // namespace

TEST_CASE("a texture that fits into the page is left as it is, another is made to fit") {
  const TexturedMesh mesh = noisy_square(1500);
  REQUIRE(mesh.jpeg.size() > 2'000'000);
  std::string problem;
  const auto whole = surface_data(mesh, 8'000'000, problem);
  CHECK(from_base64(whole["jpeg"].get<std::string>()) == std::string(mesh.jpeg.begin(), mesh.jpeg.end()));
  CHECK(whole["share"] == 1);
  CHECK(whole["quality"] == 0);
  const auto compressed = surface_data(mesh, 2'700'000, problem);
  CHECK(compressed["share"] == 1);
  CHECK(compressed["quality"] == 80);
  CHECK(texture_of(compressed).size() == cv::Size(1500, 1500));
  const auto small = surface_data(mesh, 1'000'000, problem);
  CHECK(problem.empty());
  CHECK(small.dump().size() < 1'000'200);
  const double share = small["share"];
  CHECK(share < 1);
  CHECK(std::abs(texture_of(small).cols - 1500 * share) < 1);
  CHECK(floats_of(small["places"]).size() == 12);
}

TEST_CASE("surfaces that cannot be shown leave a line that says why") {
  TexturedMesh mesh = noisy_square(1500);
  std::string problem;
  mesh.jpeg.resize(1'500'000);
  CHECK(surface_data(mesh, 1'500'000, problem).is_null());
  CHECK(problem.find("the texture") == 0);
  mesh.indices.resize(3'000'000);
  CHECK(surface_data(mesh, 5'000'000, problem).is_null());
  CHECK(problem == "1000000 triangles are more than the page takes: it shows the map's planes as rectangles");
}

TEST_CASE(
    "the report shows the surfaces of model.glb, and without a sound one the rectangles of the planes") {
  const RoomCopy copy;
  REQUIRE(copy.run("--dense").code == 0);
  const auto shown = page_data(copy.out / "report.html");
  const Glb glb = read_glb(copy.out / "model.glb");
  const auto same = [&](const char* name, std::size_t view) {
    return from_base64(shown["surfaces"][name]["base64"].get<std::string>()) == part(glb, view);
  };
  CHECK(same("places", 0));
  CHECK(same("textures", 2));
  CHECK(same("indices", 3));
  CHECK(from_base64(shown["surfaces"]["jpeg"].get<std::string>()) == part(glb, 4));
  CHECK(shown["problems"].empty());

  const std::string sound = text_of(copy.out / "model.glb");
  const auto damaged = [&](const std::string& bytes, const std::string& what) {
    write(copy.out / "model.glb", bytes);
    const Outcome outcome = run_program("report " + copy.out.string());
    INFO(outcome.text);
    CHECK(outcome.code == 0);
    CHECK(outcome.text.find("model.glb: " + what) != std::string::npos);
    const auto data = page_data(copy.out / "report.html");
    CHECK_FALSE(data.contains("surfaces"));
    CHECK(data.contains("planes"));
  };
  damaged(sound.substr(0, sound.size() / 2), "ends too early");
  damaged("glTF", "ends too early");
  damaged("solid model", "is no binary glTF 2.0");
  std::string wild = sound;  // the last corner of the last triangle
  const std::size_t binary = sound.size() - glb.binary.size();
  const auto& triangles = glb.json["bufferViews"][3];
  wild[binary + triangles["byteOffset"].get<std::size_t>() + triangles["byteLength"].get<std::size_t>() - 1] =
      '\x7f';
  damaged(wild, "has triangles whose corners are missing");
  std::string other = sound;
  other.replace(other.find("\"POSITION\""), 10, "\"PISITION\"");
  damaged(other, "is not as `sslam run --dense` writes it");
}

}  // namespace surface_data_test
