// SPDX-License-Identifier: BSD-3-Clause
// Normals by a network: preprocessing, axes, mask, cameras, and the shipped model against a stored answer.
#include <algorithm>
#include <cmath>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <sstream>

#include "model_fixture.hpp"
#include "support/catch.hpp"

using namespace sslam;
using namespace sslam::test;

namespace {

// What the tiny model computes from a mean colour, red, green and blue in [-1, 1]: see fixtures.py.
Vec3<double> tiny_answer(const Vec3<double>& rgb) {
  Mat3<double> mix;
  mix << 0.9, 0.1, -0.3, -0.2, 0.7, 0.4, 0.1, -0.1, 0.2;
  return (mix * rgb + Vec3<double>(0.1, -0.1, -1.2)).normalized();
}

DenseNormals tiny_infer(const Changes& changes, const cv::Mat& image) {
  const testing::ScratchFolder folder;
  OnnxNormals source(changed(folder, fixtures() / "tiny_normals.json", changes));
  DenseNormals dense;
  REQUIRE(source.infer(image, camera(image.cols, image.rows, 50), dense) == NormalStatus::kOk);
  return dense;
}

NormalField fill(OnnxNormals& source, const cv::Mat& image, const Camera<double>& cam,
                 NormalStatus expected = NormalStatus::kOk) {
  ImageInput input;
  input.image = image;
  NormalField field;
  field.push_back(0, 0, -1, 1);
  REQUIRE(source.fill(input, cam, field) == expected);
  if (expected != NormalStatus::kOk) REQUIRE(field.size() == 0);
  return field;
}

cv::Mat painted(double blue, double green, double red) {
  return {48, 64, CV_8UC3, cv::Scalar(blue, green, red)};
}

}  // namespace

TEST_CASE("a network's input and output go through the manifest", "[normals]") {
  const cv::Mat image = coloured(64, 48);
  const DenseNormals dense = tiny_infer({}, image);
  REQUIRE(dense.normal.size() == cv::Size(16, 12));
  for (int v = 0; v < 12; ++v) {
    for (int u = 0; u < 16; ++u) {
      const cv::Scalar mean = cv::mean(image(cv::Rect(4 * u, 4 * v, 4, 4)));
      const Vec3<double> rgb = Vec3<double>(mean[2], mean[1], mean[0]) / 127.5 - Vec3<double>::Ones();
      const Vec3<double> expected = tiny_answer(rgb);
      const cv::Vec3f& n = dense.normal(v, u);
      if (n == cv::Vec3f()) continue;
      CHECK((Vec3<double>(n[0], n[1], n[2]) - expected).norm() < 1e-4);
      CHECK(near(dense.planar(v, u), 1 / (1 + std::exp(-4 * rgb.y() - 1.5)), 1e-4));
      CHECK(near(dense.confidence(v, u), 1 / (1 + std::exp(-2 * rgb.z() - 1.0)), 1e-4));
    }
  }
}

TEST_CASE("each broken step of preprocessing is seen in the answer", "[normals]") {
  const cv::Mat image = coloured(64, 48);
  const DenseNormals right = tiny_infer({}, image);
  CHECK(difference_deg(right, tiny_infer({}, image)) < 1e-3);
  CHECK(difference_deg(right, tiny_infer({{"\"rgb\"", "\"bgr\""}}, image)) > 10);
  CHECK(difference_deg(right, tiny_infer({{"0.00784", "0.00984"}}, image)) > 1);
  CHECK(difference_deg(right, tiny_infer({{"127.5", "0.5"}}, image)) > 10);
  CHECK(difference_deg(right, tiny_infer({{"\"signs\": [\n      1", "\"signs\": [\n      -1"}}, image)) > 10);
  CHECK(difference_deg(right, tiny_infer({{"\"x\",\n      \"y\"", "\"y\",\n      \"x\""}}, image)) > 10);
}

