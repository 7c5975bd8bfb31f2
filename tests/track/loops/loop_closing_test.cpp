// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/track/loops/loop_closing.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "support/catch.hpp"
#include "support/map_errors.hpp"
#include "track/simulation.hpp"

namespace {

using namespace sslam;
using namespace sslam::testing;

constexpr int kLap = 36, kKeyframes = 40;

// All around, with a step aside for the parallax, and on over where it began.
std::vector<SE3<double>> around() {
  std::vector<SE3<double>> path;
  for (int k = 0; k < kKeyframes; ++k) {
    const double yaw = 2 * std::numbers::pi * k / kLap;
    path.push_back(look({0.6 * std::cos(yaw), 0.1 * (k % 3), -0.6 * std::sin(yaw)}, yaw));
  }
  return path;
}

struct Ring {
  MapScene scene{{.points = 1500, .lines = 250}, around()};
  Map<double> map = scene.make_map();

  // The map as tracking leaves it: what the first keyframes see, the last ones have seen for the first time,
  // and on the way the world has been bent and has shrunk.
  Ring() {
    give_looks();
    split();
    std::vector<Sim3<double>> drift;
    for (int k = 0; k < kKeyframes; ++k) {
      Vec<double, 7> xi;
      xi << 0.0004, -0.0006, 0.0004, 0.004, 0.002, -0.004, -0.008;
      drift.push_back(Sim3<double>::exp(k * xi));
    }
    deform<double>(map, drift);
    for (const auto& kf : map.keyframes) map.update_covisibility(kf.id);
  }

 private:
  void give_looks() {
    Random random(7);
    const auto dress = [&](auto& landmarks, auto features_of) {
      for (auto& landmark : landmarks) {
        for (auto& word : landmark.descriptor.words) word = random.next();
        for (const Observation& o : landmark.observations) {
          Descriptor seen = landmark.descriptor;
          for (int i = 0; i < 12; ++i) seen.words[random.below(4)] ^= 1ULL << random.below(64);
          features_of(map.keyframes[map.index(o.keyframe)])[map.index(o.feature)].descriptor = seen;
        }
      }
    };
    dress(
        map.points, [](auto& kf) -> auto& { return kf.frame.points; });
    dress(
        map.lines, [](auto& kf) -> auto& { return kf.frame.lines; });
  }

  void split() {
    split(
        map.points,
        [&](LandmarkId id, KeyframeId by) { return map.add_point(map.points[map.index(id)].position, by); },
        [&](LandmarkId id, LandmarkId twin, const Observation& o) {
          map.forget_point(id, o.keyframe);
          map.observe_point(twin, o.keyframe, map.index(o.feature));
        });
    split(
        map.lines,
        [&](LandmarkId id, KeyframeId by) {
          const LineLandmark<double> line = map.lines[map.index(id)];
          return map.add_line(line.line, line.start, line.end, by);
        },
        [&](LandmarkId id, LandmarkId twin, const Observation& o) {
          map.forget_line(id, o.keyframe);
          map.observe_line(twin, o.keyframe, map.index(o.feature));
        });
  }

  // What late keyframes observe of a landmark goes to a twin of it.
  template <class Landmarks, class Add, class Move>
  static void split(const Landmarks& landmarks, Add add_twin, Move move) {
    const auto late = [](const Observation& o) { return o.keyframe >= kKeyframes / 2; };
    for (LandmarkId id = 0, count = static_cast<LandmarkId>(landmarks.size()); id < count; ++id) {
      const auto all = landmarks[Map<double>::index(id)].observations;
      if (std::all_of(all.begin(), all.end(), late) || spans_half(all)) continue;
      LandmarkId twin = kNone;
      for (const Observation& o : all) {
        if (!late(o)) continue;
        if (twin == kNone) twin = add_twin(id, o.keyframe);
        move(id, twin, o);
      }
    }
  }

