// SPDX-License-Identifier: BSD-3-Clause
// Which images the dense model is made from, and which of their pixels.
#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <string>

#include "cli/dense/dense_result.hpp"
#include "cli/dense/missing_pictures.hpp"
#include "dense/filmed_room.hpp"
#include "support/catch.hpp"
#include "support/scratch_folder.hpp"

namespace dense_pictures_test {

using namespace sslam;
using namespace sslam::testing;

namespace {

const Camera<double> kCamera{{230, 230, 159.5, 119.5}, {}, 320, 240};

cv::Mat picture_of(const FilmedRoom& room, std::size_t view) {
  cv::Mat grey(240, 320, CV_8UC1), picture;
  std::copy(room.greys[view].begin(), room.greys[view].end(), grey.begin<std::uint8_t>());
  cv::cvtColor(grey, picture, cv::COLOR_GRAY2BGR);
  return picture;
}

}  // namespace

TEST_CASE("what a mask leaves out is neither a surface nor in the texture of the dense model") {
  const FilmedRoom room;
  const cv::Rect bar(0, 176, 320, 64);  // a part of the robot, as bright green as nothing in the room
  for (const bool masked : {false, true}) {
    cli::KeyframePictures pictures;
    for (std::size_t v = 0; v < room.views.size(); ++v) {
      cv::Mat picture = picture_of(room, v), mask(picture.size(), CV_8UC1, cv::Scalar(255));
      picture(bar).setTo(cv::Scalar(0, 255, 0));
      mask(bar).setTo(0);
      pictures.note(room.map.keyframes[v].frame, picture, masked ? mask : cv::Mat());
    }
    const cli::DenseResult result = cli::make_dense(room.map, 0, pictures, kCamera);
    REQUIRE(result.model.planes.size() >= 6);
    int green = 0;
    for (const cv::Vec3b& texel : result.atlas.image) green += texel[1] > texel[0] + 60 ? 1 : 0;
    const double share = static_cast<double>(green) / static_cast<double>(result.atlas.image.total());
    std::size_t labelled = 0;
    for (const dense::LabelGrid& grid : result.model.labels)
      for (int b = bar.y / grid.block * grid.columns; b < grid.columns * grid.rows; ++b)
        labelled += grid.plane[static_cast<std::size_t>(b)] != dense::kNoPlane ? 1U : 0U;
    INFO("masked: " << masked << ", green " << share << ", blocks with a plane behind the bar " << labelled);
    if (masked) {
      CHECK(green == 0);
      CHECK(labelled == 0);
    } else {
      CHECK(share > 0.02);  // the control: the bar would be seen
      CHECK(labelled > 100);
    }
  }
}

TEST_CASE("the texture of the dense model is taken from sharp images rather than from blurred ones") {
  const FilmedRoom room;
  const auto fine_detail = [&](int every, bool all) {
    cli::KeyframePictures pictures;
    for (std::size_t v = 0; v < room.views.size(); ++v) {
      cv::Mat picture = picture_of(room, v);
      const bool blurred = every > 0 && static_cast<int>(v) % every / 2 == 1;  // both pitches
      if (blurred || all) cv::GaussianBlur(picture, picture, {}, 2.5);
      pictures.note(room.map.keyframes[v].frame, picture, {});
    }
    const cli::DenseResult result = cli::make_dense(room.map, 0, pictures, kCamera);
    cv::Mat fine;
    cv::Laplacian(result.atlas.image, fine, CV_32F);
    return cv::norm(fine, cv::NORM_L1) / static_cast<double>(fine.total());
  };
  const double sharp = fine_detail(0, false), some = fine_detail(8, false), blurred = fine_detail(0, true);
  const double kept = (some - blurred) / (sharp - blurred);
  INFO("sharp " << sharp << ", a quarter blurred " << some << ", all blurred " << blurred);
  CHECK(kept > 0.9);
}

TEST_CASE("pictures of keyframes that came late are read from the dataset, those of an earlier run are not") {
  const FilmedRoom room;
  const ScratchFolder scratch;
  io::Dataset dataset;
  dataset.root = scratch.path();
  for (std::size_t v = 0; v < 4; ++v) {
    const std::string file = (scratch.path() / (std::to_string(v) + ".png")).string();
    const Frame<double>& frame = room.map.keyframes[v].frame;
    if (v != 3) REQUIRE(cv::imwrite(file, picture_of(room, v)));  // one is gone
    dataset.frames.push_back({frame.index, frame.stamp, file, "", -1});
  }
  dataset.frames[2].stamp += 0.5;  // the frame of this number is another one
  const cli::MaskSource masks;
  cli::KeyframePictures pictures;
  cli::read_missing_pictures(room.map, 0, {dataset, masks, nullptr, kCamera, kCamera}, pictures);
  const auto known = [&](std::size_t v) { return pictures.of(room.map.keyframes[v].frame) != nullptr; };
  CHECK(known(0));
  CHECK(known(1));
  CHECK_FALSE(known(2));
  CHECK_FALSE(known(3));
  CHECK_FALSE(known(4));
  REQUIRE(pictures.of(room.map.keyframes[1].frame)->mask.empty());
  CHECK(pictures.of(room.map.keyframes[1].frame)->colour);

  cli::KeyframePictures later;
  cli::read_missing_pictures(room.map, 1, {dataset, masks, nullptr, kCamera, kCamera}, later);
  CHECK(later.of(room.map.keyframes[0].frame) == nullptr);
  CHECK(later.of(room.map.keyframes[1].frame) != nullptr);
}

}  // namespace dense_pictures_test
