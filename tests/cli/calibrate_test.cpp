// SPDX-License-Identifier: BSD-3-Clause
// `sslam calibrate` on rendered boards: the camera that took them comes back, and what bad views get.
#include <cmath>
#include <filesystem>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/videoio.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "cli/board_renderer.hpp"
#include "cli/calibrate/board.hpp"
#include "cli/program.hpp"
#include "sslam/opencv/camera/camera_file.hpp"
#include "support/catch.hpp"
#include "support/scratch_folder.hpp"

namespace calibrate_test {

namespace {

namespace fs = std::filesystem;
using namespace sslam::testing;

constexpr double kSquare = 0.03;

struct Placement {
  cv::Vec3d turn, middle;
};

// To all sides, near and far, into the corners of the image.
std::vector<Placement> good_placements() {
  return {{{0, 0, 0.05}, {0, 0, 0.45}},
          {{0.5, 0, 0}, {-0.05, -0.04, 0.5}},
          {{-0.5, 0, 0.1}, {0.06, 0.04, 0.5}},
          {{0, 0.55, 0}, {-0.12, 0.07, 0.55}},
          {{0, -0.55, 0}, {0.12, -0.07, 0.55}},
          {{0.35, 0.35, 0.2}, {0.1, 0.08, 0.5}},
          {{-0.35, 0.4, 0}, {-0.11, -0.08, 0.5}},
          {{0.4, -0.35, 0}, {0.12, -0.08, 0.55}},
          {{-0.4, -0.3, 0.3}, {-0.1, 0.08, 0.55}},
          {{0.2, 0.2, 1.5}, {0.02, 0, 0.6}},
          {{0.7, 0, 0}, {0, 0, 0.6}},
          {{0, 0.7, 0}, {0, 0, 0.6}}};
}

// By the camera that the tests look for.
cv::Mat photograph(const BoardPicture& board, const Placement& placement) {
  static const std::vector<cv::Vec3d> rays = lens_rays({});
  return seen_by(rays, TrueCamera{}.size, board, placement.turn, placement.middle);
}

// A folder of photographs, named by number.
void shoot(const fs::path& folder, const std::vector<Placement>& placements, const BoardPicture& board) {
  fs::create_directories(folder);
  for (std::size_t i = 0; i < placements.size(); ++i)
    REQUIRE(cv::imwrite((folder / (std::to_string(i) + ".png")).string(), photograph(board, placements[i])));
}

const BoardPicture& chessboard() {
  static const BoardPicture board = chessboard_picture(8, 5, kSquare);
  return board;
}

struct Session {
  ScratchFolder scratch;
  fs::path folder = scratch.path() / "views";
  fs::path out = scratch.path() / "camera.yaml";

