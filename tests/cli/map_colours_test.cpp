// SPDX-License-Identifier: BSD-3-Clause
// The colours of a map's points and lines: from pictures by way of features, into a file and back.
#include "cli/results/map_colours.hpp"

#include <opencv2/imgproc.hpp>
#include <string>

#include "sslam/core/error.hpp"
#include "support/catch.hpp"
#include "support/scratch_folder.hpp"

namespace map_colours_test {

namespace {

namespace cli = sslam::cli;
using sslam::io::Colour;

const sslam::Camera<double> kLens{{80, 80, 39.5, 29.5}, {}, 80, 60};

// A keyframe with three points and a line; the first point is seen in all of them.
sslam::Frame<double> frame_of(std::int64_t index) {
  sslam::Frame<double> frame;
  frame.index = index;
  frame.stamp = static_cast<double>(index) / 10;
  frame.pinhole = kLens.pinhole;
  frame.width = kLens.width;
  frame.height = kLens.height;
  frame.points.resize(3);
  frame.points[0].pixel = {20, 30};
  frame.points[1].pixel = {60, 30};
  frame.points[2].pixel = {500, 30};  // outside of the picture
  frame.lines.resize(1);
  frame.lines[0].segment = {{50, 10}, {70, 50}};
  return frame;
}

// The left half in one colour, the right half in another (red, green, blue).
cv::Mat halves(const Colour& left, const Colour& right) {
  cv::Mat picture(kLens.height, kLens.width, CV_8UC3, cv::Scalar(left[2], left[1], left[0]));
  picture.colRange(40, 80).setTo(cv::Scalar(right[2], right[1], right[0]));
  return picture;
}

sslam::Map<double> map_of(int keyframes) {
  sslam::Map<double> map;
  for (int k = 0; k < keyframes; ++k) {
    sslam::Keyframe<double> keyframe;
    keyframe.frame = frame_of(k);
    map.add_keyframe(std::move(keyframe).seeing({sslam::kNone, sslam::kNone, sslam::kNone}, {sslam::kNone}));
  }
  for (std::size_t feature = 0; feature < 3; ++feature) {
    const auto id = map.add_point({0, 0, 1}, 0);
    for (int k = 0; k < (feature == 0 ? keyframes : 1); ++k) map.observe_point(id, k, feature);
  }
  const auto line = map.add_line(sslam::Line3<double>{}, {0, 0, 1}, {1, 0, 1}, 0);
  map.observe_line(line, 0, 0);
  return map;
}

}  // namespace

TEST_CASE("a landmark has the median colour of the keyframes that see it") {
  cli::FeatureColours features;
  features.note(frame_of(0), halves({10, 200, 30}, {1, 2, 3}), kLens);
  features.note(frame_of(1), halves({12, 90, 250}, {1, 2, 3}), kLens);
  features.note(frame_of(2), halves({90, 100, 40}, {1, 2, 3}), kLens);
  const cli::MapColours colours = features.of(map_of(3));
  CHECK(colours.any());
  CHECK(colours.points.at(0) == Colour{12, 100, 40});
  CHECK(colours.points.at(1) == Colour{1, 2, 3});
  CHECK_FALSE(colours.points.at(2).has_value());
  CHECK(colours.lines.at(0) == Colour{1, 2, 3});
}

TEST_CASE("grey images give grey colours, and keyframes without a picture none") {
  cli::FeatureColours features;
  cv::Mat grey;
  cv::cvtColor(halves({70, 70, 70}, {200, 200, 200}), grey, cv::COLOR_BGR2GRAY);
  features.note(frame_of(0), grey, kLens);
  features.note(frame_of(1), cv::Mat(), kLens);
  CHECK(features.of(map_of(2)).points.at(0) == Colour{70, 70, 70});
  CHECK_FALSE(cli::FeatureColours().of(map_of(2)).any());
}

TEST_CASE("colours survive the file beside the map, and a run that goes on in the map") {
  const sslam::testing::ScratchFolder scratch;
  const auto path = scratch.path() / "colours.bin";
  cli::FeatureColours features;
  features.note(frame_of(0), halves({10, 200, 30}, {1, 2, 3}), kLens);
  const sslam::Map<double> map = map_of(2);
  const cli::MapColours colours = features.of(map);
  cli::write_colours(path, colours);
  const cli::MapColours read = cli::read_colours(path, map);
  CHECK(read.points == colours.points);
  CHECK(read.lines == colours.lines);

  cli::FeatureColours later;
  later.note(map, read);
  CHECK(later.of(map).points == colours.points);

  sslam::Map<double> other = map;
  other.add_point({0, 0, 2}, 0);
  CHECK_THROWS_AS((void)cli::read_colours(path, other), sslam::Error);
  std::filesystem::resize_file(path, std::filesystem::file_size(path) - 3);
  CHECK_THROWS_AS((void)cli::read_colours(path, map), sslam::Error);
}

}  // namespace map_colours_test
