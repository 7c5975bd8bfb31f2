// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/track/localise/place_recognition.hpp"

#include <vector>

#include "sslam/core/random.hpp"
#include "support/catch.hpp"

namespace {

using namespace sslam;

constexpr int kPoints = 20;  // of each place

Descriptor draw(Random& random) {
  Descriptor d;
  for (auto& word : d.words) word = random.next();
  return d;
}

Descriptor noisy(Descriptor d, Random& random) {
  for (int i = 0; i < 15; ++i) d.words[random.below(4)] ^= 1ULL << random.below(64);
  return d;
}

// Three places that share nothing, each seen by two keyframes: 0 and 1, 2 and 3, 4 and 5.
Map<double> three_places(Random& random) {
  Map<double> map;
  for (int place = 0; place < 3; ++place) {
    std::vector<PointFeature<double>> points(kPoints);
    for (auto& p : points) p.descriptor = draw(random);
    for (int k = 0; k < 2; ++k) {
      Keyframe<double> keyframe;
      keyframe.frame.points = points;
      map.add_keyframe(std::move(keyframe).seeing(std::vector<LandmarkId>(kPoints, kNone), {}));
    }
    for (std::size_t i = 0; i < kPoints; ++i) {
      const LandmarkId id = map.add_point({0, 0, 5}, 2 * place);
      map.observe_point(id, 2 * place, i);
      map.observe_point(id, 2 * place + 1, i);
    }
  }
  return map;
}

Frame<double> view_of(const Map<double>& map, KeyframeId keyframe, Random& random) {
  Frame<double> frame = map.keyframes[map.index(keyframe)].frame;
  for (auto& p : frame.points) p.descriptor = noisy(p.descriptor, random);
  return frame;
}

std::vector<KeyframeId> ranked(const Map<double>& map, const Frame<double>& frame, int most) {
  PlaceRecognition<double> places;
  std::vector<KeyframeId> answer;
  places.options.most = most;
  places.rank(map, frame, answer);
  return answer;
}

}  // namespace

TEST_CASE("A place is recognised by its landmarks") {
  Random random(5);
  Map<double> map = three_places(random);
  CHECK(ranked(map, view_of(map, 2, random), 3) == std::vector<KeyframeId>{2, 3});
  CHECK(ranked(map, view_of(map, 4, random), 1) == std::vector<KeyframeId>{4});
  // With a landmark less, keyframe 4 shows less of the place than keyframe 5.
  const LandmarkId id = map.keyframes[4].point_landmarks[0];
  map.add_keyframe(map.keyframes[5]);  // a third observer, so that the landmark lives on
  map.forget_point(id, 4);
  CHECK(ranked(map, view_of(map, 5, random), 1) == std::vector<KeyframeId>{5});
}

TEST_CASE("An unknown place and features that look alike name no keyframe") {
  Random random(6);
  const Map<double> map = three_places(random);
  Frame<double> unknown = view_of(map, 0, random);
  for (auto& p : unknown.points) p.descriptor = draw(random);
  CHECK(ranked(map, unknown, 3).empty());
  Frame<double> twins = view_of(map, 0, random);
  const auto points = twins.points;
  for (const auto& p : points) twins.points.push_back(p);
  CHECK(ranked(map, twins, 3).empty());
  CHECK(ranked(map, Frame<double>(), 3).empty());
  CHECK(ranked(Map<double>(), twins, 3).empty());
}
