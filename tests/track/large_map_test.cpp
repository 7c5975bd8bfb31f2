// SPDX-License-Identifier: BSD-3-Clause
// A frame costs what is around it, whatever the map holds elsewhere: work is counted by the pages of the map
// that are touched, since no test reads a clock.
#ifndef SSLAM_SANITIZED_TESTS  // a sanitizer has a handler for touches of its own
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "support/catch.hpp"
#include "support/page_watch.hpp"
#include "track/simulation.hpp"

using namespace sslam;
using namespace sslam::testing;

namespace large_map_test {

using Tracker = presets::Structure<double>;

// The same map elsewhere, where nothing looks like here. All of it is alive.
Map<double> moved(Map<double> map, const Vec3<double>& by, std::uint64_t look) {
  Random random(look);
  Descriptor mask;
  for (auto& word : mask.words) word = random.next();
  const auto disguise = [&](Descriptor& d) {
    for (std::size_t i = 0; i < d.words.size(); ++i) d.words[i] ^= mask.words[i];
  };
  for (Keyframe<double>& kf : map.keyframes) {
    kf.cam_from_world.translation -= kf.cam_from_world.rotation * by;
    for (auto& point : kf.frame.points) disguise(point.descriptor);
    for (auto& line : kf.frame.lines) disguise(line.descriptor);
  }
  for (auto& point : map.points) {
    point.position += by;
    disguise(point.descriptor);
  }
  for (auto& line : map.lines) {
    line.line = transform(Sim3<double>{SO3<double>(), by, 1}, line.line);
    line.start += by;
    line.end += by;
    disguise(line.descriptor);
  }
  for (auto& plane : map.planes) plane.plane.distance += plane.plane.normal.dot(by);
  return map;
}

// Watches the ends of the lists that a map has beyond those of a smaller one.
void watch_beyond(const Map<double>& map, const Map<double>& smaller, PageWatch& watch) {
  const auto add = [&](const auto& list, std::size_t first) {
    watch.add(list.data() + first, list.data() + list.size());
  };
  add(map.keyframes, smaller.keyframes.size());
  add(map.points, smaller.points.size());
  add(map.lines, smaller.lines.size());
}

}  // namespace large_map_test

TEST_CASE("What a frame and a keyframe touch of the map does not grow with the map") {
  using namespace large_map_test;
  constexpr std::size_t kMapped = 60, kFrames = 150, kCopies = 60;
  const auto path = walk(kFrames);
  Simulation simulation(path);
  Tracker mapper;
  track_first(mapper, simulation, kMapped);
  Map<double> map = mapper.map();
  const Map<double> here = map;
  for (std::size_t i = 0; i < kCopies; ++i)
    map.append(moved(here, {0, 0, 200.0 * static_cast<double>(i + 1)}, i));
  const auto room = [](auto& list) { list.reserve(2 * list.size()); };  // growing it moves it
  room(map.keyframes);
  room(map.points);
  room(map.lines);

  Tracker tracker;
  tracker.resume(std::move(map));
  int keyframes = 0, tracked = 0;
  std::vector<PageWatch::Count> worst(3);
  for (std::size_t k = kMapped / 2; k < kFrames; ++k) {
    Frame<double> frame = simulation.frame(k);
    PageWatch watch;
    // The first keyframe makes the index by which places are looked for.
    const bool settled = keyframes > 0 && tracked > 3;
    if (settled) watch_beyond(tracker.map(), here, watch);
    const TrackResult<double> result = tracker.track(frame);
    const std::vector<PageWatch::Count> counts = watch.open_all();
    tracked += result.has_pose();
    keyframes += result.keyframe;
    for (std::size_t i = 0; i < counts.size(); ++i)
      if (counts[i].touched >= worst[i].touched) worst[i] = counts[i];
  }
  CHECK(tracked > 100);
  CHECK(keyframes > 3);
  // A walk over the whole map would have been seen.
  PageWatch watch;
  watch_beyond(tracker.map(), here, watch);
  int alive = 0;
  for (const auto& point : tracker.map().points) alive += point.alive;
  CHECK(alive > 1000);
  const PageWatch::Count points = watch.open_all()[1];
  CHECK(points.touched == points.pages);
  for (const PageWatch::Count& count : worst) {
    INFO(count.touched << " of " << count.pages << " pages");
    CHECK(count.pages > 20);
    CHECK(5 * count.touched < count.pages);
  }
}
#endif
