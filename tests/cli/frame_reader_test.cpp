// SPDX-License-Identifier: BSD-3-Clause
// Frames on their way in: 16 bit, turned, and videos whose containers say nothing true.
#include "cli/input/frame_reader.hpp"

#include <opencv2/imgcodecs.hpp>
#include <opencv2/videoio.hpp>
#include <string>
#include <vector>

#include "cli/input/image_file.hpp"
#include "io/errors.hpp"
#include "sslam/io/datasets/open_dataset.hpp"
#include "support/scratch_folder.hpp"

namespace frame_reader_test {

using namespace sslam;
using namespace std::string_literals;
using testing::contains;

namespace {

constexpr int kWidth = 64, kHeight = 48;

// Frame i is grey of 10 i, with a white corner at the upper left.
std::filesystem::path write_video(const testing::ScratchFolder& scratch, const std::string& name,
                                  const char* code, int frames) {
  const auto path = scratch.path() / name;
  cv::VideoWriter video(path.string(), cv::VideoWriter::fourcc(code[0], code[1], code[2], code[3]), 10,
                        {kWidth, kHeight});
  REQUIRE(video.isOpened());
  for (int i = 0; i < frames; ++i) {
    cv::Mat image(kHeight, kWidth, CV_8UC3, cv::Scalar::all(10 * i));
    image(cv::Rect(0, 0, 16, 16)).setTo(cv::Scalar::all(255));
    video.write(image);
  }
  return path;
}

io::Dataset open_video(const std::filesystem::path& path, std::int64_t at_most = -1) {
  io::Dataset dataset = io::open_dataset(path);
  cli::list_video_frames(dataset, at_most);
  return dataset;
}

// The grey of frame i, away from the corner.
std::vector<int> greys(const io::Dataset& dataset) {
  cli::FrameReader reader(dataset);
  std::vector<int> values;
  for (const io::FrameEntry& entry : dataset.frames) {
    std::string why;
    const cv::Mat image = reader.read(entry, why);
    INFO(why);
    REQUIRE_FALSE(image.empty());
    values.push_back(image.at<cv::Vec3b>(image.rows / 2, image.cols / 2)[1]);
  }
  return values;
}

std::string patched(std::string bytes, const std::string& tag, std::size_t behind, const std::string& with) {
  const std::size_t at = bytes.find(tag);
  REQUIRE(at != std::string::npos);
  return bytes.replace(at + tag.size() + behind, with.size(), with);
}

// A GIF of one pixel: each frame is shown so many hundredths of a second.
std::string gif(const std::vector<char>& delays) {
  std::string bytes = "GIF89a\x01\0\x01\0\x80\0\0\0\0\0\xff\xff\xff"s;
  for (const char delay : delays)
    bytes += "\x21\xf9\x04\0"s + delay + "\0\0\0\x2c\0\0\0\0\x01\0\x01\0\0\x02\x02\x44\x01\0"s;
  return bytes + ";";
}

cv::Mat ramp(int low, int high) {
  cv::Mat image(kHeight, kWidth, CV_16UC1);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x)
      image.at<std::uint16_t>(y, x) = static_cast<std::uint16_t>(low + (high - low) * x / (kWidth - 1));
  return image;
}

}  // namespace

TEST_CASE("a video's frames are those that are there, whatever the container claims") {
  const testing::ScratchFolder scratch;
  const std::string whole = testing::text_of(write_video(scratch, "whole.avi", "MJPG", 7));
  // Numbers of frames stand in avih, behind 20 bytes, and in strh, behind 36.
  for (const std::string& count : {"\0\0\0\0"s, "\x02\0\0\0"s, "\xff\xff\xff\x7f"s}) {
    const auto path =
        scratch.write("claims.avi", patched(patched(whole, "avih", 20, count), "strh", 36, count));
    const io::Dataset dataset = open_video(path);
    REQUIRE(dataset.frames.size() == 7);
    CHECK(dataset.frames[6].stamp == Approx(0.6));
    CHECK(dataset.warnings.size() == (count[0] == '\xff' ? 1U : 0U));
    CHECK(open_video(path, 3).frames.size() == 3);
    const std::vector<int> values = greys(dataset);
    for (int i = 0; i < 7; ++i) CHECK(values[static_cast<std::size_t>(i)] == Approx(10 * i).margin(4));
  }
}

