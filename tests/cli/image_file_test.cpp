// SPDX-License-Identifier: BSD-3-Clause
// Images that lost their end.
#include "cli/input/image_file.hpp"

#include <opencv2/imgproc.hpp>
#include <vector>

#include "io/errors.hpp"
#include "sslam/core/random.hpp"
#include "sslam/io/datasets/video.hpp"
#include "support/scratch_folder.hpp"

namespace image_file_test {

using namespace sslam;
using testing::contains;

namespace {

cv::Mat noise_image() {
  cv::Mat image(48, 64, CV_8UC3);
  Random random(1);
  for (int i = 0; i < 48 * 64 * 3; ++i) image.data[i] = static_cast<unsigned char>(random.below(256));
  return image;
}

}  // namespace

TEST_CASE("Whole images are decoded and others are refused by name") {
  const testing::ScratchFolder scratch;
  const cv::Mat image = noise_image();
  for (const char* name : {"a.png", "a.jpg"}) {
    const std::string path = (scratch.path() / name).string();
    REQUIRE(cv::imwrite(path, image));
    std::string why;
    CHECK(cli::load_image(path, cv::IMREAD_COLOR, why).size() == image.size());
    CHECK(why.empty());
    const std::string bytes = testing::text_of(path);
    for (const std::size_t kept : {bytes.size() / 2, bytes.size() - 20, std::size_t{10}, std::size_t{0}}) {
      scratch.write(std::string("cut_") + name, bytes.substr(0, kept));
      CHECK(cli::load_image(scratch.path() / (std::string("cut_") + name), cv::IMREAD_COLOR, why).empty());
      CHECK(contains(why, std::string("cut_") + name + ": truncated image"));
    }
  }
  std::string why;
  scratch.write("text.bmp", "no image at all");
  CHECK(cli::load_image(scratch.path() / "text.bmp", cv::IMREAD_COLOR, why).empty());
  CHECK(contains(why, "text.bmp: cannot decode this image"));
  scratch.write("pointer.png", "version https://git-lfs.github.com/spec/v1\noid sha256:0\nsize 9\n");
  CHECK(cli::load_image(scratch.path() / "pointer.png", cv::IMREAD_COLOR, why).empty());
  CHECK(contains(why, "pointer.png: cannot decode this image: it is a pointer of Git LFS"));
  CHECK(cli::load_image(scratch.path() / "none.png", cv::IMREAD_COLOR, why).empty());
  CHECK(contains(why, "none.png: no such image"));
}

TEST_CASE("Depth that 7-Scenes did not measure becomes 0") {
  const testing::ScratchFolder scratch;
  cv::Mat depth(4, 4, CV_16UC1, cv::Scalar(1500));
  depth.at<std::uint16_t>(1, 2) = 65535;
  const auto path = scratch.path() / "d.png";
  REQUIRE(cv::imwrite(path.string(), depth));
  std::string why;
  CHECK(cli::load_depth(path, io::Layout::kSevenScenes, why).at<std::uint16_t>(1, 2) == 0);
  CHECK(cli::load_depth(path, io::Layout::kSevenScenes, why).at<std::uint16_t>(0, 0) == 1500);
  CHECK(cli::load_depth(path, io::Layout::kTum, why).at<std::uint16_t>(1, 2) == 65535);
}

TEST_CASE("A file that is no video is refused by name") {
  const testing::ScratchFolder scratch;
  io::Dataset dataset = io::read_video(scratch.write("walk.mp4", "no video"));
  CHECK(contains(testing::error_of([&] { cli::list_video_frames(dataset); }),
                 "walk.mp4: cannot open this video"));
}

}  // namespace image_file_test
