// SPDX-License-Identifier: BSD-3-Clause
// Masks as people's programs store them.
#include "cli/input/mask_source.hpp"

#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

#include "io/errors.hpp"
#include "support/catch.hpp"
#include "support/scratch_folder.hpp"

namespace mask_source_test {

using namespace sslam;
using testing::contains;

namespace {

const cv::Size kSize(64, 48);

struct Masks {
  testing::ScratchFolder scratch;

  std::filesystem::path write(const std::string& name, const cv::Mat& pixels) const {
    const std::filesystem::path file = scratch.path() / name;
    std::filesystem::create_directories(file.parent_path());
    REQUIRE(cv::imwrite(file.string(), pixels));
    return file;
  }
  static std::string error(const std::filesystem::path& path) {
    return testing::error_of([&] { (void)cli::MaskSource(path, kSize); });
  }
};

// The left third is left out.
cv::Mat third(const cv::Scalar& left = cv::Scalar::all(0), int type = CV_8UC1) {
  cv::Mat pixels(kSize, type, cv::Scalar::all(255));
  pixels.colRange(0, 21).setTo(left);
  return pixels;
}

int used(const cli::MaskSource& masks, const std::string& stem = "a") {
  std::string why;
  const cv::Mat mask = masks.of(stem, why);
  INFO(why);
  return mask.empty() ? -1 : cv::countNonZero(mask);
}

constexpr int kTwoThirds = 43 * 48;

}  // namespace

TEST_CASE("A mask stored as JPEG is parted at half, with a warning") {
  const Masks masks;
  const cli::MaskSource jpeg(masks.write("m.jpg", third()), kSize);
  CHECK(used(jpeg) == kTwoThirds);
  REQUIRE(jpeg.warnings().size() == 1);
  CHECK(contains(jpeg.warnings()[0], "m.jpg: is a JPEG, which has no exact 0"));
  std::filesystem::rename(masks.scratch.path() / "m.jpg", masks.scratch.path() / "m.png");
  CHECK(used(cli::MaskSource(masks.scratch.path() / "m.png", kSize)) == kTwoThirds);
  CHECK(contains(Masks::error(masks.write("black.jpg", cv::Mat::zeros(kSize, CV_8UC1))),
                 "black.jpg: leaves every pixel out"));
  CHECK(contains(Masks::error(masks.write("grey.jpg", third(cv::Scalar::all(128)))),
                 "grey.jpg: is a JPEG, and 33 % of it is neither black nor white; store it as PNG"));
}

TEST_CASE("Anything but 0 is used, in any colour and of any depth") {
  const Masks masks;
  cv::Mat dark(kSize, CV_8UC3, cv::Scalar(1, 0, 0));
  dark.colRange(0, 21).setTo(0);
  const cli::MaskSource blue(masks.write("blue.png", dark), kSize);
  CHECK(used(blue) == kTwoThirds);
  CHECK(blue.warnings().empty());
  CHECK(used(cli::MaskSource(masks.write("deep.png", third({}, CV_16UC1)), kSize)) == kTwoThirds);
}

TEST_CASE("A mask with transparency is refused, and one that leaves out nothing or nearly all is doubted") {
  const Masks masks;
  CHECK(contains(Masks::error(masks.write("alpha.png", third(cv::Scalar(255, 255, 255, 0), CV_8UC4))),
                 "alpha.png: the mask has transparency, whose meaning is not defined"));
  const cli::MaskSource white(masks.write("white.png", cv::Mat(kSize, CV_8UC1, cv::Scalar(255))), kSize);
  REQUIRE(white.warnings().size() == 1);
  CHECK(contains(white.warnings()[0], "white.png: leaves nothing out"));
  cv::Mat inverted = cv::Mat::zeros(kSize, CV_8UC1);
  inverted.rowRange(0, 6).setTo(255);
  const cli::MaskSource most(masks.write("most.png", inverted), kSize);
  REQUIRE(most.warnings().size() == 1);
  CHECK(contains(most.warnings()[0], "most.png: leaves 88 % of the image out; 0 is left out"));
}

TEST_CASE("A folder's masks belong to frames by name, whatever their ending") {
  const Masks masks;
  for (const char* name : {"f/a.png", "f/b.JPG", "f/c.jpg.png", "f/1.25.png"})
    (void)masks.write(name, third());
  const cli::MaskSource folder(masks.scratch.path() / "f", kSize);
  for (const char* stem : {"a", "b", "c", "1.25"}) {
    CAPTURE(stem);
    CHECK(used(folder, stem) == kTwoThirds);
  }
  std::string why;
  CHECK(folder.of("d", why).empty());
  CHECK(contains(why, "f: holds no mask d.png"));

  std::filesystem::create_directories(masks.scratch.path() / "empty");
  CHECK(contains(Masks::error(masks.scratch.path() / "empty"), "empty: holds no mask; expected NAME.png"));
  (void)masks.write("small/a.png", cv::Mat::ones(4, 4, CV_8UC1));
  CHECK(contains(Masks::error(masks.scratch.path() / "small"),
                 "a.png: the mask has 4x4 pixels, and the images 64x48"));
}

}  // namespace mask_source_test
