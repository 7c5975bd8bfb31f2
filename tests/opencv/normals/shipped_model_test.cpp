// SPDX-License-Identifier: BSD-3-Clause
// The shipped model: its checksum, and its answer to a rendered room against a stored one that another
// program computed (fixtures.py). Broken preprocessing must not come near it.
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <sstream>

#include "model_fixture.hpp"
#include "sha256.hpp"
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

TEST_CASE("SHA-256 is right", "[normals]") {
  CHECK(sha256("") == "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  CHECK(sha256("abc") == "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  CHECK(sha256(std::string(1000, 'a')) == "41edece42d63e8d9bf515a9ba6932e1c20cbc9f5a5d134645adb5db1b9737ea3");
}

TEST_CASE("the shipped model is the one that its manifest names", "[normals]") {
  const cv::FileStorage storage(shipped().string(), cv::FileStorage::READ | cv::FileStorage::FORMAT_JSON);
  CHECK(storage["sha256"].string() == sha256_of_file(read_normal_manifest(shipped()).model));
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