  [[nodiscard]] Outcome calibrate(const std::string& options = "--size 8x5") const {
    return run_program("calibrate " + folder.string() + " --quiet --square 0.03 --out " + out.string() + " " +
                       options);
  }
};

void require_camera(const fs::path& file, const TrueCamera& wanted) {
  const sslam::CameraFile found = sslam::read_camera_file(file);
  const auto& pinhole = found.camera.pinhole;
  INFO(text_of(file));
  REQUIRE(std::abs(pinhole.fx - wanted.fx) < 0.005 * wanted.fx);
  REQUIRE(std::abs(pinhole.fy - wanted.fy) < 0.005 * wanted.fy);
  REQUIRE(std::abs(pinhole.cx - wanted.cx) < 1.5);
  REQUIRE(std::abs(pinhole.cy - wanted.cy) < 1.5);
  REQUIRE(std::abs(found.camera.distortion.k1 - wanted.lens(0)) < 0.01);
  REQUIRE(std::abs(found.camera.distortion.k2 - wanted.lens(1)) < 0.03);
  REQUIRE(std::abs(found.camera.distortion.p1 - wanted.lens(2)) < 0.001);
  REQUIRE(std::abs(found.camera.distortion.p2 - wanted.lens(3)) < 0.001);
  REQUIRE(found.camera.width == wanted.size.width);
  REQUIRE(found.camera.height == wanted.size.height);
}

// Exit code 1, one line of error, and no camera.
void require_refused(const Session& session, const Outcome& outcome, const std::string& what) {
  INFO(outcome.text);
  REQUIRE(outcome.code == 1);
  REQUIRE(outcome.text.find("sslam: error: ") == 0);
  REQUIRE(outcome.text.find(what) != std::string::npos);
  REQUIRE(outcome.text.find('\n') == outcome.text.size() - 1);
  REQUIRE_FALSE(fs::exists(session.out));
}

}  // namespace

TEST_CASE("calibrate finds the camera that saw a chessboard") {
  const Session session;
  shoot(session.folder, good_placements(), chessboard());
  const Outcome outcome = session.calibrate();
  INFO(outcome.text);
  REQUIRE(outcome.code == 0);
  require_camera(session.out, {});
  REQUIRE(outcome.text.find("views            12 used of 12 images") != std::string::npos);
  REQUIRE(outcome.text.find("11.png\n") != std::string::npos);
  const cv::Mat picture = cv::imread((session.scratch.path() / "camera_coverage.png").string());
  REQUIRE(picture.size() == TrueCamera{}.size);
  REQUIRE(text_of(session.out).find("# sslam calibrate: reprojection error 0.") != std::string::npos);
}

TEST_CASE("calibrate finds the camera that saw a ChArUco board, partly outside the image too") {
  const Session session;
  std::vector<Placement> placements = good_placements();
  placements[3].middle = {-0.2, 0.12, 0.5};
  shoot(session.folder, placements, charuco_picture(9, 6, kSquare));
  const Outcome outcome = session.calibrate("--pattern charuco --size 9x6");
  INFO(outcome.text);
  REQUIRE(outcome.code == 0);
  require_camera(session.out, {});
}

TEST_CASE("calibrate takes a video, and each view of it once") {
  Session session;
  session.folder = session.scratch.path() / "board.avi";
  {
    cv::VideoWriter video(session.folder.string(), cv::VideoWriter::fourcc('M', 'J', 'P', 'G'), 25,
                          TrueCamera{}.size);
    REQUIRE(video.isOpened());
    for (const Placement& placement : good_placements()) {
      cv::Mat colour;
      cv::cvtColor(photograph(chessboard(), placement), colour, cv::COLOR_GRAY2BGR);
      for (int i = 0; i < 2; ++i) video.write(colour);
    }
  }
  const Outcome outcome = session.calibrate();
  INFO(outcome.text);
  REQUIRE(outcome.code == 0);
  require_camera(session.out, {});
  REQUIRE(sslam::read_camera_file(session.out).frame_rate == 25);
  REQUIRE(outcome.text.find("12 used of 24 images; 0 without a board, 12 like an earlier one") !=
          std::string::npos);
}

TEST_CASE("calibrate leaves a view out that does not fit, and says so") {
  const Session session;
  shoot(session.folder, good_placements(), chessboard());
  TrueCamera zoomed;
  zoomed.fx = zoomed.fy = 640;
  const Placement placement = good_placements()[5];
  cv::imwrite((session.folder / "zoomed.png").string(),
              seen_by(lens_rays(zoomed), zoomed.size, chessboard(), placement.turn,
                      placement.middle + cv::Vec3d(-0.1, -0.05, 0.1)));
  cv::imwrite((session.folder / "wall.png").string(), cv::Mat(TrueCamera{}.size, CV_8UC1, cv::Scalar(128)));
  const Outcome outcome = session.calibrate();
  INFO(outcome.text);
  REQUIRE(outcome.code == 0);
  REQUIRE(outcome.text.find("sslam: note: left out zoomed.png: ") != std::string::npos);
  REQUIRE(outcome.text.find("12 used of 14 images; 1 without a board") != std::string::npos);
  require_camera(session.out, {});
}

TEST_CASE("calibrate says where the views do not suffice") {
  const Session session;
  SECTION("too few") {
    const auto all = good_placements();
    shoot(session.folder, {all[0], all[1], all[2], all[2]}, chessboard());
    require_refused(session, session.calibrate(),
                    "3 different views of the board, of 4 images; needs at least 5");
  }
  SECTION("all from the front") {
    std::vector<Placement> frontal;
    for (int i = 0; i < 8; ++i)
      frontal.push_back({{0, 0, 0.1 * i}, {0.03 * (i % 3 - 1), 0.02 * (i / 3 - 1), 0.45 + 0.03 * i}});
    shoot(session.folder, frontal, chessboard());
    require_refused(session, session.calibrate(), "the views do not determine the focal length");
  }
  SECTION("no board") {
    fs::create_directories(session.folder);
    for (const char* name : {"a.png", "b.png"})
      cv::imwrite((session.folder / name).string(), cv::Mat(TrueCamera{}.size, CV_8UC1, cv::Scalar(128)));
    require_refused(session, session.calibrate(),
                    "no board of 8x5 inner corners in any of 2 images; check --pattern");
  }
  SECTION("images of two sizes") {
    shoot(session.folder, good_placements(), chessboard());
    cv::imwrite((session.folder / "12.png").string(), cv::Mat(240, 320, CV_8UC1, cv::Scalar(128)));
    require_refused(session, session.calibrate(),
                    "12.png: has 320x240 pixels, and 0.png 640x480; a camera is");
  }
}

TEST_CASE("calibrate says which board is there instead") {
  const Session session;
  SECTION("squares counted") {
    shoot(session.folder, {good_placements()[0]}, chessboard());
    require_refused(
        session, session.calibrate("--size 9x6"),
        "no board of 9x6 inner corners in any of 1 images; one of 8x5 is there: --size counts inner corners");
  }
  SECTION("another dictionary") {
    shoot(session.folder, {good_placements()[0]}, charuco_picture(9, 6, kSquare));
    require_refused(session, session.calibrate("--pattern charuco --size 9x6 --dictionary 6x6_250"),
                    "markers of --dictionary 4x4_50 are there");
  }
  SECTION("a ChArUco board of another width") {
    shoot(session.folder, good_placements(), charuco_picture(9, 6, kSquare));
    require_refused(session, session.calibrate("--pattern charuco --size 7x8"), "check --size and --pattern");
  }
}

TEST_CASE("calibrate --model fisheye finds a lens of 170 degrees, and run takes its file") {
  sslam::WideLens lens;
  lens.width = 640;
  lens.height = 480;
  lens.pinhole = {215, 214, 322.5, 236};
  lens.k = {0.02, -0.006, 0.001, 0, 0};
  const std::vector<Placement> placements{
      {{0.1, 0, 0.05}, {0, 0, 0.2}},          {{0.5, 0, 0}, {-0.05, -0.1, 0.2}},
      {{-0.5, 0, 0.1}, {0.05, 0.1, 0.2}},     {{0, 0.6, 0}, {-0.25, 0.03, 0.22}},
      {{0, -0.6, 0}, {0.25, -0.03, 0.22}},    {{0.3, 0.7, 0}, {-0.25, -0.12, 0.2}},
      {{-0.3, 0.7, 0}, {-0.25, 0.12, 0.2}},   {{0.3, -0.7, 0}, {0.25, -0.12, 0.2}},
      {{-0.3, -0.7, 0}, {0.25, 0.12, 0.2}},   {{0.35, 0.35, 0.2}, {0.08, 0.06, 0.2}},
      {{-0.35, 0.4, 0}, {-0.1, -0.06, 0.22}}, {{0.2, 0.2, 1.5}, {0.02, 0, 0.25}}};
  const Session session;
  fs::create_directories(session.folder);
  const std::vector<cv::Vec3d> rays = fisheye_rays(lens);
  for (std::size_t i = 0; i < placements.size(); ++i)
    REQUIRE(cv::imwrite(
        (session.folder / (std::to_string(i) + ".png")).string(),
        seen_by(rays, {lens.width, lens.height}, chessboard(), placements[i].turn, placements[i].middle)));
  const Outcome outcome = session.calibrate("--size 8x5 --model fisheye");
  INFO(outcome.text << text_of(session.out));
  REQUIRE(outcome.code == 0);
  REQUIRE(outcome.text.find("fisheye          k1 ") != std::string::npos);
  REQUIRE(text_of(session.out).find("Camera.type: \"KannalaBrandt8\"") != std::string::npos);
  const sslam::CameraFile found = sslam::read_wide_camera_file(session.out);
  REQUIRE(found.wide);
  // Where it shows what is 60 degrees off its axis, by a pixel: coefficients trade off against each other.
  for (const sslam::Vec3<double>& ray :
       {sslam::Vec3<double>(0.866, 0, 0.5), sslam::Vec3<double>(-0.6, 0.62, 0.5),
        sslam::Vec3<double>(0, -0.7, 0.7), sslam::Vec3<double>(0.01, 0.01, 1)}) {
    sslam::Vec2<double> wanted, seen;
    REQUIRE(lens.project(ray, wanted));
    REQUIRE(found.wide->project(ray, seen));
    CHECK((seen - wanted).norm() < 1);
  }
  const Outcome both = session.calibrate("--model fisheye --k3");
  CHECK(both.code == 2);
  CHECK(both.text.find("--k3: not with --model fisheye") != std::string::npos);
}

TEST_CASE("calibrate --print writes the board that it looks for, in its true size") {
  const ScratchFolder scratch;
  const fs::path file = scratch.path() / "board.pdf";
  const auto pattern = GENERATE(sslam::cli::Pattern::kChessboard, sslam::cli::Pattern::kCharuco);
  const bool markers = pattern == sslam::cli::Pattern::kCharuco;
  const Outcome outcome = run_program("calibrate --print " + file.string() + " --size 8x5 --square 0.03" +
                                      (markers ? " --pattern charuco" : ""));
  INFO(outcome.text);
  REQUIRE(outcome.code == 0);
  REQUIRE(outcome.text.find(markers ? "240 x 150 mm, on A4" : "270 x 180 mm, on A4") != std::string::npos);
  const std::string pdf = text_of(file);
  REQUIRE(pdf.starts_with("%PDF-1.4\n"));
  // Each object stands where the table says.
  std::istringstream table(pdf.substr(pdf.rfind("xref\n0 6\n") + 9));
  std::string line;
  std::getline(table, line);
  for (int object = 1; object <= 5; ++object) {
    std::getline(table, line);
    REQUIRE(pdf.compare(std::stoul(line), 7, std::to_string(object) + " 0 obj") == 0);
  }
  // Drawn with 4 pixels a millimetre, and found.
  double width = 0, height = 0;
  const auto box = pdf.find("/MediaBox [0 0 ");
  REQUIRE(std::sscanf(pdf.c_str() + box, "/MediaBox [0 0 %lf %lf]", &width, &height) == 2);
  constexpr double kPixels = 4, kPoint = 72 / 25.4;
  cv::Mat sheet(static_cast<int>(height / kPoint * kPixels), static_cast<int>(width / kPoint * kPixels),
                CV_8UC1, cv::Scalar(255));
  std::istringstream lines(pdf);
  for (double x = 0, y = 0, w = 0, h = 0; std::getline(lines, line);) {
    if (!line.ends_with(" re") || std::sscanf(line.c_str(), "%lf %lf %lf %lf", &x, &y, &w, &h) != 4) continue;
    const cv::Point2d from(x * kPixels, sheet.rows - (y + h) * kPixels), size(w * kPixels, h * kPixels);
    sheet(cv::Rect(cv::Point(cvRound(from.x), cvRound(from.y)),
                   cv::Point(cvRound(from.x + size.x), cvRound(from.y + size.y))))
        .setTo(0);
  }
  sslam::cli::BoardSettings settings;
  settings.pattern = pattern;
  settings.columns = 8;
  settings.rows = 5;
  settings.square = 0.03;
  const sslam::cli::BoardView view = sslam::cli::Board(settings).find(sheet);
  REQUIRE(view.image.size() == (markers ? 28 : 40));
  for (std::size_t i = 1; i < view.image.size(); ++i) {
    const double on_board = cv::norm(view.board[i] - view.board[0]);
    CHECK(std::abs(cv::norm(view.image[i] - view.image[0]) - on_board * 1000 * kPixels) < 1);
  }
  const Outcome other = run_program("calibrate --print " + (scratch.path() / "board.txt").string());
  CHECK(other.code == 2);
  CHECK(other.text.find("writes a .pdf or an .svg") != std::string::npos);
}

}  // namespace calibrate_test