TEST_CASE("the weight is mask times confidence and the mask is a threshold", "[normals]") {
  OnnxNormals source(fixtures() / "tiny_normals.onnx");
  const cv::Mat image = coloured(64, 48);
  const auto cam = camera(64, 48, 50);
  const NormalField field = fill(source, image, cam);
  CHECK(near(field.plane_sigma, radians(5.0), 1e-6));  // the manifest does not say
  CHECK(source.report().evidence.enough);
  DenseNormals dense;
  REQUIRE(source.infer(image, cam, dense) == NormalStatus::kOk);
  std::size_t i = 0;
  for (int v = 0; v < dense.normal.rows; ++v) {
    for (int u = 0; u < dense.normal.cols; ++u) {
      if (dense.planar(v, u) < 0.5 || dense.normal(v, u) == cv::Vec3f()) continue;
      REQUIRE(i < field.size());
      CHECK(near(field.weight[i], dense.planar(v, u) * dense.confidence(v, u)));
      CHECK(field.x[i] == dense.normal(v, u)[0]);
      ++i;
    }
  }
  CHECK(i == field.size());
  CHECK(near(source.report().evidence.planar_share, i / 192.0));
}

TEST_CASE("grey and BGRA images are taken as well", "[normals]") {
  OnnxNormals source(fixtures() / "tiny_normals.json");
  const cv::Mat grey(48, 64, CV_8UC1, cv::Scalar(200)), bgra(48, 64, CV_8UC4, cv::Scalar(200, 200, 200, 0));
  const auto cam = camera(64, 48, 50);
  CHECK(fill(source, grey, cam).x == fill(source, bgra, cam).x);
}

TEST_CASE("bad images are refused and leave nothing", "[normals]") {
  OnnxNormals source(fixtures() / "tiny_normals.json");
  NormalField field;
  field.push_back(0, 0, -1, 1);
  ImageInput input;
  CHECK(source.fill(input, camera(64, 48, 50), field) == NormalStatus::kNoInput);
  CHECK(field.size() == 0);
  input.image = coloured(64, 48);
  CHECK(source.fill(input, camera(63, 48, 50), field) == NormalStatus::kWrongSize);
  input.image.convertTo(input.image, CV_16U);
  CHECK(source.fill(input, camera(64, 48, 50), field) == NormalStatus::kWrongType);
  input.image = coloured(20, 15);
  CHECK(source.fill(input, camera(20, 15, 16), field) == NormalStatus::kTooSmall);
}

TEST_CASE("an empty mask is no Manhattan evidence", "[normals]") {
  OnnxNormals source(fixtures() / "tiny_normals.json");
  fill(source, painted(255, 0, 255), camera(64, 48, 50), NormalStatus::kNoEvidence);  // no green: not planar
  CHECK_FALSE(source.report().evidence.enough);
  CHECK(source.report().evidence.planar_share == 0);
}

TEST_CASE("normals that contradict each other are no Manhattan evidence", "[normals]") {
  OnnxNormals source(fixtures() / "tiny_normals.json");
  cv::Mat_<cv::Vec3b> chess(48, 64);
  for (int v = 0; v < 48; ++v)
    for (int u = 0; u < 64; ++u)
      chess(v, u) = (u / 4 + v / 4) % 2 == 0 ? cv::Vec3b(0, 255, 255) : cv::Vec3b(255, 255, 0);
  fill(source, chess, camera(64, 48, 50), NormalStatus::kNoEvidence);
  CHECK_FALSE(source.report().evidence.enough);
  CHECK(source.report().evidence.planar_share > 0.5);
  CHECK(source.report().evidence.agreement < 0.1);
}

