// SPDX-License-Identifier: BSD-3-Clause
// The page of `sslam eval --plot`, and the files that drawings become.
#include <cmath>
#include <opencv2/imgcodecs.hpp>
#include <string>

#include "cli/eval/eval_figure.hpp"
#include "support/catch.hpp"
#include "support/scratch_folder.hpp"

namespace eval_figure_test {

namespace {

using namespace sslam;
using sslam::testing::ScratchFolder;
using sslam::testing::text_of;

// Along x at 1 m/s, turning about z by a degree a second; from `pause` on ten seconds later.
io::Trajectory walk(int poses, double sideways, int pause) {
  io::Trajectory walk;
  for (int i = 0; i < poses; ++i) {
    const Vec3<double> turn(0, 0, radians(1.0 * i));
    walk.push_back({100.0 + i + (i >= pause ? 10 : 0), {SO3<double>::exp(turn), {1.0 * i, sideways, 0}}});
  }
  return walk;
}

std::size_t lines_of(const cli::Figure& figure, const cli::FigureColour& colour) {
  std::size_t count = 0;
  for (const cli::FigureLine& line : figure.lines) count += line.colour == colour ? 1 : 0;
  return count;
}

bool says(const cli::Figure& figure, const std::string& words) {
  for (const cli::FigureText& text : figure.texts)
    if (text.text.find(words) != std::string::npos) return true;
  return false;
}

}  // namespace

TEST_CASE("names in the legend of the page of eval stay on it, by their ends and in whole characters") {
  const io::Trajectory poses = walk(20, 0, 99);
  const std::vector<double> stamps = io::stamps_of(poses), errors(20, 0.1);
  std::vector<cli::PlottedEstimate> estimates;
  for (const char* end : {"_first", "_second", "_third", "_fourth", "_fifth"}) {
    std::string name;
    for (int i = 0; i < 40; ++i) name += "\u00fc";
    estimates.push_back({name + end, poses, stamps, errors, errors});
  }
  const cli::Figure figure = cli::eval_figure(poses, estimates, 1);
  std::size_t named = 0;
  for (const cli::FigureText& text : figure.texts) {
    if (text.at.y() > 40) continue;  // below the legend
    CHECK(text.at.x() + 7.5 * static_cast<double>(text.text.size()) <= figure.width);
    for (const cli::PlottedEstimate& estimate : estimates)
      if (text.text.ends_with(estimate.name.substr(80))) {
        ++named;
        CHECK(text.text.substr(0, 3) == "...");
        CHECK(static_cast<unsigned char>(text.text[3]) == 0xC3);  // where a character begins
      }
  }
  CHECK(named == estimates.size());
}

TEST_CASE("the page of eval has a curve of each estimate in each panel, broken where poses pause") {
  const io::Trajectory truth = walk(20, 0, 99), whole = walk(20, 0.1, 99), paused = walk(20, 0.2, 10);
  const std::vector<double> stamps = io::stamps_of(whole), errors(20, 0.1);
  const cli::Figure one = cli::eval_figure(truth, {{"whole", whole, stamps, errors, errors}}, 1);
  const cli::FigureColour first = one.lines[1].colour;  // the second of the legend
  CHECK(lines_of(one, first) == 1 + 1 + 2 + 6);         // legend, path, errors, coordinates and angles
  const cli::Figure two = cli::eval_figure(
      truth,
      {{"whole", whole, stamps, errors, errors}, {"paused", paused, io::stamps_of(paused), errors, errors}},
      1);
  CHECK(lines_of(two, first) == 10);
  CHECK(lines_of(two, two.lines[2].colour) == 1 + 2 * (1 + 2 + 6));
  for (const char* words : {"whole", "paused", "path, y over x", "position error", "yaw, degrees"})
    CHECK(says(two, words));
  // Ends of the yaw's axis: it goes from 0 to 19 degrees.
  CHECK(says(one, "10"));
  for (const cli::FigureLine& line : two.lines)
    for (const Vec2<double>& p : line.points) {
      REQUIRE(p.allFinite());
      CHECK((p.x() >= 0 && p.x() <= two.width && p.y() >= 0 && p.y() <= two.height));
    }
}

TEST_CASE("an estimate that stands still, or is a single pose, has a page as well") {
  const io::Trajectory truth = walk(3, 0, 99), still{truth[0], truth[0]}, single{truth[0]};
  for (const io::Trajectory& estimate : {still, single})
    for (const cli::FigureLine& line : cli::eval_figure(truth, {{"it", estimate, {100}, {0}, {0}}}, 1).lines)
      for (const Vec2<double>& p : line.points) CHECK(p.allFinite());
}

TEST_CASE("a drawing as SVG, PDF and PNG") {
  const ScratchFolder scratch;
  cli::Figure figure;
  figure.width = 100;
  figure.height = 50;
  figure.lines.push_back({{{10, 25}, {90, 25}}, {255, 0, 0}, 4});
  figure.texts.push_back({{50, 45}, "a (b) <c> \xc3\xa9", 10, cli::FigureAnchor::kMiddle, {0, 0, 0}});
  for (const char* name : {"a.svg", "a.PDF", "a.png"}) {
    REQUIRE(cli::is_figure_name(name));
    cli::write_figure(scratch.path() / name, figure);
  }
  CHECK_FALSE(cli::is_figure_name("a.jpg"));
  CHECK_FALSE(cli::is_figure_name("png"));

  const std::string svg = text_of(scratch.path() / "a.svg");
  CHECK(svg.find("stroke=\"#ff0000\" stroke-width=\"4\" points=\"10.0,25.0 90.0,25.0\"/>") !=
        std::string::npos);
  CHECK(svg.find(">a (b) &lt;c> \xc3\xa9</text>") != std::string::npos);

  const std::string pdf = text_of(scratch.path() / "a.PDF");
  CHECK(pdf.find("10.00 25.00 m\n90.00 25.00 l\nS") != std::string::npos);
  CHECK(pdf.find("(a \\(b\\) <c> ?) Tj") != std::string::npos);
  // Each object stands where the table says.
  const std::size_t table = pdf.find("\n0000000000 65535 f \n") + 21;
  for (int i = 0; i < 5; ++i) {
    const std::size_t at = std::stoul(pdf.substr(table + 20 * static_cast<std::size_t>(i), 10));
    CHECK(pdf.substr(at, 7) == std::to_string(i + 1) + " 0 obj");
  }

  const cv::Mat png = cv::imread((scratch.path() / "a.png").string(), cv::IMREAD_COLOR);
  REQUIRE(png.size() == cv::Size(200, 100));
  CHECK(png.at<cv::Vec3b>(50, 100) == cv::Vec3b(0, 0, 255));
  CHECK(png.at<cv::Vec3b>(10, 100) == cv::Vec3b(255, 255, 255));
  CHECK(png.at<cv::Vec3b>(50, 10) == cv::Vec3b(255, 255, 255));
}

}  // namespace eval_figure_test
