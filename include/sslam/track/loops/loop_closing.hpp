// SPDX-License-Identifier: BSD-3-Clause
// Loop closing: where a place is met again, the drift in between is spread over the keyframes on the way,
// what stands twice in the map becomes one, and everything is adjusted together (Mur-Artal, Montiel, Tardos,
// ORB-SLAM, T-RO 2015, section VII).
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "sslam/map/essential_graph.hpp"
#include "sslam/map/map_adjustment.hpp"
#include "sslam/map/map_deformation.hpp"
#include "sslam/solver/bundle/pose_graph_solver.hpp"
#include "sslam/track/contract/concepts.hpp"
#include "sslam/track/loops/loop_detection.hpp"
#include "sslam/track/loops/loop_evidence.hpp"
#include "sslam/track/loops/map_join.hpp"
#include "sslam/track/loops/place_joining.hpp"

namespace sslam {

template <Scalar S>
struct LoopClosingOptions {
  std::size_t place_keyframes = 10;  // around the place, whose landmarks are looked for again
  S in_place = S(0.8);  // share of the place's landmarks that are where the map has them: nothing has drifted
  int trials = 10;      // of places that were met once, after the last frame; each copies the map
  int sightings = 3;    // keyframes around that recognise the place: on trial they stand for a second one,
  S max_drift = S(0.05);  // where the place is off by at most this share of the way since then

  template <class Self, class Visit>
  static void parameters(Self& self, Visit&& visit) {
    visit("place_keyframes", self.place_keyframes, Unit::kCount, 1, 1000,
          "around a place, whose landmarks are looked for again");
    visit("in_place", self.in_place, Unit::kShare, 0, 1,
          "of a place's landmarks, that are where the map has them: nothing has drifted");
    visit("trials", self.trials, Unit::kCount, 0, 10000,
          "of loops by a single sighting, after the last frame; 0: none is tried");
    visit("sightings", self.sightings, Unit::kCount, 1, 1000,
          "keyframes that recognise a place, which close its loop on trial where the drift is likely");
    visit("max_drift", self.max_drift, Unit::kShare, 0, 1,
          "of the way between both visits of a place, that drift is likely to move the camera by");
  }
};
static_assert(Described<LoopClosingOptions<double>>);

template <Scalar S>
class LoopClosing {
 public:
  LoopClosingOptions<S> options;
  LoopDetection<S> detection;
  EssentialGraph<S> essential;
  PoseGraphSolver<S> pose_graph;
  MapAdjustment<S, BundleSolver<S>> adjustment;
  PlaceJoining<S> joining;

  // With those of its detection, adjustment and fusion.
  template <class Self, class Visit>
  static void parameters(Self& self, Visit&& visit) {
    visit_within("", self.options, visit);
    visit_stage("", self.detection, visit);
    visit_stage("graph.", self.essential, visit);
    visit_stage("graph.", self.pose_graph, visit);
    visit_stage("adjustment.", self.adjustment, visit);
    visit_stage("fusion.", self.joining.fusion, visit);
  }

  // Drift bends the map as a whole, which is slow to adjust.
  LoopClosing() {
    adjustment.solver.options.max_iterations = 20;
    adjustment.solver.options.min_decrease = S(1e-5);
  }

  // The keyframe has just been taken into the map.
  LoopAnswer<S> close(Map<S>& map, KeyframeId id);

  // After the last frame: keyframes that show a place which they are not connected with, at most
  // `options.trials`; those that share most with it first.
  [[nodiscard]] std::vector<KeyframeId> missed(const Map<S>& map);

  // As close(), but where a second sighting lacks, the loop is closed on trial. It stands if keyframes around
  // then share points with the place beside those that it was closed by, as many as a second sighting asks.
  // Where they recognise the place by most of what they see, little is left beside: kLikelyDrift takes
  // several of them for it, if the way since then explains the drift. What only looks like the place stands
  // anywhere.
  LoopAnswer<S> close_on_trial(Map<S>& map, KeyframeId id, TrialEvidence evidence);

  [[nodiscard]] LoopDetection<S> finder() const { return detection; }

  // `other` becomes part of the map, as its keyframe `id`, which met the map there, says.
  MapJoint<S> merge(Map<S>& map, Map<S> other, KeyframeId id, const Loop<S>& loop);

  // The map is another one.
  void forget() noexcept { met_.reset(); }

 private:
  enum class Drift : std::uint8_t { kInPlace, kSmall, kLarge };

  // How far the map has the place from where the keyframe sees it. A small drift needs no second sighting.
  [[nodiscard]] Drift drift(const Map<S>& map, KeyframeId id, const Loop<S>& loop) const {
    const Keyframe<S>& keyframe = map.keyframes[map.index(id)];
    if (share_in_place<S>(map, keyframe, loop, joining.fusion.options.point_radius) >= options.in_place)
      return Drift::kInPlace;
    const PlaceConfirmationOptions<S>& nearby = detection.confirmation.options;
    return share_in_place<S>(map, keyframe, loop, nearby.reach) < nearby.min_share ? Drift::kLarge
                                                                                   : Drift::kSmall;
  }

  [[nodiscard]] bool drift_is_likely(const Map<S>& map, KeyframeId id, const Loop<S>& loop) const {
    const Vec3<S> seen_from = loop.cam_from_world.inverse().translation;
    const Vec3<S> stands = map.keyframes[map.index(id)].cam_from_world.inverse().translation;
    return (seen_from - stands).norm() <= options.max_drift * way_between(map, loop.place, id);
  }