TEST_CASE("a video says where its pixels are not square, and its rows of two moments") {
  const testing::ScratchFolder scratch;
  // YUV4MPEG2, which says both in its first line, under the name of another container.
  const auto video = [&](const std::string& what) {
    std::string bytes = "YUV4MPEG2 W16 H16 F10:1 " + what + " C420jpeg\n";
    for (int i = 0; i < 3; ++i) bytes += "FRAME\n" + std::string(16 * 16 * 3 / 2, '\x80');
    return open_video(scratch.write("film.avi", bytes));
  };
  CHECK(video("Ip A1:1").warnings.empty());
  const io::Dataset dataset = video("It A2:1");
  REQUIRE(dataset.frames.size() == 3);
  REQUIRE(dataset.warnings.size() == 2);
  CHECK(contains(dataset.warnings[0], "film.avi: its pixels are 2 times as wide as high"));
  CHECK(contains(dataset.warnings[1], "film.avi: is interlaced"));
}

TEST_CASE("stamps are the times in the container, also where frames do not come evenly") {
  const testing::ScratchFolder scratch;
  const io::Dataset dataset = open_video(scratch.write("uneven.gif", gif({10, 30, 20, 40})));
  REQUIRE(dataset.frames.size() == 4);
  CHECK(dataset.frames[0].stamp == 0);
  CHECK(dataset.frames[1].stamp == Approx(0.1));
  CHECK(dataset.frames[2].stamp == Approx(0.4));
  CHECK(dataset.frames[3].stamp == Approx(0.6));
  CHECK(greys(dataset).size() == 4);
}

TEST_CASE("a slice of a video reads the frames that it names") {
  const testing::ScratchFolder scratch;
  io::Dataset dataset = open_video(write_video(scratch, "whole.mp4", "mp4v", 9), 8);
  io::apply_slice(dataset, {3, 8, 2});
  const std::vector<int> values = greys(dataset);
  REQUIRE(values.size() == 3);
  for (int i = 0; i < 3; ++i) CHECK(values[static_cast<std::size_t>(i)] == Approx(30 + 20 * i).margin(4));
}

TEST_CASE("a video's tag turns its frames as players do, but for a calibration of the stored pixels") {
  const testing::ScratchFolder scratch;
  // The matrix stands in tkhd, behind 40 bytes: turned by 90 degrees clockwise.
  const std::string matrix = "\0\0\0\0\0\x01\0\0\0\0\0\0\xff\xff\0\0\0\0\0\0"s;
  const std::string plain = testing::text_of(write_video(scratch, "plain.mp4", "mp4v", 2));
  const io::Dataset dataset = open_video(scratch.write("turned.mp4", patched(plain, "tkhd", 40, matrix)));
  std::string why;
  for (const cv::Size camera : {cv::Size(), cv::Size(kHeight, kWidth)}) {
    const cv::Mat image = cli::FrameReader(dataset, camera).read(dataset.frames[0], why);
    REQUIRE(image.size() == cv::Size(kHeight, kWidth));
    CHECK(image.at<cv::Vec3b>(4, kHeight - 4)[0] > 200);  // the corner has gone to the upper right
    CHECK(image.at<cv::Vec3b>(4, 4)[0] < 50);
  }
  const cv::Mat stored = cli::FrameReader(dataset, {kWidth, kHeight}).read(dataset.frames[0], why);
  REQUIRE(stored.size() == cv::Size(kWidth, kHeight));
  CHECK(stored.at<cv::Vec3b>(4, 4)[0] > 200);
  CHECK(cli::FrameReader(dataset, {100, 100}).read(dataset.frames[0], why).empty());
  CHECK(contains(why, "has 64x48 pixels, and the camera 100x100"));
}

