// SPDX-License-Identifier: BSD-3-Clause
// Files of images that hold more than one: animations and pages.
#include <array>
#include <cstdint>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

#include "cli/input/frame_reader.hpp"
#include "cli/input/image_file.hpp"
#include "cli/input/open_images.hpp"
#include "io/errors.hpp"
#include "support/scratch_folder.hpp"

namespace animated_test {

using namespace sslam;
using namespace std::string_literals;
using testing::contains;
using testing::error_of;

namespace {

constexpr int kWidth = 40, kHeight = 24;
constexpr std::array kGreys{40, 120, 200};

cv::Mat picture(int grey) {
  return {kHeight, kWidth, CV_8UC3, cv::Scalar::all(grey)};
}

std::string encoded(const char* extension, int grey, const std::vector<int>& parameters = {}) {
  std::vector<unsigned char> bytes;
  REQUIRE(cv::imencode(extension, picture(grey), bytes, parameters));
  return {bytes.begin(), bytes.end()};
}

std::string big_endian(std::uint32_t value, int size) {
  std::string text;
  for (int i = size - 1; i >= 0; --i) text += static_cast<char>(value >> (8 * i) & 0xff);
  return text;
}

std::string little_endian(std::uint32_t value, int size) {
  const std::string text = big_endian(value, size);
  return {text.rbegin(), text.rend()};
}

std::string png_chunk(const std::string& name, const std::string& data) {
  std::uint32_t sum = 0xffffffff;
  for (const char c : name + data) {
    sum ^= static_cast<unsigned char>(c);
    for (int bit = 0; bit < 8; ++bit) sum = (sum & 1) != 0 ? 0xedb88320 ^ sum >> 1 : sum >> 1;
  }
  return big_endian(static_cast<std::uint32_t>(data.size()), 4) + name + data + big_endian(~sum, 4);
}

// The data of all chunks of this name.
std::string png_data(const std::string& png, const std::string& name) {
  std::string data;
  for (std::size_t at = 8; at + 12 <= png.size();) {
    std::uint32_t size = 0;
    for (std::size_t i = 0; i < 4; ++i) size = size << 8 | static_cast<unsigned char>(png[at + i]);
    if (png.substr(at + 4, 4) == name) data += png.substr(at + 8, size);
    at += 12 + size;
  }
  return data;
}

// Each picture stays for a tenth of a second.
std::string animated_png() {
  std::string all;
  std::uint32_t number = 0;
  for (const int grey : kGreys) {
    const std::string png = encoded(".png", grey);
    if (all.empty())
      all = png.substr(0, 8) + png_chunk("IHDR", png_data(png, "IHDR")) +
            png_chunk("acTL", big_endian(kGreys.size(), 4) + big_endian(0, 4));
    all += png_chunk("fcTL", big_endian(number++, 4) + big_endian(kWidth, 4) + big_endian(kHeight, 4) +
                                 big_endian(0, 8) + big_endian(1, 2) + big_endian(10, 2) + "\0\0"s);
    if (number == 1)
      all += png_chunk("IDAT", png_data(png, "IDAT"));
    else
      all += png_chunk("fdAT", big_endian(number++, 4) + png_data(png, "IDAT"));
  }
  return all + png_chunk("IEND", "");
}

std::string riff_chunk(const std::string& name, const std::string& data) {
  return name + little_endian(static_cast<std::uint32_t>(data.size()), 4) + data;
}

std::string animated_webp() {
  const std::string size = little_endian(kWidth - 1, 3) + little_endian(kHeight - 1, 3);
  std::string parts = riff_chunk("VP8X", "\2\0\0\0"s + size) + riff_chunk("ANIM", std::string(6, '\0'));
  for (const int grey : kGreys)
    parts += riff_chunk("ANMF", std::string(6, '\0') + size + little_endian(100, 3) + "\0"s +
                                    encoded(".webp", grey, {cv::IMWRITE_WEBP_QUALITY, 90}).substr(12));
  return riff_chunk("RIFF", "WEBP" + parts);
}

std::filesystem::path write_pages(const testing::ScratchFolder& scratch) {
  const std::filesystem::path path = scratch.path() / "pages.tif";
  std::vector<cv::Mat> pages;
  for (const int grey : kGreys) pages.push_back(picture(grey));
  REQUIRE(cv::imwritemulti(path.string(), pages));
  return path;
}

}  // namespace

TEST_CASE("an animated PNG is a video with its own times, whatever its name ends with") {
  const testing::ScratchFolder scratch;
  for (const char* name : {"walk.png", "walk.apng"}) {
    INFO(name);
    const io::Dataset dataset = cli::open_frames(scratch.write(name, animated_png()));
    CHECK(dataset.layout == io::Layout::kVideo);
    REQUIRE(dataset.frames.size() == kGreys.size());
    cli::FrameReader reader(dataset);
    for (std::size_t i = 0; i < kGreys.size(); ++i) {
      CHECK(dataset.frames[i].stamp == Approx(0.1 * static_cast<double>(i)));
      std::string why;
      const cv::Mat image = reader.read(dataset.frames[i], why);
      REQUIRE(image.size() == cv::Size(kWidth, kHeight));
      CHECK(cv::norm(image, picture(kGreys[i]), cv::NORM_INF) <= 1);
    }
  }
}

TEST_CASE("an animated WebP and pages of a TIFF are refused, with what splits them") {
  const testing::ScratchFolder scratch;
  for (const auto& path : {scratch.write("walk.webp", animated_webp()), write_pages(scratch)}) {
    const std::string text = error_of([&] { (void)cli::open_frames(path); });
    CHECK(text == path.string() +
                      ": holds several images, which are not read as a video; `convert FILE -coalesce "
                      "FOLDER/%06d.png` of ImageMagick splits it");
  }
}

TEST_CASE("a single image of each of these formats is told that a run needs many") {
  const testing::ScratchFolder scratch;
  for (const char* format : {".png", ".webp", ".tif"}) {
    const auto path = scratch.write(std::string("one") + format, encoded(format, 90));
    CHECK(contains(error_of([&] { (void)cli::open_frames(path); }), "is one image; a run needs many"));
    std::string why;
    CHECK_FALSE(cli::load_image(path, cv::IMREAD_COLOR, why).empty());
  }
}

TEST_CASE("an animated WebP among images says why it cannot be decoded") {
  const testing::ScratchFolder scratch;
  std::string why;
  const cv::Mat image = cli::load_image(scratch.write("walk.webp", animated_webp()), cv::IMREAD_COLOR, why);
  if (image.empty())  // later versions of OpenCV give the first
    CHECK(contains(why, "walk.webp: cannot decode this image: it holds several images; `convert FILE"));
}

TEST_CASE("a preview beside the image of a TIFF is no second page") {
  // Two directories without pixels: the second says that it is a smaller copy.
  const auto directory = [](std::uint32_t kind, std::uint32_t next) {
    const auto entry = [](std::uint32_t tag, std::uint32_t value) {
      return little_endian(tag, 2) + little_endian(4, 2) + little_endian(1, 4) + little_endian(value, 4);
    };
    return little_endian(3, 2) + entry(0xfe, kind) + entry(0x100, 40) + entry(0x101, 24) +
           little_endian(next, 4);
  };
  const auto header_of = [&](std::uint32_t kind) {
    constexpr std::uint32_t kFirst = 8, kSecond = kFirst + 2 + 3 * 12 + 4;
    const std::string bytes =
        "II*\0"s + little_endian(kFirst, 4) + directory(0, kSecond) + directory(kind, 0);
    return cli::read_image_header({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()});
  };
  CHECK(header_of(2).several);
  CHECK_FALSE(header_of(1).several);
  CHECK(header_of(1).size == cv::Size(40, 24));
}

TEST_CASE("A photo that is named as a video is told as one, and bare MJPEG is a video") {
  const testing::ScratchFolder scratch;
  const std::string photo = encoded(".jpg", 120);
  const auto complaint = [&](const std::string& name, const std::string& bytes) {
    const auto file = scratch.write(name, bytes);
    return error_of([&] { (void)cli::open_frames(file, {}, {}); });
  };
  CHECK(contains(complaint("walk.mp4", photo), "is one image, whatever its name says"));
  CHECK(contains(complaint("walk.avi", encoded(".png", 120)), "is one image, whatever its name says"));
  CHECK(complaint("walk.mjpeg", photo + encoded(".jpg", 40)).empty());
}

}  // namespace animated_test
