// SPDX-License-Identifier: BSD-3-Clause
// The shipped model: its checksum, and its answer to a rendered room against a stored one that another
// program computed (fixtures.py). Broken preprocessing must not come near it.
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <sstream>

#include "model_fixture.hpp"
#include "support/catch.hpp"

using namespace sslam;
using namespace sslam::test;

namespace {

std::filesystem::path shipped() {
  return fixtures().parent_path().parent_path().parent_path() /
         "third_party_models/planar_normals/planar_normals.json";
}

struct Difference {
  double mean_deg = 0, worst_deg = 0, planar = 0;  // of the mask's probability, mean
  int count = 0;
};

// Against rows `u v x y z planar`.
Difference against_stored(const DenseNormals& dense) {
  std::ifstream file(fixtures() / "room_normals.txt");
  Difference sum;
  for (std::string line; std::getline(file, line);) {
    if (line.empty() || line[0] == '#') continue;
    int u = 0, v = 0;
    cv::Vec3f n;
    double planar = 0;
    std::istringstream(line) >> u >> v >> n[0] >> n[1] >> n[2] >> planar;
    const cv::Vec3f& m = dense.normal(v, u);
    if (m == cv::Vec3f()) continue;
    const double angle = degrees(std::atan2(cv::norm(m.cross(n)), static_cast<double>(m.dot(n))));
    sum.mean_deg += angle;
    sum.worst_deg = std::max(sum.worst_deg, angle);
    sum.planar += std::abs(static_cast<double>(dense.planar(v, u)) - planar);
    ++sum.count;
  }
  REQUIRE(sum.count > 100);
  sum.mean_deg /= sum.count;
  sum.planar /= sum.count;
  return sum;
}

Difference answer(const Changes& changes) {
  const testing::ScratchFolder folder;
  OnnxNormals source(changed(folder, shipped(), changes));
  const cv::Mat image = cv::imread((fixtures() / "room.jpg").string());
  REQUIRE_FALSE(image.empty());
  DenseNormals dense;
  REQUIRE(source.infer(image, camera(image.cols, image.rows, 260), dense) == NormalStatus::kOk);
  const Difference d = against_stored(dense);
  UNSCOPED_INFO("mean " << d.mean_deg << " worst " << d.worst_deg << " degrees, planar " << d.planar);
  return d;
}

}  // namespace

TEST_CASE("the shipped model is the one that its manifest means", "[normals]") {
  const NormalManifest manifest = read_normal_manifest(shipped());
  CHECK(manifest.sha256.size() == 64);
  CHECK_NOTHROW(OnnxNetwork(manifest));  // which refuses another
}

TEST_CASE("the shipped model answers a stored image as stored", "[normals]") {
  const Difference d = answer({});
  CHECK(d.mean_deg < 0.1);
  CHECK(d.worst_deg < 2);
  CHECK(d.planar < 0.01);
}

TEST_CASE("broken preprocessing misses the stored answer", "[normals]") {
  CHECK(answer({{"\"rgb\"", "\"bgr\""}}).mean_deg > 0.4);
  CHECK(answer({{"\"signs\": [\n      1", "\"signs\": [\n      -1"}}).mean_deg > 0.4);
  CHECK(answer({{"\"x\",\n      \"y\"", "\"y\",\n      \"x\""}}).mean_deg > 0.4);
  CHECK(answer({{"127.5,\n      127.5,\n      127.5", "0,\n      0,\n      0"}}).mean_deg > 0.4);
  CHECK(answer({{"0.00784313725490196,\n      0.00784313725490196,\n      0.00784313725490196",
                 "0.0039, 0.0039, 0.0039"}})
            .mean_deg > 0.4);
}