  LoopAnswer<S> close(Map<S>& map, KeyframeId id, const Loop<S>& loop, bool drifted) {
    if (drifted && !bend(map, id, loop)) return {};
    join(map, id, loop);
    if (!drifted) {
      adjustment.optimise(map, id);
      return {true, {}};
    }
    adjustment.optimise_all(map);
    return {true, new_from_old_};
  }

  // False, with the map as it was, when the poses cannot be brought together.
  [[nodiscard]] bool bend(Map<S>& map, KeyframeId id, const Loop<S>& loop) {
    essential.gather(map, adjustment.window_options);
    const SE3<S>& place = map.keyframes[map.index(loop.place)].cam_from_world;
    essential.add_loop(map, loop.place, id, loop.cam_from_world * similarity(place).inverse(), loop.matches);
    if (!improved(pose_graph.solve(essential.graph))) return false;
    new_from_old_.assign(map.keyframes.size(), {});
    for (std::size_t n = 0; n < essential.keyframes.size(); ++n) {
      const auto k = map.index(essential.keyframes[n]);
      new_from_old_[k] =
          essential.graph.nodes[n].cam_from_world.inverse() * similarity(map.keyframes[k].cam_from_world);
    }
    deform<S>(map, new_from_old_);
    return true;
  }

  // By what these keyframes show the place and what is around it.
  [[nodiscard]] std::vector<Sighting> sightings(const Map<S>& map, std::span<const KeyframeId> keyframes,
                                                KeyframeId place) {
    around_.gather_around(map, place, options.place_keyframes);
    const auto& near = around_.keyframes;
    std::vector<Sighting> all;
    for (const KeyframeId k : keyframes) {
      const std::optional<Loop<S>> loop = detection.find(map, k, map);
      if (!loop || std::find(near.begin(), near.end(), loop->place) == near.end()) continue;
      Sighting& sighting = all.emplace_back(Sighting{k, {}});
      for (std::size_t i = 0; i < loop->point_landmarks.size(); ++i)
        if (loop->point_landmarks[i] != kNone) sighting.features.push_back(i);
    }
    return all;
  }

  void join(Map<S>& map, KeyframeId id, const Loop<S>& loop) {
    joining.join(map, id, loop, options.place_keyframes);
  }

  LocalMap<S> around_;
  std::vector<Sim3<S>> new_from_old_;
  std::optional<PlaceMatch<S>> met_;  // a place that may be one which was left long ago
};

template <Scalar S>
LoopAnswer<S> LoopClosing<S>::close(Map<S>& map, KeyframeId id) {
  const std::optional<Loop<S>> loop = detection.find(map, id, map);
  if (!loop) return {};
  const Drift drifted = drift(map, id, *loop);
  if (drifted == Drift::kLarge && !detection.confirmed(map.keyframes[map.index(id)], map, *loop, met_))
    return {};
  forget();
  return close(map, id, *loop, drifted != Drift::kInPlace);
}

template <Scalar S>
std::vector<KeyframeId> LoopClosing<S>::missed(const Map<S>& map) {
  std::vector<std::pair<int, KeyframeId>> found;  // by matches, the most first
  for (const Keyframe<S>& kf : map.keyframes) {
    const auto loop = kf.alive() && options.trials > 0 ? detection.find(map, kf.id, map) : std::nullopt;
    if (loop) found.emplace_back(-loop->matches, kf.id);
  }
  std::sort(found.begin(), found.end());
  found.resize(std::min(found.size(), static_cast<std::size_t>(options.trials)));
  std::vector<KeyframeId> best(found.size());
  std::transform(found.begin(), found.end(), best.begin(), [](const auto& one) { return one.second; });
  return best;
}

template <Scalar S>
LoopAnswer<S> LoopClosing<S>::close_on_trial(Map<S>& map, KeyframeId id, TrialEvidence evidence) {
  const std::optional<Loop<S>> loop = detection.find(map, id, map);
  if (!loop) return {};
  const Drift drifted = drift(map, id, *loop);
  if (drifted != Drift::kLarge) return close(map, id, *loop, drifted == Drift::kSmall);
  const bool by_drift = evidence == TrialEvidence::kLikelyDrift;
  if (by_drift && !drift_is_likely(map, id, *loop)) return {};
  std::vector<KeyframeId> here;
  take_with_neighbours(map.keyframes[map.index(id)], map.keyframes.size(), here);
  const std::vector<Sighting> known = sightings(map, here, loop->place);
  if (by_drift && static_cast<int>(known.size()) < options.sightings) return {};
  Map<S> trial = map;
  if (!bend(trial, id, *loop)) return {};
  join(trial, id, *loop);
  adjustment.optimise(trial, id);
  joining.match_both_ways(trial, here, id);
  adjustment.optimise(trial, id);
  const PlaceConfirmationOptions<S>& second = detection.confirmation.options;
  if (!by_drift && shared_beside<S>(trial, known, here, joining.there(), second.apart) < second.min_new)
    return {};
  adjustment.optimise_all(trial);
  map = std::move(trial);
  return {true, new_from_old_};
}

template <Scalar S>
MapJoint<S> LoopClosing<S>::merge(Map<S>& map, Map<S> other, KeyframeId id, const Loop<S>& loop) {
  MapJoint<S> joint;
  joint.moved = loop.there_from_here(other.keyframes[map.index(id)].cam_from_world);
  joint.shift = append(map, std::move(other), joint.moved, detection.options.max_turn);
  join(map, id + joint.shift.keyframes, loop);
  adjustment.optimise_all(map);
  forget();
  return joint;
}

static_assert(LoopStage<LoopClosing<double>, double>);

}  // namespace sslam