  // Seen on the way, in the middle of it, and neither at its beginning nor at its end.
  static bool spans_half(const std::vector<Observation>& all) {
    return std::any_of(all.begin(), all.end(), [](const Observation& o) {
      return o.keyframe >= kKeyframes / 4 && o.keyframe < kKeyframes * 3 / 4;
    });
  }
};

template <class Landmarks>
auto count_alive(const Landmarks& landmarks) {
  return std::count_if(landmarks.begin(), landmarks.end(), [](const auto& l) { return l.alive; });
}

bool covisible(const Map<double>& map, KeyframeId a, KeyframeId b) {
  const auto& neighbours = map.keyframes[map.index(a)].neighbours;
  return std::any_of(neighbours.begin(), neighbours.end(),
                     [&](const Neighbour& n) { return n.keyframe == b; });
}

// Root mean square distance of the keyframes from where they stood, after the best similarity, in metres.
double error(const Ring& ring) {
  const auto count = static_cast<Eigen::Index>(ring.scene.poses.size());
  Eigen::Matrix3Xd estimate(3, count), truth(3, count);
  for (Eigen::Index k = 0; k < count; ++k) {
    const auto at = static_cast<std::size_t>(k);
    estimate.col(k) = ring.map.keyframes[at].cam_from_world.inverse().translation;
    truth.col(k) = ring.scene.poses[at].inverse().translation;
  }
  const Eigen::Matrix4d to_truth = Eigen::umeyama(estimate, truth);
  const Eigen::Matrix3Xd off =
      ((to_truth.topLeftCorner<3, 3>() * estimate).colwise() + to_truth.topRightCorner<3, 1>()) - truth;
  return std::sqrt(off.colwise().squaredNorm().mean());
}

// One thing that looks the same is no place; the keyframe after shows the next.
LoopAnswer<double> close(LoopClosing<double>& loops, Map<double>& map) {
  REQUIRE_FALSE(loops.close(map, kKeyframes - 2).closed);
  return loops.close(map, kKeyframes - 1);
}

// From now on the last keyframes see nothing of the beginning but one thing, in a third of the image.
void leave_one_thing(Map<double>& map) {
  Random random(11);
  const Keyframe<double>& last = map.keyframes.back();
  const double left = last.frame.width / 3.0, right = 2 * left;
  for (auto& point : map.points) {
    if (!point.alive || point.observations.front().keyframe < kKeyframes / 2) continue;
    const Vec3<double> in_camera = last.cam_from_world * point.position;
    const double x = in_camera.z() > 0 ? last.frame.pinhole.project(in_camera).x() : 0;
    if (x > left && x < right) continue;
    for (auto& word : point.descriptor.words) word = random.next();
    for (const Observation& o : point.observations)
      map.keyframes[map.index(o.keyframe)].frame.points[map.index(o.feature)].descriptor = point.descriptor;
  }
  map.collect_free_ids();  // looks have changed
}

int closed_on_trial(LoopClosing<double>& loops, Map<double>& map,
                    TrialEvidence evidence = TrialEvidence::kBeside) {
  int closed = 0;
  for (const KeyframeId id : loops.missed(map)) closed += loops.close_on_trial(map, id, evidence).closed;
  return closed;
}

}  // namespace

TEST_CASE("A place that is met again takes the drift out of the map") {
  Ring ring;
  const double before = error(ring);
  const auto points = count_alive(ring.map.points), lines = count_alive(ring.map.lines);
  REQUIRE_FALSE(covisible(ring.map, kKeyframes - 1, 3));
  LoopClosing<double> loops;
  const LoopAnswer<double> answer = close(loops, ring.map);
  REQUIRE(answer.closed);
  REQUIRE(answer.new_from_old.size() == ring.map.keyframes.size());
  // The world had shrunk to exp(-0.008 * 39) of its size there.
  CHECK(answer.new_from_old.back().scale == Approx(std::exp(0.008 * 39)).epsilon(0.05));
  INFO(before << " m before, " << error(ring) << " m after");
  CHECK(before > 0.03);
  CHECK(error(ring) < 0.2 * before);
  CHECK(covisible(ring.map, kKeyframes - 1, 3));
  CHECK(count_alive(ring.map.points) < points - 50);
  CHECK(count_alive(ring.map.lines) < lines);
  // Met once, it is known.
  CHECK_FALSE(loops.close(ring.map, kKeyframes - 1).closed);
}

