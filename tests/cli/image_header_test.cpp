// SPDX-License-Identifier: BSD-3-Clause
// Images by their content: whatever they are called, and whatever stands behind their end.
#include "cli/input/image_header.hpp"

#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

#include "cli/input/image_file.hpp"
#include "io/errors.hpp"
#include "support/scratch_folder.hpp"

namespace image_header_test {

using namespace sslam;
using testing::contains;

namespace {

std::string encoded(const char* extension, const cv::Mat& image) {
  std::vector<unsigned char> bytes;
  REQUIRE(cv::imencode(extension, image, bytes));
  return {bytes.begin(), bytes.end()};
}

// As cameras write it: a segment with EXIF behind the start of a JPEG.
std::string with_orientation(const std::string& jpeg, char orientation) {
  using namespace std::string_literals;
  const std::string exif =
      "Exif\0\0MM\0*\0\0\0\x08\0\x01\x01\x12\0\x03\0\0\0\x01\0"s + orientation + "\0\0\0\0\0\0"s;
  const std::string segment = "\xff\xe1"s + '\0' + static_cast<char>(exif.size() + 2) + exif;
  return jpeg.substr(0, 2) + segment + jpeg.substr(2);
}

cli::ImageHeader header_of(const std::string& bytes) {
  return cli::read_image_header({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()});
}

// White on the left, black on the right.
cv::Mat halves() {
  cv::Mat image(24, 40, CV_8UC3, cv::Scalar::all(0));
  image.colRange(0, 20).setTo(cv::Scalar::all(255));
  return image;
}

}  // namespace

TEST_CASE("an image is what its bytes say, whatever its name") {
  const testing::ScratchFolder scratch;
  for (const auto& [format, name] :
       {std::pair{".jpg", "a.png"}, std::pair{".png", "a.jpg"}, std::pair{".webp", "b.png"}}) {
    const auto path = scratch.write(name, encoded(format, halves()));
    std::string why;
    INFO(format);
    CHECK(cli::load_image(path, cv::IMREAD_COLOR, why).size() == cv::Size(40, 24));
    CHECK(why.empty());
  }
}

TEST_CASE("bytes behind the end of an image do no harm, and a lost end is seen all the same") {
  const testing::ScratchFolder scratch;
  for (const char* format : {".jpg", ".png"}) {
    const std::string whole = encoded(format, halves()), trailer(5000, 'x');
    // An end inside the trailer, such as that of a thumbnail or of a second picture, is not this image's end.
    const std::string cut = whole.substr(0, whole.size() - 20);
    std::string why;
    INFO(format);
    CHECK(cli::load_image(scratch.write("whole", whole + trailer), cv::IMREAD_COLOR, why).size() ==
          cv::Size(40, 24));
    CHECK(cli::load_image(scratch.write("cut", cut), cv::IMREAD_COLOR, why).empty());
    CHECK(contains(why, "cut: truncated image"));
  }
}

TEST_CASE("the size and the orientation stand in the header") {
  const std::string jpeg = encoded(".jpg", halves());
  for (const char* format : {".jpg", ".png", ".webp", ".bmp", ".tiff"}) {
    INFO(format);
    CHECK(header_of(encoded(format, halves())).size == cv::Size(40, 24));
    CHECK(header_of(encoded(format, halves())).turn == cli::kUpright);
  }
  for (char orientation = 1; orientation <= 8; ++orientation) {
    const cli::ImageHeader header = header_of(with_orientation(jpeg, orientation));
    CHECK(header.turn == orientation);
    CHECK(header.complete);
  }
  CHECK(header_of(with_orientation(jpeg, 9)).turn == cli::kUpright);
  CHECK(header_of("no image").size.empty());
}

TEST_CASE("images are turned as OpenCV turns them, and stay as stored where nobody asks") {
  const testing::ScratchFolder scratch;
  for (char orientation = 1; orientation <= 8; ++orientation) {
    const auto path =
        scratch.write("turned.jpg", with_orientation(encoded(".jpg", halves()), orientation)).string();
    std::string why;
    const cv::Mat stored = cli::load_image(path, cv::IMREAD_COLOR, why);
    INFO(int(orientation));
    REQUIRE(stored.size() == cv::Size(40, 24));
    const cv::Mat turned = cli::turned_image(stored, orientation), expected = cv::imread(path);
    REQUIRE(turned.size() == expected.size());
    CHECK(cv::norm(turned, expected, cv::NORM_INF) == 0);
    CHECK(turned.size() == cli::turned_size(stored.size(), orientation));
  }
}

TEST_CASE("an image that claims more pixels than any camera has is not decoded") {
  const testing::ScratchFolder scratch;
  std::string png = encoded(".png", halves());
  png.replace(16, 8, std::string("\0\0\x4e\x20\0\0\x4e\x20", 8));  // 20000x20000
  const auto path = scratch.write("bomb.png", png);
  std::string why;
  CHECK(cli::load_image(path, cv::IMREAD_COLOR, why).empty());
  CHECK(contains(why, "bomb.png: claims 20000x20000 pixels, more than 200 million"));
}

}  // namespace image_header_test