TEST_CASE("normals that are not finite or not of unit length are bad output", "[normals]") {
  const testing::ScratchFolder folder;
  OnnxNormals source(
      changed(folder, fixtures() / "tiny_normals.json", {{"\"name\": \"normal\"", "\"name\": \"frail\""}}));
  const auto cam = camera(64, 48, 50);
  CHECK(fill(source, painted(128, 128, 128), cam).size() > 0);
  fill(source, painted(0, 0, 200), cam, NormalStatus::kBadOutput);  // too long
  CHECK(source.report().bad_share == 1);
  fill(source, painted(0, 255, 0), cam, NormalStatus::kBadOutput);  // not a number
  CHECK(source.report().bad_share == 1);
  // A small spot is dropped, and the rest stands.
  cv::Mat spot = painted(128, 128, 128);
  spot(cv::Rect(8, 8, 8, 8)).setTo(cv::Scalar(0, 255, 0));
  CHECK(fill(source, spot, cam).size() == 16 * 12 - 4);
  CHECK(near(source.report().bad_share, 4 / 192.0));
  CHECK(fill(source, painted(128, 128, 128), cam).size() == 16 * 12);
}

TEST_CASE("a mask that leaves [0, 1] is bad output", "[normals]") {
  const testing::ScratchFolder folder;
  OnnxNormals source(changed(folder, fixtures() / "tiny_normals.json",
                             {{"\"mask\": \"planar\"", "\"mask\": \"frail_mask\""}}));
  const auto cam = camera(64, 48, 50);
  CHECK(fill(source, painted(128, 128, 128), cam).size() > 0);
  fill(source, painted(0, 0, 200), cam, NormalStatus::kBadOutput);
  CHECK(source.report().bad_share == 0);
  CHECK(source.report().bad_weight_share == 1);
  fill(source, painted(0, 255, 0), cam, NormalStatus::kBadOutput);
}

TEST_CASE("every status has a message of its own", "[normals]") {
  std::vector<std::string> names;
  for (int i = 0; i <= static_cast<int>(NormalStatus::kNoEvidence); ++i)
    names.emplace_back(name(static_cast<NormalStatus>(i)));
  std::sort(names.begin(), names.end());
  CHECK(std::adjacent_find(names.begin(), names.end()) == names.end());
  CHECK(std::find(names.begin(), names.end(), "unknown") == names.end());
}

TEST_CASE("an image of another camera is brought to the network's camera", "[normals]") {
  const testing::ScratchFolder folder;
  OnnxNormals source(
      changed(folder, fixtures() / "tiny_normals.json", {{"\"channels\"", "\"focal\": 50, \"channels\""}}));
  DenseNormals same, wide;
  REQUIRE(source.infer(coloured(64, 48), camera(64, 48, 50), same) == NormalStatus::kOk);
  // Twice the pixels and the same view; then a view so narrow that the network's border shows nothing real.
  REQUIRE(source.infer(coloured(128, 96), camera(128, 96, 100), wide) == NormalStatus::kOk);
  CHECK(difference_deg(same, wide) < 2);
  CHECK(near(wide.pinhole.fx, 12.5));
  REQUIRE(source.infer(coloured(64, 48), camera(64, 48, 100), wide) == NormalStatus::kOk);
  CHECK(wide.normal(0, 0) == cv::Vec3f());
  CHECK(wide.normal(6, 8) != cv::Vec3f());
}

TEST_CASE("lens distortion is taken out before the network", "[normals]") {
  OnnxNormals source(fixtures() / "tiny_normals.json");
  Camera<double> cam = camera(64, 48, 50);
  DenseNormals straight, bent;
  REQUIRE(source.infer(coloured(64, 48), cam, straight) == NormalStatus::kOk);
  cam.distortion.k1 = -0.2;
  REQUIRE(source.infer(coloured(64, 48), cam, bent) == NormalStatus::kOk);
  CHECK(difference_deg(straight, bent) > 0.5);
}

