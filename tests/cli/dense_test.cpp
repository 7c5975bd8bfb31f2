// SPDX-License-Identifier: BSD-3-Clause
// `sslam run --dense` on a rendered room: the files of the model.
#include <cstdint>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

#include "cli/glb_file.hpp"
#include "cli/room_copy.hpp"
#include "support/catch.hpp"

namespace dense_test {

namespace fs = std::filesystem;
using namespace sslam::testing;

TEST_CASE("run --dense writes a model that viewers can open, and a run without it takes the model away") {
  const RoomCopy copy;
  const Outcome outcome = copy.run("--dense --no-report");
  INFO(outcome.text);
  REQUIRE(outcome.code == 0);
  const auto metrics = copy.metrics();
  REQUIRE(metrics["settings"]["dense"] == true);
  REQUIRE(metrics["dense"]["planes"].size() >= 3);
  REQUIRE(metrics["dense"]["area"].get<double>() > 0);
  CHECK(metrics["dense"]["keyframes"] == metrics["keyframes"]);  // the first one of the map as well
  REQUIRE(metrics["files"].contains("model.glb"));

  const Glb glb = read_glb(copy.out / "model.glb");
  const auto& accessors = glb.json["accessors"];
  const std::size_t vertices = accessors[0]["count"], indices = accessors[3]["count"];
  REQUIRE(indices >= 3 * 2 * metrics["dense"]["planes"].size());
  REQUIRE(indices % 3 == 0);
  REQUIRE(part(glb, accessors[0]["bufferView"]).size() == 12 * vertices);
  REQUIRE(part(glb, accessors[2]["bufferView"]).size() == 8 * vertices);
  const std::string triangles = part(glb, accessors[3]["bufferView"]);
  REQUIRE(triangles.size() == 4 * indices);
  for (std::size_t i = 0; i < indices; ++i)
    if (word_at(triangles, 4 * i) >= vertices) FAIL("an index beyond the vertices");
  const std::string jpeg = part(glb, glb.json["images"][0]["bufferView"]);
  const cv::Mat atlas = cv::imdecode(std::vector<unsigned char>(jpeg.begin(), jpeg.end()), cv::IMREAD_COLOR);
  REQUIRE(atlas.cols == metrics["dense"]["texture_size"][0]);
  REQUIRE(atlas.rows == metrics["dense"]["texture_size"][1]);

  REQUIRE(run_program("export " + copy.out.string() + " --format glb").code == 0);
  REQUIRE(text_of(copy.out / "glb/model.glb") == text_of(copy.out / "model.glb"));
  const Outcome plan = run_program("export " + copy.out.string() + " --format floorplan");
  INFO(plan.text);
  REQUIRE(plan.code == 0);
  const std::size_t walls = plan.text.find("floorplan.svg (");
  REQUIRE(walls != std::string::npos);
  CHECK(std::stoi(plan.text.substr(walls + 15)) >= 2);

  const std::string ply = text_of(copy.out / "model.ply");
  REQUIRE(ply.rfind("ply\nformat binary_little_endian 1.0\n", 0) == 0);
  const auto count_of = [&](const std::string& element) {
    return std::stoul(ply.substr(ply.find("element " + element) + 9 + element.size()));
  };
  const std::size_t body = ply.find("end_header\n") + 11;
  REQUIRE(ply.size() - body == 15 * count_of("vertex") + 17 * count_of("face"));

  const std::string obj = text_of(copy.out / "model.obj");
  const auto rows_of = [&](const std::string& key) {
    std::size_t rows = 0;
    for (std::size_t at = obj.find("\n" + key + " "); at != std::string::npos;
         at = obj.find("\n" + key + " ", at + 1))
      ++rows;
    return rows;
  };
  for (const char* key : {"v", "vn", "vt"}) CHECK(rows_of(key) == vertices);
  CHECK(rows_of("f") == indices / 3);
  // The same triangles as in model.glb, counted from one.
  std::string first = "\nf";
  for (std::size_t i = 0; i < 3; ++i) {
    const std::string number = std::to_string(word_at(triangles, 4 * i) + 1);
    first += ' ' + number + '/' + number + '/' + number;
  }
  CHECK(obj.find("\nf") == obj.find(first + "\n"));
  CHECK(obj.find("\nmtllib model.mtl\n") != std::string::npos);
  CHECK(text_of(copy.out / "model.mtl").find("map_Kd model.jpg\n") != std::string::npos);
  CHECK(text_of(copy.out / "model.jpg") == jpeg);

  REQUIRE(copy.run("--no-report").code == 0);
  for (const char* file : {"model.obj", "model.mtl", "model.jpg"}) CHECK_FALSE(fs::exists(copy.out / file));
  REQUIRE_FALSE(fs::exists(copy.out / "model.glb"));
  REQUIRE_FALSE(fs::exists(copy.out / "model.ply"));
}

}  // namespace dense_test