TEST_CASE("a video's tag that is no right angle is told, and one that nearly is counts as such") {
  const testing::ScratchFolder scratch;
  const std::string plain = testing::text_of(write_video(scratch, "plain.mp4", "mp4v", 3));
  // a and b, of 65536: by 30 degrees, and by 90 but for what was rounded.
  const auto with = [&](const std::string& a, const std::string& b, const std::string& c) {
    const std::string zero = "\0\0\0\0"s, matrix = a + b + zero + c + a;
    return open_video(scratch.write("turned.mp4", patched(plain, "tkhd", 40, matrix)));
  };
  SECTION("by 30 degrees") {
    const io::Dataset dataset = with("\0\0\xdd\xb4"s, "\0\0\x80\0"s, "\xff\xff\x80\0"s);
    REQUIRE(dataset.warnings.size() == 1);
    CHECK(contains(dataset.warnings[0],
                   "its tag turns it by 30 degrees, which is no multiple of 90: the "
                   "images are read as they are stored"));
  }
  SECTION("by nearly 90 degrees") {
    const io::Dataset dataset = with("\0\0\0\3"s, "\0\1\0\0"s, "\xff\xff\0\0"s);
    CHECK(dataset.warnings.empty());
    std::string why;
    CHECK(cli::FrameReader(dataset).read(dataset.frames[0], why).size() == cv::Size(kHeight, kWidth));
  }
}

TEST_CASE("images of 16 bit are read by the range that the first frames use, and it is held") {
  const testing::ScratchFolder scratch;
  const auto read = [&](const std::vector<cv::Mat>& images, std::size_t index) {
    for (std::size_t i = 0; i < images.size(); ++i)
      REQUIRE(cv::imwrite((scratch.path() / (std::to_string(i) + ".png")).string(), images[i]));
    const io::Dataset dataset = io::read_image_folder(scratch.path());
    cli::FrameReader reader(dataset);
    std::string why;
    const cv::Mat image = reader.read(dataset.frames[index], why);
    REQUIRE(image.type() == CV_8UC3);
    return std::pair{image.at<cv::Vec3b>(0, 0)[0], image.at<cv::Vec3b>(0, kWidth - 1)[0]};
  };
  const std::vector<std::pair<int, int>> ranges{{0, 1000}, {0, 4080}, {100, 16000}, {0, 65535}};
  for (const auto& [low, high] : ranges) {
    const auto [dark, bright] = read({ramp(low, high)}, 0);
    INFO(high);
    CHECK(dark < 5);
    CHECK(bright > 235);
  }
  // A thermal camera: a narrow band, far from 0, and one hot pixel.
  cv::Mat thermal = ramp(29000, 31000);
  thermal.at<std::uint16_t>(20, 20) = 65535;
  const auto [cold, warm] = read({thermal}, 0);
  CHECK(warm - cold > 140);
  // A darker frame later on stays darker.
  std::vector<cv::Mat> images(9, ramp(0, 4080));
  images.back() = ramp(0, 1020);
  CHECK(read(images, 8).second == Approx(64).margin(2));
}

TEST_CASE("a depth image that is none is named, with what it should be") {
  const testing::ScratchFolder scratch;
  io::Dataset dataset;
  io::FrameEntry frame;
  frame.depth = (scratch.path() / "d.png").string();
  cli::FrameReader reader(dataset);
  std::string why;
  for (const int type : {CV_8UC1, CV_8UC3, CV_16UC3}) {
    REQUIRE(cv::imwrite(frame.depth, cv::Mat(kHeight, kWidth, type, cv::Scalar::all(7))));
    CHECK(reader.read_depth(frame, why).empty());
    CHECK(contains(why, "d.png: is no depth image, with "));
  }
  REQUIRE(cv::imwrite(frame.depth, cv::Mat(kHeight, kWidth, CV_16UC1, cv::Scalar(7))));
  CHECK(reader.read_depth(frame, why).type() == CV_16UC1);
}

}  // namespace frame_reader_test
