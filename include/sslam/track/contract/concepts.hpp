// SPDX-License-Identifier: BSD-3-Clause
// What the pipeline asks of each of its stages. A model of your own that satisfies a concept plugs in as it
// is.
#pragma once

#include <concepts>
#include <optional>
#include <utility>
#include <vector>

#include "sslam/track/contract/pose_estimate.hpp"
#include "sslam/track/localise/rotation.hpp"
#include "sslam/track/localise/translation.hpp"
#include "sslam/track/loops/loop_closing.hpp"
#include "sslam/track/upkeep/map_change.hpp"

namespace sslam {

// Estimates the frame's rotation from structure alone, without drift.
template <class T, class S>
concept RotationStage = requires(T stage, TrackedFrame<S>& frame, const SO3<S>& predicted, bool mapped,
                                 const std::vector<SO3<S>>& known) {
  { stage.rotate(frame, predicted, mapped) } -> std::same_as<RotationAnswer<S>>;
  { stage.world_from_manhattan() } -> std::convertible_to<std::vector<SO3<S>>>;
  stage.lose();
  stage.reset(known);
};

// Makes the first map from two frames.
template <class T, class S>
concept InitialisationStage = requires(T stage, TrackedFrame<S>& frame, Map<S>& map) {
  { stage.start(frame, map) } -> std::same_as<Reason>;
  stage.reset();
};

// Solves the translation of a frame whose rotation is known.
template <class T, class S>
concept TranslationStage = requires(T stage, const Map<S>& map, const RecentLandmarks<S>& recent,
                                    TrackedFrame<S>& frame) {
  { stage.translate(map, recent, frame) } -> std::same_as<PoseEstimate<S>>;
};

// Solves all six degrees of freedom from recent frames or from one keyframe.
template <class T, class S>
concept FallbackStage = requires(T stage, const Map<S>& map, const RecentLandmarks<S>& recent,
                                 KeyframeId keyframe, const RotationPrior<S>* prior, TrackedFrame<S>& frame) {
  { stage.track(map, recent, prior, frame) } -> std::same_as<PoseEstimate<S>>;
  { stage.track_keyframe(map, keyframe, prior, frame) } -> std::same_as<PoseEstimate<S>>;
};

// Checks a pose against the local map and refines it.
template <class T, class S>
concept RefinementStage = requires(T stage, Map<S>& map, const RotationPrior<S>* prior,
                                   TrackedFrame<S>& frame) {
  { stage.refine(map, prior, frame) } -> std::same_as<PoseEstimate<S>>;
};

// Decides whether a tracked frame becomes a keyframe.
template <class T, class S>
concept KeyframeStage = requires(const T stage, const Map<S>& map, const TrackedFrame<S>& frame) {
  { stage.choose(map, KeyframeId{}, frame, int{}, int{}, S{}) } -> std::same_as<bool>;
};

// Takes a keyframe into the map.
template <class T, class S>
concept MappingStage = requires(T stage, Map<S>& map, TrackedFrame<S>& frame) {
  { stage.insert(map, frame, S{}) } -> std::same_as<KeyframeId>;
  stage.begin(map, frame, S{});
};

// Notices that a new keyframe shows a place of the map that it is not connected with, and mends the drift; or
// a place of another map, and joins both.
template <class T, class S>
concept LoopStage = requires(T stage, Map<S>& map, const Loop<S>& loop, std::optional<PlaceMatch<S>>& met) {
  { stage.close(map, KeyframeId{}) } -> std::same_as<LoopAnswer<S>>;
  { stage.detection.find(std::as_const(map), KeyframeId{}, map) } -> std::same_as<std::optional<Loop<S>>>;
  { stage.detection.check.confirmed(Keyframe<S>(), map, loop, met) } -> std::same_as<bool>;
  { stage.merge(map, Map<S>(), KeyframeId{}, loop) } -> std::same_as<MapJoint<S>>;
  stage.forget();  // the map is another one
};

// Decides when and where mapping and loop closing happen.
template <class T, class S, class Mapping, class Loops>
concept UpkeepStage = requires(T stage, Map<S>& map, TrackedFrame<S>& frame, Mapping& mapping, Loops& loops) {
  // kNone: the map cannot take the frame now.
  { stage.insert(map, frame, KeyframeId{}, S{}, mapping, loops) } -> std::same_as<KeyframeId>;
  { stage.close(map, KeyframeId{}, loops) } -> std::same_as<LoopAnswer<S>>;
  // The map as it has become elsewhere; null where that is nothing new.
  { stage.renew(map) } -> std::same_as<const MapChange<S>*>;
  { stage.finish(map) } -> std::same_as<const MapChange<S>*>;
  stage.forget();
};

}  // namespace sslam
