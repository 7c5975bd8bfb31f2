// SPDX-License-Identifier: BSD-3-Clause
// The map and the plot, as text that other programs read.
#include <string>
#include <vector>

#include "io/errors.hpp"
#include "sslam/io/maps/map_writer.hpp"
#include "sslam/io/plots/comparison_view.hpp"
#include "support/scratch_folder.hpp"

using namespace sslam;
using testing::contains;
using testing::error_of;
using testing::text_of;

namespace {

io::Trajectory line_along_z(int count) {
  io::Trajectory path;
  for (int i = 0; i < count; ++i) {
    io::StampedPose pose;
    pose.stamp = i;
    pose.world_from_cam.translation = Vec3<double>(0.3 * i, 0.01 * i, i);
    path.push_back(pose);
  }
  return path;
}

int count_of(const std::string& text, const std::string& part) {
  int count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

}  // namespace

TEST_CASE("A map is points as vertices, lines as edges and planes as faces") {
  const testing::ScratchFolder scratch;
  const std::vector<io::MapPoint> points{{{1, 2, 3}, {255, 0, 7}}};
  const std::vector<io::MapLine> lines{{{0, 0, 0}, {0, 0, 1}, {1, 2, 3}}, {{1, 0, 0}, {1, 1, 0}, {4, 5, 6}}};
  const auto path = scratch.path() / "map.ply";
  const std::vector<io::MapFace> faces{{{{{0, 0, 2}, {1, 0, 2}, {1, 1, 2}, {0, 1, 2}}}, {7, 8, 9}}};
  io::write_map(path, points, lines, faces);
  const std::string text = text_of(path);
  CHECK(text.rfind("ply\nformat ascii 1.0\n", 0) == 0);
  CHECK(contains(text, "element vertex 9\n"));
  CHECK(contains(text, "element edge 2\n"));
  CHECK(contains(text,
                 "end_header\n1.000000 2.000000 3.000000 255 0 7\n0.000000 0.000000 0.000000 128 128 128\n"));
  CHECK(contains(text, "\n1 2 1 2 3\n3 4 4 5 6\n4 5 6 7 8 7 8 9\n"));
  CHECK(contains(text, "element face 1\n"));
  CHECK(contains(error_of([&] { io::write_map(scratch.path() / "none/map.ply", {}, {}); }),
                 "map.ply: cannot write: No such"));
}

TEST_CASE("A plot shows the two axes of most extent and breaks the estimate where it was lost") {
  const testing::ScratchFolder scratch;
  const io::Trajectory truth = line_along_z(20);
  io::Trajectory estimate = truth;
  estimate.erase(estimate.begin() + 5, estimate.begin() + 15);
  const io::TopView view = io::comparison_view(truth, estimate, {}, 0, 15, "a < b & c");
  CHECK(view.truth.size() == 16);
  CHECK(view.max_gap == Approx(5));
  const auto path = scratch.path() / "plot.svg";
  io::write_top_view(path, view);
  const std::string text = text_of(path);
  CHECK(contains(text, "a &lt; b &amp; c"));
  CHECK(contains(text, ">x [m]<"));
  CHECK(contains(text, ">z [m]<"));
  CHECK_FALSE(contains(text, ">y [m]<"));
  CHECK(contains(text, "ground truth"));
  CHECK_FALSE(contains(text, "nan"));
  const std::string estimate_path = text.substr(text.find("stroke=\"#1f6fb4\""));
  CHECK(count_of(estimate_path.substr(0, estimate_path.find("/>")), "M") == 2);
}

TEST_CASE("A plot of nothing or of one point is still a page") {
  const testing::ScratchFolder scratch;
  const auto path = scratch.path() / "plot.svg";
  io::write_top_view(path, {});
  CHECK(contains(text_of(path), "</svg>"));
  io::TopView one;
  one.estimate = line_along_z(1);
  one.points = {{0, 0, 0}, {1e9, 0, 0}};
  io::write_top_view(path, one);
  CHECK(contains(text_of(path), "</svg>"));
  CHECK_FALSE(contains(text_of(path), "nan"));
}

TEST_CASE("Ticks are round numbers") {
  CHECK(io::svg::tick_step(6, 6) == Approx(1));
  CHECK(io::svg::tick_step(7, 6) == Approx(2));
  CHECK(io::svg::tick_step(0.24, 6) == Approx(0.05));
  CHECK(io::svg::tick_step(40, 6) == Approx(10));
}
