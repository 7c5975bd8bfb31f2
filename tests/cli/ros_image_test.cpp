// SPDX-License-Identifier: BSD-3-Clause
// The pixels of ROS's image messages, and how chunks of bags are packed.
#include "cli/input/ros_image.hpp"

#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <utility>

#include "cli/input/chunk_codec.hpp"
#include "support/catch.hpp"

namespace ros_image_test {

using namespace sslam;
using namespace sslam::cli;

io::ImageMessage message(std::uint32_t width, std::uint32_t height, std::string_view encoding,
                         std::uint32_t step, std::string_view data) {
  io::ImageMessage image;
  image.width = width;
  image.height = height;
  image.encoding = encoding;
  image.step = step;
  image.data = data;
  return image;
}

// Why there is no image.
std::string why_not(const io::ImageMessage& message) {
  std::string why;
  CHECK(colour_of(message, {}, why).empty());
  return why;
}

cv::Mat colour(const io::ImageMessage& message) {
  std::string why;
  cv::Mat image = colour_of(message, {}, why);
  INFO(why);
  REQUIRE_FALSE(image.empty());
  return image;
}

TEST_CASE("Each encoding of ROS's images becomes BGR") {
  using namespace std::string_view_literals;
  const cv::Vec3b red(0, 0, 255);
  const auto first = [](const io::ImageMessage& m) { return colour(m).at<cv::Vec3b>(0, 0); };
  CHECK(first(message(1, 1, "rgb8", 3, "\xff\0\0"sv)) == red);
  CHECK(first(message(1, 1, "bgr8", 3, "\0\0\xff"sv)) == red);
  CHECK(first(message(1, 1, "rgba8", 4, "\xff\0\0\x01"sv)) == red);
  CHECK(first(message(1, 1, "bgra8", 4, "\0\0\xff\x01"sv)) == red);
  CHECK(first(message(1, 1, "mono8", 1, "\x07"sv)) == cv::Vec3b(7, 7, 7));
  // U, Y, V, Y of a red, and the same with Y first.
  const cv::Vec3b uyvy = first(message(2, 1, "yuv422", 4, "\x5a\x51\xf0\x51"sv));
  CHECK((uyvy[2] > 230 && uyvy[0] < 25 && uyvy[1] < 25));
  CHECK(first(message(2, 1, "yuv422_yuy2", 4, "\x51\x5a\x51\xf0"sv)) == uyvy);
}

TEST_CASE("A Bayer pattern is named by its first row") {
  // Of a red scene, only what is under the red filter is bright.
  const auto scene = [](char a, char b, char c, char d) {
    std::string data;
    for (int row = 0; row < 4; ++row)
      for (int pair = 0; pair < 4; ++pair) data += row % 2 == 0 ? std::string{a, b} : std::string{c, d};
    return data;
  };
  const char on = '\xc8';
  const std::pair<const char*, std::string> patterns[] = {{"bayer_rggb8", scene(on, 0, 0, 0)},
                                                          {"bayer_grbg8", scene(0, on, 0, 0)},
                                                          {"bayer_gbrg8", scene(0, 0, on, 0)},
                                                          {"bayer_bggr8", scene(0, 0, 0, on)}};
  for (const auto& [name, data] : patterns) {
    const auto pixel = colour(message(8, 4, name, 8, data)).at<cv::Vec3b>(1, 3);
    INFO(name);
    CHECK(pixel[2] > 150);
    CHECK(pixel[0] < 50);
    CHECK(pixel[1] < 50);
  }
}

TEST_CASE("Rows of an image may be padded, and its numbers be in either order") {
  using namespace std::string_view_literals;
  const cv::Mat padded = colour(message(2, 2, "mono8", 3, "ab.cd"sv));
  CHECK(padded.at<cv::Vec3b>(1, 1)[0] == 'd');
  io::ImageMessage wide = message(1, 1, "mono16", 2, "\x01\x02"sv);
  CHECK(colour(wide).at<cv::Vec3w>(0, 0)[0] == 0x0201);
  wide.big_endian = true;
  CHECK(colour(wide).at<cv::Vec3w>(0, 0)[2] == 0x0102);
}

TEST_CASE("An image message that contradicts itself gives a reason, and no image") {
  using namespace std::string_view_literals;
  const auto says = [](const io::ImageMessage& m, const char* part) {
    return why_not(m).find(part) != std::string::npos;
  };
  CHECK(says(message(0, 4, "mono8", 4, "abcd"sv), "no pixels"));
  CHECK(says(message(2, 2, "mono8", 2, "abc"sv), "has fewer bytes than 2x2 pixels of mono8"));
  CHECK(says(message(4, 1, "mono8", 2, "abcd"sv), "has fewer bytes"));
  CHECK(says(message(1, 1, "h264\n", 1, "a"sv), "has the encoding h264?; read are mono8"));
  CHECK(says(message(3, 1, "yuv422", 6, "abcdef"sv), "size"));
  constexpr auto kMost = std::numeric_limits<std::uint32_t>::max();
  CHECK(says(message(kMost, kMost, "mono8", kMost, "abcd"sv), "more than 200 million"));
  CHECK(says(message(1, kMost, "mono8", 1, "abcd"sv), "more than 200 million"));
}

TEST_CASE("Depth is millimetres of 16 bit or metres, and 0 where nothing was measured") {
  using namespace std::string_view_literals;
  std::string why;
  CHECK(depth_of(message(1, 1, "16UC1", 2, "\xe8\x03"sv), why).at<std::uint16_t>(0, 0) == 1000);
  const float metres[] = {1.5F, std::numeric_limits<float>::quiet_NaN()};
  const cv::Mat depth =
      depth_of(message(2, 1, "32FC1", 8, {reinterpret_cast<const char*>(metres), sizeof metres}), why);
  CHECK(depth.at<float>(0, 0) == 1.5F);
  CHECK(depth.at<float>(0, 1) == 0.0F);
  CHECK(depth_of(message(1, 1, "rgb8", 3, "abc"sv), why).empty());
  CHECK(why.find("depth is 16UC1 or 32FC1") != std::string::npos);
}

TEST_CASE("A chunk is unpacked as it was packed, and not where its size is a lie") {
  std::string text;
  for (int i = 0; i < 300'000; ++i) text += static_cast<char>('a' + i * i % 23);
  for (const io::Packing packing : {io::Packing::kLz4, io::Packing::kZstd, io::Packing::kBzip2}) {
    const std::string packed = chunk_codec().pack(packing, text);
    CHECK(packed.size() < text.size());
    std::string out = "of before";
    CHECK(chunk_codec().unpack(packing, packed, text.size(), out));
    CHECK(out == text);
    CHECK_FALSE(chunk_codec().unpack(packing, packed, text.size() - 1, out));
    CHECK_FALSE(chunk_codec().unpack(packing, packed, text.size() + 1, out));
    CHECK_FALSE(chunk_codec().unpack(packing, packed.substr(0, packed.size() / 2), text.size(), out));
    CHECK_FALSE(chunk_codec().unpack(packing, "", text.size(), out));
    CHECK_FALSE(chunk_codec().unpack(packing, text, text.size(), out));
  }
  CHECK(chunk_codec().crc32("123456789") == 0xCBF43926U);  // the check value of CRC-32
}

}  // namespace ros_image_test
