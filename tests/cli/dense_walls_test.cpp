// SPDX-License-Identifier: BSD-3-Clause
// Walls of a floor plan from the squares of a dense model.
#include "cli/results/dense_walls.hpp"

#include <array>
#include <filesystem>
#include <fstream>
#include <string>

#include "io/errors.hpp"
#include "support/catch.hpp"
#include "support/scratch_folder.hpp"

namespace dense_walls_test {

using namespace sslam;
using namespace sslam::testing;

namespace {

template <class T>
void append(std::string& bytes, const T& value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

// Squares of 5 cm of the wall y = 0, from x = -2 to 2 and z = 0 to 2.5.
std::string wall_ply() {
  constexpr float kSide = 0.05F;
  std::string vertices, faces;
  std::int32_t count = 0;
  for (int column = -40; column < 40; ++column)
    for (int row = 0; row < 50; ++row) {
      append(faces, std::uint8_t{4});
      for (const std::array<int, 2>& corner : {std::array{0, 0}, {1, 0}, {1, 1}, {0, 1}}) {
        for (const float x : {kSide * static_cast<float>(column + corner[0]), 0.0F,
                              kSide * static_cast<float>(row + corner[1])})
          append(vertices, x);
        vertices.append(3, '\x80');
        append(faces, count++);
      }
    }
  return "ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(count) + "\nelement face " +
         std::to_string(count / 4) + "\nend_header\n" + vertices + faces;
}

cli::RunFolder run_with(const std::array<std::array<double, 4>, 2>& planes) {
  cli::RunFolder run;
  for (const auto& p : planes)
    run.metrics["dense"]["planes"].push_back({{"normal", {p[0], p[1], p[2]}}, {"distance", p[3]}});
  return run;
}

}  // namespace

TEST_CASE("a wall of the dense model is one stroke, and leaves none on the planes that cross it") {
  const ScratchFolder scratch;
  const std::filesystem::path file = scratch.path() / "model.ply";
  std::ofstream(file, std::ios::binary) << wall_ply();
  const cli::RunFolder run =
      run_with({{{0, 1, 0, 0}, {1, 0, 0, 1}}});  // the second has its squares elsewhere
  const auto walls = cli::dense_walls(scratch.path(), run, Mat3<double>::Identity());
  REQUIRE(walls.size() == 1);
  CHECK((walls[0].end - walls[0].start).norm() == Approx(4).margin(0.1));
  CHECK(std::abs(walls[0].start.y()) < 1e-9);
}

TEST_CASE("a damaged model.ply gives one line instead of walls") {
  const ScratchFolder scratch;
  const std::filesystem::path file = scratch.path() / "model.ply";
  const std::string whole = wall_ply();
  const cli::RunFolder run = run_with({{{0, 1, 0, 0}, {1, 0, 0, 1}}});
  const auto error = [&](const std::string& text) {
    std::ofstream(file, std::ios::binary) << text;
    return error_of([&] { (void)cli::dense_walls(scratch.path(), run, Mat3<double>::Identity()); });
  };
  CHECK(contains(error("ply\n"), "model.ply: is no model.ply of `sslam run --dense`"));
  CHECK(contains(error(whole.substr(0, whole.size() - 1)), "model.ply: ends before its squares do"));
  std::string wrong = whole;
  wrong[wrong.size() - 1] = '\x7f';
  CHECK(contains(error(wrong), "model.ply: a square names a vertex that is not there"));
}

}  // namespace dense_walls_test