TEST_CASE("The same map gives the same bits") {
  Ring a, b;
  for (Ring* ring : {&a, &b}) {
    LoopClosing<double> loops;
    CHECK(close(loops, ring->map).closed);
  }
  CHECK(same_bits(state_of(a.map), state_of(b.map)));
}

TEST_CASE("No place is looked for when none may be tried") {
  Ring ring;
  const auto before = state_of(ring.map);
  LoopClosing<double> loops;
  loops.detection.places.options.most = 0;
  CHECK_FALSE(close(loops, ring.map).closed);
  CHECK(same_bits(state_of(ring.map), before));
}

TEST_CASE("A place that only looks the same is not taken for it") {
  Ring ring;
  // The same looks on another geometry: every landmark of the beginning is somewhere else on its ray.
  Random random(9);
  for (auto& point : ring.map.points)
    if (point.alive && point.observations.front().keyframe < 10) {
      const SE3<double>& cam = ring.map.keyframes[0].cam_from_world;
      const Vec3<double> centre = cam.inverse().translation;
      point.position = centre + (point.position - centre) * random.uniform(0.4, 2.5);
    }
  const auto poses = [](const Map<double>& map) {
    std::vector<double> out;
    for (const auto& kf : map.keyframes) out.push_back(kf.cam_from_world.translation.norm());
    return out;
  };
  const auto before = poses(ring.map);
  LoopClosing<double> loops;
  CHECK_FALSE(close(loops, ring.map).closed);
  CHECK(poses(ring.map) == before);
}

TEST_CASE("A turn of the world that structure rules out closes no loop") {
  Ring ring;
  LoopClosing<double> loops;
  loops.detection.options.max_turn = radians(0.1);
  CHECK_FALSE(close(loops, ring.map).closed);
}

TEST_CASE("A place that was met once closes its loop after the last frame") {
  Ring ring;
  const double before = error(ring);
  LoopClosing<double> loops;
  loops.detection.confirmation.options.reach = 1;  // no place is expected where the map has it
  // One keyframe alone recognises the place, and what its neighbours see of it is found on trial.
  loops.detection.refinement.options.acceptance.min_inliers = 170;
  REQUIRE_FALSE(loops.close(ring.map, kKeyframes - 1).closed);
  CHECK(closed_on_trial(loops, ring.map) > 0);
  INFO(before << " m before, " << error(ring) << " m after");
  CHECK(error(ring) < 0.2 * before);
  CHECK(covisible(ring.map, kKeyframes - 1, 3));
}

TEST_CASE("One thing that stands at two places closes no loop, even on trial") {
  Ring ring;
  leave_one_thing(ring.map);
  const auto before = state_of(ring.map);
  LoopClosing<double> loops;
  loops.detection.confirmation.options.reach = 1;  // no place is expected where the map has it
  loops.options.max_drift = 0.005;                 // nor can drift have moved it there
  REQUIRE_FALSE(loops.missed(ring.map).empty());
  CHECK(closed_on_trial(loops, ring.map) == 0);
  CHECK(closed_on_trial(loops, ring.map, TrialEvidence::kLikelyDrift) == 0);
  CHECK(same_bits(state_of(ring.map), before));
}

TEST_CASE("A place that several keyframes recognise closes its loop on trial where the drift is likely") {
  Ring ring;
  leave_one_thing(ring.map);
  const double before = error(ring);
  LoopClosing<double> loops;
  loops.detection.confirmation.options.reach = 1;  // no place is expected where the map has it
  loops.options.sightings = 2;                     // and a third of an image shows it to no more
  CHECK(closed_on_trial(loops, ring.map, TrialEvidence::kLikelyDrift) > 0);
  INFO(before << " m before, " << error(ring) << " m after");
  CHECK(error(ring) < 0.5 * before);
}

TEST_CASE("No loop is tried where no trial is allowed") {
  Ring ring;
  LoopClosing<double> loops;
  loops.options.trials = 0;
  CHECK(loops.missed(ring.map).empty());
}
