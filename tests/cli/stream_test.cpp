// SPDX-License-Identifier: BSD-3-Clause
// Parts of a stream: images cut out of bytes that come in pieces, and stamps from clocks that misbehave.
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

#include "cli/stream/image_splitter.hpp"
#include "cli/stream/stamp_clock.hpp"
#include "cli/stream/stream_name.hpp"
#include "support/catch.hpp"
#include "support/scratch_folder.hpp"

namespace stream_test {

using namespace sslam;

namespace {

using File = std::vector<std::uint8_t>;

File encoded(const char* extension, int seed) {
  cv::Mat image(30, 40, extension == std::string(".pgm") ? CV_8UC1 : CV_8UC3);
  cv::RNG random(static_cast<std::uint64_t>(seed));
  random.fill(image, cv::RNG::UNIFORM, 0, 256);
  File file;
  REQUIRE(cv::imencode(extension, image, file));
  return file;
}

// All images of these bytes when they come in pieces of so many.
std::vector<File> split(const File& bytes, std::size_t piece) {
  cli::ImageSplitter splitter;
  std::vector<File> images;
  for (std::size_t at = 0; at < bytes.size(); at += piece) {
    splitter.add(cli::Bytes(bytes).subspan(at, std::min(piece, bytes.size() - at)));
    while (auto image = splitter.next()) images.push_back(std::move(*image));
  }
  return images;
}

void append(File& bytes, const File& more) {
  bytes.insert(bytes.end(), more.begin(), more.end());
}

}  // namespace

TEST_CASE("images are cut out of a stream, whatever pieces it comes in") {
  std::vector<File> files;
  File bytes;
  for (const char* format : {".jpg", ".png", ".ppm", ".pgm", ".bmp", ".webp", ".jpg", ".ppm"}) {
    files.push_back(encoded(format, static_cast<int>(files.size())));
    append(bytes, files.back());
  }
  for (const std::size_t piece : {std::size_t{1}, std::size_t{17}, std::size_t{1000}, bytes.size()}) {
    INFO(piece);
    CHECK(split(bytes, piece) == files);
  }
}

TEST_CASE("an image is given as soon as it is whole") {
  for (const char* format : {".jpg", ".png", ".ppm", ".bmp", ".webp"}) {
    INFO(format);
    const File file = encoded(format, 1);
    CHECK(split(file, 1).size() == 1);
    CHECK(split({file.begin(), file.end() - 1}, 1).empty());
  }
}

TEST_CASE("what lies between images is passed over, and a torn image does not take the next one with it") {
  const File first = encoded(".jpg", 1), last = encoded(".jpg", 2);
  File bytes = first;
  append(bytes, {'\r', '\n', '-', '-', 'x', 0, 0xff, '\n'});
  append(bytes, {first.begin(), first.begin() + 900});
  append(bytes, last);
  const std::vector<File> images = split(bytes, 64);
  REQUIRE(images.size() == 3);
  CHECK(images[0] == first);
  CHECK_FALSE(cli::read_image_header(images[1]).complete);
  CHECK(images[2] == last);
}

TEST_CASE("stamps of a stream begin at 0 and increase, whatever its clock does") {
  const auto at = [](double seconds) {
    return cli::StampClock::Clock::time_point{} +
           std::chrono::duration_cast<cli::StampClock::Clock::duration>(
               std::chrono::duration<double>(seconds));
  };
  cli::StampClock camera(true, 30);
  CHECK(camera.stamp(1000.0, at(5)) == 0);
  CHECK(camera.stamp(1000.04, at(5.2)) == 0.04);    // when it was taken, not when it came
  CHECK(camera.stamp(10.0, at(5.5)) == 0.5);        // its clock was set
  CHECK(camera.stamp(10.04, at(5.6)) == 0.54);      // and goes on from there
  CHECK(camera.stamp(99999.0, at(6)) == 1);         // again
  CHECK(camera.stamp(99999.0, at(6)) == 1.000001);  // stands still
  camera.reconnect();
  CHECK(camera.stamp(3.0, at(25)) == 20);
  CHECK(camera.stamp(3.5, at(25.1)) == 20.5);
  CHECK(camera.stamp(std::nullopt, at(26)) == 21);

  cli::StampClock pipe(false, 25);
  for (int i = 0; i < 100; ++i) CHECK(pipe.stamp(std::nullopt, at(i * i)) == Approx(i / 25.0).margin(1e-6));
  cli::StampClock video(false, 25);
  CHECK(video.stamp(7.0, at(0)) == 0);
  CHECK(video.stamp(3607.0, at(0)) == 3600);  // a pause in a recording is believed
}

TEST_CASE("a stream is told from a file by its name") {
  const testing::ScratchFolder scratch;
  using cli::StreamKind;
  const auto kind = [](const std::string& text) {
    const auto name = cli::stream_named(text);
    return name ? std::optional(name->kind) : std::nullopt;
  };
  CHECK(kind("-") == StreamKind::kPipe);
  CHECK(kind("0") == StreamKind::kDevice);
  CHECK(kind("/dev/video7") == StreamKind::kDevice);
  CHECK(kind("rtsp://user:secret@camera/stream") == StreamKind::kUrl);
  CHECK(kind("HTTP://camera:8080/") == StreamKind::kUrl);
  const auto shown = [](const std::string& text) { return cli::shown_name(cli::stream_named(text).value()); };
  CHECK(shown("rtsp://user:se:cr@et@camera:8554/x@y:z") == "rtsp://user:...@camera:8554/x@y:z");
  CHECK(shown("http://user@camera:8080/x") == "http://user@camera:8080/x");
  CHECK(shown("http://camera:8080/x") == "http://camera:8080/x");
  CHECK(shown("-") == "standard input");
  CHECK_FALSE(kind("walk.mp4"));
  CHECK_FALSE(kind("://"));
  CHECK_FALSE(kind("photos/left_*.png"));
  CHECK_FALSE(kind(scratch.write("7", "a file").string()));
}

}  // namespace stream_test
