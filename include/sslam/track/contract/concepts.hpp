// SPDX-License-Identifier: BSD-3-Clause
// The interface of each stage of the pipeline, as a concept. Your own type that satisfies a concept can
// replace the stage.
#pragma once

#include <concepts>
#include <optional>

#include "sslam/map/map.hpp"
#include "sslam/solver/pose/rotation_prior.hpp"
#include "sslam/track/contract/loop.hpp"
#include "sslam/track/contract/loop_answer.hpp"
#include "sslam/track/contract/map_change.hpp"
#include "sslam/track/contract/place_match.hpp"
#include "sslam/track/contract/pose_estimate.hpp"
#include "sslam/track/contract/recent_landmarks.hpp"
#include "sslam/track/contract/rotation_answer.hpp"
#include "sslam/track/contract/stage_timer.hpp"

namespace sslam {

// Estimates the frame's rotation from structure alone, without drift. To search for the frame in another
// world, a copy of the stage is used, after forget().
template <class T, class S>
concept RotationStage = std::copyable<T> &&
    requires(T stage, const Frame<S>& frame, const SO3<S>& predicted, const KnownAxes<S>& known) {
  { stage.rotate(frame, predicted, known) } -> std::same_as<RotationAnswer<S>>;
  stage.lose();    // the frame has no pose after all
  stage.forget();  // the camera is in another world now
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

// Checks a pose against the local map and refines it. Counts in the map's landmarks how often they were seen.
template <class T, class S>
concept RefinementStage = requires(T stage, Map<S>& map, const RotationPrior<S>* prior,
                                   TrackedFrame<S>& frame) {
  { stage.refine(map, prior, frame) } -> std::same_as<PoseEstimate<S>>;
};

// Decides whether a tracked frame becomes a keyframe, by its inliers, the seconds since the last one, and the
// median depth of what it sees.
template <class T, class S>
concept KeyframeStage = requires(const T stage, const Map<S>& map, const TrackedFrame<S>& frame) {
  { stage.choose(map, KeyframeId{}, frame, int{}, double{}, S{}) } -> std::same_as<bool>;
};

// Takes a keyframe into the map.
template <class T, class S>
concept MappingStage = requires(T stage, Map<S>& map, TrackedFrame<S>& frame) {
  { stage.insert(map, frame, S{}) } -> std::same_as<KeyframeId>;
  stage.begin(map, frame, S{});
};

// Recognises places of one map in another.
template <class T, class S>
concept PlaceFinder = std::semiregular<T> &&
    requires(T finder, const Map<S>& here, const Map<S>& there, const Keyframe<S>& keyframe,
             const Loop<S>& loop, std::optional<PlaceMatch<S>>& first) {
  // Finds the place in `there` that a keyframe of `here` shows.
  { finder.find(here, KeyframeId{}, there) } -> std::same_as<std::optional<Loop<S>>>;
  // Whether `loop` confirms the match `first`. If they contradict each other, `loop` replaces it.
  { finder.confirmed(keyframe, there, loop, first) } -> std::same_as<bool>;
};

// Detects that a new keyframe shows a place of the map that it shares no landmarks with, and corrects the
// drift. Joins two maps if a place of one was found in the other.
template <class T, class S>
concept LoopStage = requires(T stage, const T idle, Map<S>& map, const Loop<S>& loop) {
  { stage.close(map, KeyframeId{}) } -> std::same_as<LoopAnswer<S>>;
  // After the last frame: missed() lists keyframes that show a place they share no landmarks with;
  // close_on_trial() tries to close the loop of one.
  { stage.missed(std::as_const(map)) } -> std::same_as<std::vector<KeyframeId>>;
  { stage.close_on_trial(map, KeyframeId{}, TrialEvidence{}) } -> std::same_as<LoopAnswer<S>>;
  { stage.merge(map, Map<S>(), KeyframeId{}, loop) } -> std::same_as<MapJoint<S>>;
  { idle.finder() } -> PlaceFinder<S>;  // a separate finder, for use while the stage works
  stage.forget();                       // another map follows
};

// Decides when and where mapping and loop closing happen.
template <class T, class S, class Mapping, class Loops>
concept UpkeepStage = requires(T stage, Map<S>& map, TrackedFrame<S>& frame, Mapping& mapping, Loops& loops) {
  // Inserts a keyframe. kNone: the map cannot take it now.
  { stage.insert(map, frame, KeyframeId{}, S{}, mapping, loops) } -> std::same_as<KeyframeId>;
  { stage.close(map, KeyframeId{}, loops) } -> std::same_as<LoopAnswer<S>>;
  // Takes over changes made to the map elsewhere; null if there are none.
  { stage.renew(map) } -> std::same_as<const MapChange<S>*>;
  { stage.finish(map) } -> std::same_as<const MapChange<S>*>;
  stage.forget();
};

// Processes the whole run once more after its last frame.
template <class T, class S>
concept FinalStage = requires(T stage, const T& done, const TrackedFrame<S>& frame) {
  stage.keep(frame);
  { done.full() } -> std::same_as<bool>;        // true: it keeps no more frames
  { done.read_out() } -> std::same_as<double>;  // seconds of a rolling shutter; 0: none
};

// One type for each slot of the pipeline.
template <class T, class S>
concept StageSet =
    RotationStage<typename T::Rotation, S> && InitialisationStage<typename T::Initialisation, S> &&
    TranslationStage<typename T::Translation, S> && FallbackStage<typename T::Fallback, S> &&
    RefinementStage<typename T::Refinement, S> && KeyframeStage<typename T::Keyframes, S> &&
    MappingStage<typename T::Mapping, S> && LoopStage<typename T::Loops, S> &&
    UpkeepStage<typename T::Upkeep, S, typename T::Mapping, typename T::Loops> &&
    FinalStage<typename T::Final, S> && StageTimer<typename T::Timer>;

}  // namespace sslam
