// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/map/feature_alignment.hpp"

#include <cmath>
#include <utility>
#include <vector>

#include "sslam/core/median.hpp"
#include "support/catch.hpp"
#include "support/drawn_image.hpp"

namespace feature_alignment_test {

using namespace sslam;
using namespace sslam::testing;

constexpr Pinhole<double> kPinhole{150, 150, 79.5, 59.5};
constexpr int kWidth = 160, kHeight = 120;
const Vec3<double> kNormal = Vec3<double>(0.35, -0.2, 1).normalized();  // of a wall 2 m away

double shade(const Vec3<double>& p) {
  return 120 + 45 * std::sin(37 * p.x() + 11 * p.y()) + 40 * std::cos(17 * p.x() - 41 * p.y()) +
         20 * std::sin(60 * p.y());
}

Vec3<double> on_wall(const SE3<double>& cam_from_world, const Vec2<double>& pixel) {
  const SE3<double> world_from_cam = cam_from_world.inverse();
  const Vec3<double> ray = world_from_cam.rotation * kPinhole.unproject(pixel),
                     from = world_from_cam.translation;
  return from + (2 - kNormal.dot(from)) / kNormal.dot(ray) * ray;
}

// A view of the wall, with features where the landmarks project, each off by up to 0.7 pixels.
Keyframe<double> view(const SE3<double>& cam_from_world, const std::vector<Vec3<double>>& landmarks,
                      std::uint64_t seed) {
  const DrawnImage image = draw({kWidth, kHeight}, [&](double u, double v) {
    return shade(on_wall(cam_from_world, {u, v}));
  });
  Random random(seed);
  Keyframe<double> keyframe;
  keyframe.cam_from_world = cam_from_world;
  keyframe.frame.index = static_cast<std::int64_t>(seed);
  keyframe.frame.pinhole = kPinhole;
  keyframe.frame.width = kWidth;
  keyframe.frame.height = kHeight;
  for (const Vec3<double>& landmark : landmarks) {
    PointFeature<double> feature;
    feature.pixel = kPinhole.project(cam_from_world * landmark);
    const double x = random.uniform(-0.7, 0.7), y = random.uniform(-0.7, 0.7);
    feature.pixel += Vec2<double>(x, y);
    feature.patch = static_cast<std::int32_t>(keyframe.frame.patches.size());
    keyframe.frame.patches.push_back(cut_patch(image.view(), static_cast<float>(feature.pixel.x()),
                                               static_cast<float>(feature.pixel.y())));
    keyframe.frame.points.push_back(feature);
  }
  return std::move(keyframe).seeing(std::vector<LandmarkId>(landmarks.size(), kNone), {});
}

struct Wall {
  Map<double> map;
  std::vector<Vec3<double>> landmarks;

  Wall() {
    const SE3<double> first;
    for (int x = 30; x < 140; x += 18)
      for (int y = 25; y < 100; y += 18) landmarks.push_back(on_wall(first, Vec2<double>(x, y)));
    add(first, 1);
    for (std::size_t i = 0; i < landmarks.size(); ++i) {
      // Landmarks lie where their first view sees them, as triangulation puts them about there.
      landmarks[i] = on_wall(first, map.keyframes[0].frame.points[i].pixel);
      map.add_point(landmarks[i], 0);
      map.observe_point(static_cast<LandmarkId>(i), 0, i);
    }
  }

  void add(const SE3<double>& cam_from_world, std::uint64_t seed) {
    map.add_keyframe(view(cam_from_world, landmarks, seed));
  }
  void see_all(KeyframeId keyframe) {
    for (std::size_t i = 0; i < landmarks.size(); ++i)
      map.observe_point(static_cast<LandmarkId>(i), keyframe, i);
  }

  // Median distance of a keyframe's features from where its landmarks project, pixels.
  [[nodiscard]] double error(KeyframeId keyframe) const {
    const Keyframe<double>& kf = map.keyframes[map.index(keyframe)];
    std::vector<double> errors;
    for (std::size_t i = 0; i < landmarks.size(); ++i)
      errors.push_back(
          (kf.frame.points[i].pixel - kPinhole.project(kf.cam_from_world * landmarks[i])).norm());
    return median<double>(errors);
  }
};

// The first view is in the middle between these.
const SE3<double> kAside{SO3<double>::exp({0.02, -0.15, 0.2}), {0.3, 0.1, 0.15}};
const SE3<double> kOtherSide{SO3<double>::exp({-0.02, 0.15, -0.2}), {-0.3, -0.1, 0.15}};

}  // namespace feature_alignment_test

TEST_CASE("Features of one landmark agree to a tenth of a pixel once they are aligned") {
  using namespace feature_alignment_test;
  Wall wall;
  wall.add(kAside, 2);
  wall.add(kOtherSide, 3);
  wall.see_all(1);
  wall.see_all(2);
  const bool on_plane = GENERATE(false, true);
  if (on_plane) {
    const LandmarkId plane = wall.map.add_plane({kNormal, -2}, kNone);
    for (std::size_t i = 0; i < wall.landmarks.size(); ++i)
      wall.map.lay_point(static_cast<LandmarkId>(i), plane);
  }
  REQUIRE(wall.error(1) > 0.4);
  const auto before = wall.map.keyframes[0].frame.points;
  FeatureAlignment<double> alignment;
  CHECK(alignment.align(wall.map) > static_cast<int>(wall.landmarks.size()));  // of twice as many
  for (const KeyframeId k : {1, 2}) CHECK(wall.error(k) < (on_plane ? 0.05 : 0.12));
  for (std::size_t i = 0; i < before.size(); ++i)
    CHECK(wall.map.keyframes[0].frame.points[i].pixel == before[i].pixel);
  // Once is enough.
  const double once = wall.error(1);
  alignment.align(wall.map);
  CHECK(wall.error(1) == Approx(once).margin(0.01));
}

TEST_CASE("Features without a patch, and those of an alignment that is switched off, stay") {
  using namespace feature_alignment_test;
  Wall wall;
  wall.add(kAside, 2);
  wall.see_all(1);
  FeatureAlignment<double> alignment;
  alignment.options.patch.max_shift = 0;
  CHECK(alignment.align(wall.map) == 0);
  alignment.options.patch.max_shift = 2;
  wall.map.keyframes[0].frame.patches.clear();  // as in a map that comes from a file
  CHECK(alignment.align(wall.map) == 0);
}

TEST_CASE("A frame that keeps the patches of what sees landmarks is aligned as one that keeps all") {
  using namespace feature_alignment_test;
  Wall wall;
  wall.add(kAside, 2);
  wall.see_all(1);
  wall.map.erase_point(3);
  Map<double> thin = wall.map;
  for (Keyframe<double>& keyframe : thin.keyframes) {
    const std::size_t all = keyframe.frame.patches.size();
    keyframe.drop_unseen_patches();
    CHECK(keyframe.frame.patches.size() == all - 1);
    CHECK(keyframe.frame.points[3].patch == kNone);
    keyframe.drop_unseen_patches();
    CHECK(keyframe.frame.patches.size() == all - 1);
  }
  FeatureAlignment<double> alignment;
  CHECK(alignment.align(thin) == alignment.align(wall.map));
  for (std::size_t i = 0; i < wall.landmarks.size(); ++i)
    CHECK(thin.keyframes[1].frame.points[i].pixel == wall.map.keyframes[1].frame.points[i].pixel);
}