TEST_CASE("a depth output becomes normals", "[normals]") {
  // The tiny model's depth is 2 b + 1 for blue in [-1, 1]: a flat grey image is a wall across the view.
  for (const std::string kind : {"depth", "inverse_depth"}) {
    const testing::ScratchFolder folder;
    OnnxNormals source(changed(folder, fixtures() / "tiny_normals.json",
                               {{"\"normals\"", "\"" + kind + "\""},
                                {"\"name\": \"normal\"", "\"name\": \"depth\""},
                                {"\"axes\"", "\"scale\": 0.9 } } #"}}));
    const NormalField field =
        fill(source, cv::Mat(480, 640, CV_8UC3, cv::Scalar::all(128)), camera(640, 480, 520));
    REQUIRE(field.size() > 0);
    for (std::size_t i = 0; i < field.size(); ++i) CHECK(near(field.z[i], -1, 1e-3));
  }
}

TEST_CASE("a depth output that is not finite is bad output, and one out of range is told", "[normals]") {
  const testing::ScratchFolder folder;
  OnnxNormals source(changed(folder, fixtures() / "tiny_normals.json",
                             {{"\"normals\"", "\"depth\""},
                              {"\"name\": \"normal\"", "\"name\": \"frail_mask\""},
                              {"\"axes\"", "\"scale\": 0.9 } } #"}}));
  const auto cam = camera(64, 48, 52);
  fill(source, painted(0, 255, 0), cam, NormalStatus::kBadOutput);
  CHECK(source.report().bad_share == 1);
  fill(source, painted(0, 127, 0), cam, NormalStatus::kOutOfRange);  // too near
}

TEST_CASE("a network whose normals point away is told as such", "[normals]") {
  const testing::ScratchFolder folder;
  OnnxNormals source(changed(
      folder, fixtures() / "tiny_normals.json",
      {{"\"signs\": [\n      1,\n      1,\n      1", "\"signs\": [\n      -1,\n      -1,\n      -1"}}));
  fill(source, painted(128, 128, 128), camera(64, 48, 50), NormalStatus::kFacesAway);
  CHECK(source.report().away_share == 1);
}

TEST_CASE("an output's planes are found in every order of its axes", "[normals]") {
  const int nchw[] = {1, 3, 2, 4}, nhwc[] = {1, 2, 4, 3};
  cv::Mat first(4, nchw, CV_32F), last(4, nhwc, CV_32F);
  for (int c = 0; c < 3; ++c)
    for (int v = 0; v < 2; ++v)
      for (int u = 0; u < 4; ++u) {
        const auto value = static_cast<float>(100 * c + 10 * v + u);
        first.ptr<float>(0, c, v)[u] = value;
        last.ptr<float>(0, v, u)[c] = value;
      }
  const int chw[] = {3, 2, 4}, hwc[] = {2, 4, 3};
  for (const cv::Mat& blob : {first, last, first.reshape(1, 3, chw), last.reshape(1, 3, hwc)}) {
    const auto planes = output_planes(blob, 3);
    REQUIRE(planes.size() == 3);
    REQUIRE(planes[0].size() == cv::Size(4, 2));
    CHECK(planes[0](0, 3) == 3);
    CHECK(planes[1](1, 0) == 110);
    CHECK(planes[2](1, 3) == 213);
  }
  const cv::Mat depth(2, 4, CV_32F, cv::Scalar(5));
  const int with_channel[] = {1, 2, 4}, with_both[] = {1, 1, 2, 4};
  for (const cv::Mat& blob : {depth, depth.reshape(1, 3, with_channel), depth.reshape(1, 4, with_both)}) {
    const auto planes = output_planes(blob, 1);
    REQUIRE(planes.size() == 1);
    CHECK(planes[0].size() == cv::Size(4, 2));
    CHECK(planes[0](1, 2) == 5);
  }
  CHECK(output_planes(first, 1).empty());
  CHECK(output_planes(depth, 3).empty());
  CHECK(output_planes(cv::Mat(2, 4, CV_64F), 1).empty());
}
