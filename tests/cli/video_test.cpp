// SPDX-License-Identifier: BSD-3-Clause
// `sslam run --video`: the overlay video, decoded and looked at, and what a bad place or name gets.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/videoio.hpp>
#include <string>
#include <vector>

#include "cli/room_copy.hpp"
#include "cli/video/overlay_colours.hpp"
#include "sslam/io/files/csv_reader.hpp"
#include "support/catch.hpp"

namespace video_test {

namespace fs = std::filesystem;
using namespace sslam::testing;
using sslam::cli::OverlayColour;

namespace {

constexpr int kWidth = 480, kHeight = 360;  // of the room's images

std::vector<cv::Mat> decode(const fs::path& file) {
  cv::VideoCapture video(file.string());
  REQUIRE(video.isOpened());
  std::vector<cv::Mat> frames;
  for (cv::Mat frame; video.read(frame);) frames.push_back(frame.clone());
  return frames;
}

// Pixels of about this hue. The room's paint is duller, and compression blurs.
int count_near(const cv::Mat& image, const OverlayColour& colour, int tolerance = 90) {
  int count = 0;
  for (const cv::Vec3b& p : cv::Mat_<cv::Vec3b>(image))
    count += std::abs(p[2] - colour.red) + std::abs(p[1] - colour.green) + std::abs(p[0] - colour.blue) <
             tolerance;
  return count;
}

double difference(const cv::Mat& a, const cv::Mat& b) {
  return cv::norm(a, b, cv::NORM_L1) / static_cast<double>(a.total() * 3);
}

// The states of frames.csv, a row a frame.
std::vector<std::string> states(const fs::path& run) {
  std::vector<std::string> problems, states;
  const auto table = sslam::io::read_csv(run / "frames.csv", problems);
  for (std::size_t row = 0; row < table.rows(); ++row)
    states.emplace_back(table.cell(row, table.column("state")));
  return states;
}

void require_no_leftover(const fs::path& folder) {
  for (const auto& entry : fs::directory_iterator(folder)) {
    INFO(entry.path());
    REQUIRE(entry.path().filename().string().find(".part") == std::string::npos);
  }
}

}  // namespace

TEST_CASE("run writes an overlay video of every frame, lost ones as well") {
  const RoomCopy copy;
  constexpr int kDark = 40;  // from here on there is nothing to see
  for (int i = kDark; i < kFrames; ++i) {
    char name[32];
    std::snprintf(name, sizeof name, "rgb/%06d.jpg", i);
    REQUIRE(cv::imwrite((copy.folder / name).string(), cv::Mat::zeros(kHeight, kWidth, CV_8UC3)));
  }
  const fs::path file = copy.scratch.path() / "look.mp4";
  const Outcome outcome = copy.run("--normals depth --video " + file.string());
  INFO(outcome.text);
  REQUIRE(outcome.code == 0);
  require_no_leftover(copy.scratch.path());
  const std::vector<cv::Mat> frames = decode(file);
  const std::vector<std::string> state = states(copy.out);
  REQUIRE(frames.size() == kFrames);
  REQUIRE(state.size() == kFrames);
  REQUIRE(state[kDark - 1] == "manhattan");
  REQUIRE(state[kFrames - 1] == "lost");
  REQUIRE(cv::VideoCapture(file.string()).get(cv::CAP_PROP_FPS) == Approx(30).margin(0.05));
  const cv::Rect picture(0, 0, kWidth, kHeight), inset(kWidth * 3 / 4, 0, kWidth / 4, kHeight / 8);
  for (const cv::Mat& frame : frames) {
    REQUIRE(frame.cols == kWidth);
    REQUIRE(frame.rows > kHeight);
    REQUIRE(frame.rows % 2 == 0);
    const cv::Mat words = frame(cv::Rect(0, kHeight, kWidth, frame.rows - kHeight)).clone();
    double darkest = 0, brightest = 0;
    cv::minMaxLoc(words.reshape(1), &darkest, &brightest);
    REQUIRE(brightest - darkest > 120);
  }
  // A tracked frame: what was drawn is there, and was not before.
  const cv::Mat source = cv::imread((copy.folder / "rgb/000030.jpg").string()), shown = frames[30](picture);
  REQUIRE(difference(source(inset), shown(inset)) > 20);
  REQUIRE(difference(source, shown) < 30);  // and still it is this image
  for (const OverlayColour& colour :
       {sslam::cli::kMappedPoint, sslam::cli::axis_overlay(0), sslam::cli::axis_overlay(1)}) {
    INFO(int(colour.red) << " " << int(colour.green) << " " << int(colour.blue));
    REQUIRE(count_near(shown, colour) > count_near(source, colour) + 20);
  }
  // A lost one: a black image, and its state in the colour of losses.
  const cv::Mat &lost = frames[kFrames - 2], &found = frames[kDark - 1];
  const cv::Rect banner(0, kHeight, kWidth, lost.rows - kHeight);
  constexpr OverlayColour kLost{255, 92, 138};
  REQUIRE(cv::mean(lost(cv::Rect(0, 0, inset.x, kHeight)))[1] < 5);
  REQUIRE(count_near(lost(banner), kLost, 160) > 10);
  REQUIRE(count_near(found(banner), kLost, 160) == 0);
}

TEST_CASE("an AVI holds the same, and the frame rate is that of the recording") {
  const RoomCopy copy;
  const fs::path file = copy.scratch.path() / "look.AVI";
  const Outcome outcome = copy.run("--stride 2 --no-report --video " + file.string());
  INFO(outcome.text);
  REQUIRE(outcome.code == 0);
  REQUIRE(decode(file).size() == kFrames / 2);
  REQUIRE(cv::VideoCapture(file.string()).get(cv::CAP_PROP_FPS) == Approx(15).margin(0.05));
}

TEST_CASE("a video makes no difference to the run") {
  const RoomCopy copy;
  REQUIRE(copy.run("--end 30").code == 0);
  const std::string trajectory = text_of(copy.out / "trajectory.txt"),
                    views = text_of(copy.out / "views.bin");
  REQUIRE(copy.run("--end 30 --video " + (copy.out / "look.mp4").string()).code == 0);
  REQUIRE(text_of(copy.out / "trajectory.txt") == trajectory);
  REQUIRE(text_of(copy.out / "views.bin") == views);
  const std::string first = text_of(copy.out / "look.mp4");
  REQUIRE(copy.run("--end 30 --video " + (copy.out / "look.mp4").string()).code == 0);
  REQUIRE(text_of(copy.out / "look.mp4") == first);
}

TEST_CASE("a video that cannot be made is refused before the run") {
  const RoomCopy copy;
  const auto refused = [&](const fs::path& file, const std::string& what) {
    require_refused(copy.run("--video " + file.string()), what);
    REQUIRE_FALSE(fs::exists(copy.out / "frames.csv"));
  };
  const fs::path& scratch = copy.scratch.path();
  refused(scratch / "look.xyz", "look.xyz: is no name for a video; expected to end in .mp4 or .avi");
  refused(scratch / "look", "look: is no name for a video");
  refused(scratch / "nowhere/look.mp4", "look.mp4: cannot write: No such file or directory");
  fs::create_directory(scratch / "folder.mp4");
  refused(scratch / "folder.mp4", "folder.mp4: cannot write: is a folder");
  fs::create_symlink("/dev/null", scratch / "device.avi");
  refused(scratch / "device.avi", "/dev/null: is no ordinary file");
  require_no_leftover(scratch);
}

TEST_CASE("a run's input video is not overwritten by its overlay, and a broken one gets one line") {
  const RoomCopy copy;
  const fs::path video = copy.scratch.path() / "in.mp4";
  REQUIRE(copy.run("--end 20 --video " + video.string()).code == 0);
  const std::string bytes = text_of(video);
  write(copy.scratch.path() / "camera.yaml",
        "%YAML:1.0\n---\nCamera.fx: 360\nCamera.fy: 360\nCamera.cx: 239.5\nCamera.cy: 179.5\n");
  require_refused(run_program("run " + video.string() + " --quiet --normals none --video " + video.string() +
                              " --out " + (copy.scratch.path() / "again").string()),
                  "in.mp4: is the input; choose another name");
  REQUIRE(text_of(video) == bytes);
  fs::resize_file(video, bytes.size() / 2);
  require_refused(
      run_program("run " + video.string() + " --camera " + (copy.scratch.path() / "camera.yaml").string() +
                  " --out " + (copy.scratch.path() / "again").string()),
      "in.mp4: cannot open this video");
}

TEST_CASE("a video that a full disk cuts off is not left behind, and the results are kept") {
  const RoomCopy copy;
  const fs::path file = copy.scratch.path() / "look.avi";
  // No file may grow beyond this many blocks; the video would.
  const Outcome outcome = run_program("run " + copy.folder.string() +
                                          " --quiet --normals none --preset odometry --no-report --out " +
                                          copy.out.string() + " --video " + file.string(),
                                      "trap '' XFSZ; ulimit -f 3000; ");
  INFO(outcome.text);
  REQUIRE(outcome.code == 1);
  REQUIRE(outcome.text.find("sslam: error: " + file.string() + ": cannot write: not all frames") !=
          std::string::npos);
  REQUIRE_FALSE(fs::exists(file));
  require_no_leftover(copy.scratch.path());
  REQUIRE(fs::exists(copy.out / "trajectory.txt"));
}

TEST_CASE("a run that is interrupted leaves a video of what it had") {
  const RoomCopy copy;
  const fs::path file = copy.scratch.path() / "look.mp4";
  const Outcome outcome = interrupt_program("run " + copy.folder.string() + " --normals none --out " +
                                            copy.out.string() + " --video " + file.string());
  INFO(outcome.text);
  if (outcome.code == 0) WARN("the run was over before it could be interrupted");
  const std::size_t rows = states(copy.out).size();
  if (rows == 0) {
    REQUIRE_FALSE(fs::exists(file));
  } else {
    REQUIRE(decode(file).size() == rows);
  }
  require_no_leftover(copy.scratch.path());
}

}  // namespace video_test
