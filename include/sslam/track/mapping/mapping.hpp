// SPDX-License-Identifier: BSD-3-Clause
// Mapping: what happens when a frame becomes a keyframe. The optimiser is a policy, none or bundle
// adjustment, and so are planes, which ask for one that ties landmarks to them.
#pragma once

#include <concepts>

#include "sslam/track/contract/concepts.hpp"
#include "sslam/track/mapping/fusion.hpp"
#include "sslam/track/mapping/keyframe_culling.hpp"
#include "sslam/track/mapping/landmark_culling.hpp"
#include "sslam/track/mapping/new_landmarks.hpp"
#include "sslam/track/mapping/planes.hpp"

namespace sslam {

// Improves poses and landmarks around a keyframe in place.
template <class T, class S>
concept MapOptimiser = requires(T optimiser, Map<S>& map, KeyframeId keyframe) {
  {optimiser.optimise(map, keyframe)};
};

// Leaves the map as triangulation made it.
template <Scalar S>
struct NoOptimiser {
  void optimise(Map<S>&, KeyframeId) {}
};
static_assert(MapOptimiser<NoOptimiser<double>, double>);

template <Scalar S, MapOptimiser<S> Optimiser = NoOptimiser<S>, PlaneStep<S> Planes = NoPlanes<S>>
class KeyframeMapping {
 public:
  NewLandmarks<S> creation;
  LandmarkFusion<S> fusion;
  LandmarkCulling<S> culling;
  KeyframeCulling<S> keyframe_culling;
  Planes planes;
  Optimiser optimiser;

  // All but those of the planes, which have a name of their own.
  template <class Self, class Visit>
  static void parameters(Self& self, Visit&& visit) {
    visit_stage("", self.creation, visit);
    visit_stage("fusion.", self.fusion, visit);
    visit_stage("", self.culling, visit);
    visit_stage("", self.keyframe_culling, visit);
    visit_stage("adjustment.", self.optimiser, visit);
  }

  // The tracked frame joins the map; its pose and matches are updated with what mapping makes of them.
  KeyframeId insert(Map<S>& map, TrackedFrame<S>& frame, S median_depth);

  // Completes the map that initialisation has just made; the frame is its last keyframe.
  void begin(Map<S>& map, TrackedFrame<S>& frame, S median_depth);

 private:
  static constexpr std::size_t kYoung = 20;  // keyframes from whose free features most new landmarks are made
};

template <Scalar S, MapOptimiser<S> Optimiser, PlaneStep<S> Planes>
KeyframeId KeyframeMapping<S, Optimiser, Planes>::insert(Map<S>& map, TrackedFrame<S>& frame,
                                                         S median_depth) {
  const KeyframeId id = map.add_keyframe(frame.to_keyframe());
  if (map.index(id) >= kYoung) map.keyframes[map.index(id) - kYoung].drop_unseen_patches();
  culling.cull(map, id);
  creation.create(map, id, median_depth);
  fusion.fuse(map, id);
  planes.find(map, id, median_depth);
  map.update_covisibility(id);
  optimiser.optimise(map, id);
  keyframe_culling.cull(map, id);
  frame.read_back(map.keyframes[map.index(id)]);
  return id;
}

template <Scalar S, MapOptimiser<S> Optimiser, PlaneStep<S> Planes>
void KeyframeMapping<S, Optimiser, Planes>::begin(Map<S>& map, TrackedFrame<S>& frame, S median_depth) {
  const KeyframeId id = map.keyframes.back().id;
  creation.create(map, id, median_depth);
  planes.find(map, id, median_depth);
  map.update_covisibility(id);
  optimiser.optimise(map, id);
  frame.read_back(map.keyframes[map.index(id)]);
}
static_assert(MappingStage<KeyframeMapping<double>, double>);

}  // namespace sslam
