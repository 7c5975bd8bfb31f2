// SPDX-License-Identifier: BSD-3-Clause
// What `sslam normals` writes. Its complaints are tested in normals_tests.cmake.
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/videoio.hpp>
#include <sstream>
#include <string>

#include "cli/program.hpp"
#include "sslam/opencv/normals/normal_picture.hpp"
#include "support/catch.hpp"
#include "support/scratch_folder.hpp"

namespace normals_test {

using namespace sslam;
using sslam::testing::interrupt_program;
using sslam::testing::Outcome;
using sslam::testing::run_program;
using sslam::testing::ScratchFolder;
namespace fs = std::filesystem;

namespace {

const std::string kTiny = " --quiet --model " + std::string(SSLAM_FIXTURES) + "/tiny_normals.onnx ";

std::string arguments(const fs::path& images, const fs::path& out, const std::string& options) {
  return "normals " + images.string() + " --out " + out.string() + " " + options;
}

Outcome normals(const fs::path& images, const fs::path& out, const std::string& options = "") {
  return run_program(arguments(images, out, options));
}

// Grey, which the tiny model takes for planar, and magenta on the right, which it does not.
cv::Mat_<cv::Vec3b> half_planar(int width, int height) {
  cv::Mat_<cv::Vec3b> image(height, width, cv::Vec3b(128, 128, 128));
  image.colRange(width / 2, width).setTo(cv::Vec3b(255, 0, 255));
  return image;
}

}  // namespace

TEST_CASE("normals writes what run reads") {
  const ScratchFolder scratch;
  const fs::path room = scratch.path() / "room", out = scratch.path() / "normals",
                 results = scratch.path() / "out";
  REQUIRE(run_program("synth " + room.string() + " --quiet --frames 30 --seed 3 --size 480x360").code == 0);
  Outcome outcome = normals(room, out, "--quiet");
  INFO(outcome.text);
  REQUIRE(outcome.code == 0);
  REQUIRE(outcome.text.find("images           30 of 30") == 0);  // nothing before: the camera is known
  outcome = run_program("run " + room.string() + " --quiet --out " + results.string() +
                        " --normals files:" + out.string());
  INFO(outcome.text);
  REQUIRE(outcome.code == 0);
  REQUIRE(outcome.text.find("warning") == std::string::npos);
  std::ifstream file(results / "metrics.json");
  REQUIRE(nlohmann::json::parse(file)["share_tracked"].get<double>() > 0.8);
  std::ifstream frames(results / "frames.csv");
  std::string line;
  REQUIRE(std::getline(frames, line));
  int rows = 0;
  for (; std::getline(frames, line); ++rows) {
    std::istringstream cells(line);
    std::string cell;
    for (int i = 0; i < 8; ++i) std::getline(cells, cell, ',');  // the column "normals"
    CHECK(std::stoi(cell) > 300);
  }
  REQUIRE(rows == 30);
}

TEST_CASE("normals marks pixels that are not planar and leaves them in the overlay") {
  const ScratchFolder scratch;
  const cv::Mat_<cv::Vec3b> image = half_planar(128, 96);
  REQUIRE(cv::imwrite((scratch.path() / "half.png").string(), image));
  const Outcome outcome = normals(scratch.path() / "half.png", scratch.path() / "out", kTiny);
  INFO(outcome.text);
  REQUIRE(outcome.code == 0);
  const auto planar = outcome.text.find("planar ");
  REQUIRE(planar != std::string::npos);
  CHECK(std::stod(outcome.text.substr(planar + 7)) == Approx(50).margin(2));
  const cv::Mat_<cv::Vec3b> picture = cv::imread((scratch.path() / "out/half.png").string()),
                            overlay = cv::imread((scratch.path() / "out/half_overlay.jpg").string());
  REQUIRE((picture.size() == image.size() && overlay.size() == image.size()));
  for (const int v : {2, 48, 93}) {
    CHECK(picture(v, 20) != no_normal());
    CHECK(picture(v, 100) == no_normal());
    CHECK(cv::norm(overlay(v, 100), image(v, 100)) < 12);  // JPEG
    CHECK(cv::norm(overlay(v, 20), image(v, 20)) > 20);
  }
}

TEST_CASE("normals refuses an image that is too small and goes on over one among others") {
  const ScratchFolder scratch;
  fs::create_directories(scratch.path() / "images");
  const auto save = [&](const std::string& name, int width, int height) {
    REQUIRE(cv::imwrite((scratch.path() / "images" / name).string(), half_planar(width, height)));
  };
  save("b.png", 24, 18);
  Outcome outcome = normals(scratch.path() / "images", scratch.path() / "out", kTiny);
  INFO(outcome.text);
  CHECK(outcome.code == 1);
  CHECK(outcome.text.find("b.png: the image is too small for the network of normals: 24x18 pixels, less than "
                          "half of 64x48\n") != std::string::npos);
  save("a.png", 64, 48);
  save("c.png", 128, 96);
  outcome = normals(scratch.path() / "images", scratch.path() / "out", kTiny);
  INFO(outcome.text);
  CHECK(outcome.code == 0);
  CHECK(outcome.text.find("images           2 of 3") != std::string::npos);
  CHECK(outcome.text.find("sslam: warning: " + (scratch.path() / "images/b.png").string()) !=
        std::string::npos);
  CHECK(fs::exists(scratch.path() / "out/c.png"));
  CHECK_FALSE(fs::exists(scratch.path() / "out/b.png"));
}

TEST_CASE("normals names the frames of a video") {
  const ScratchFolder scratch;
  const fs::path file = scratch.path() / "walk.avi";
  cv::VideoWriter video(file.string(), cv::VideoWriter::fourcc('M', 'J', 'P', 'G'), 10, {128, 96});
  REQUIRE(video.isOpened());
  for (int i = 0; i < 3; ++i) video.write(half_planar(128, 96));
  video.release();
  const Outcome outcome = normals(file, scratch.path() / "out", kTiny);
  INFO(outcome.text);
  REQUIRE(outcome.code == 0);
  for (const char* name : {"walk_000000.png", "walk_000002.png", "walk_000002_overlay.jpg"})
    CHECK(fs::exists(scratch.path() / "out" / name));
}

TEST_CASE("normals keeps what it has when it is interrupted") {
  const ScratchFolder scratch;
  const fs::path images = scratch.path() / "images", out = scratch.path() / "out";
  fs::create_directories(images);
  for (int i = 0; i < 400; ++i)
    REQUIRE(cv::imwrite((images / (std::to_string(i) + ".png")).string(), half_planar(320, 240)));
  const Outcome outcome = interrupt_program(arguments(images, out, ""));
  INFO(outcome.text);
  if (outcome.code == 0) {
    WARN("all was written before it could be interrupted");
    return;
  }
  REQUIRE(outcome.code == 130);
  CHECK(outcome.text.find("interrupted; the results until then were written") != std::string::npos);
  CHECK(fs::exists(out / "encoding.txt"));
  int pictures = 0;
  for (const auto& entry : fs::directory_iterator(out)) {
    if (entry.path().extension() != ".png") continue;
    ++pictures;
    CHECK_FALSE(cv::imread(entry.path().string()).empty());
  }
  CHECK(outcome.text.find("images           " + std::to_string(pictures) + " of 400") != std::string::npos);
}

}  // namespace normals_test
