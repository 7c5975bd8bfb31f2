// SPDX-License-Identifier: BSD-3-Clause
// Blessed sets of stages. An ablation is an alias: the same pipeline with a null model in one slot.
#pragma once

#include "sslam/map/map_adjustment.hpp"
#include "sslam/solver/bundle/bundle_solver.hpp"
#include "sslam/track/localise/fallback.hpp"
#include "sslam/track/localise/refinement.hpp"
#include "sslam/track/localise/rotation.hpp"
#include "sslam/track/localise/translation.hpp"
#include "sslam/track/loops/loop_closing.hpp"
#include "sslam/track/mapping/initialisation.hpp"
#include "sslam/track/mapping/keyframe_choice.hpp"
#include "sslam/track/mapping/mapping.hpp"
#include "sslam/track/pipeline.hpp"
#include "sslam/track/slots.hpp"
#include "sslam/track/upkeep/immediate_upkeep.hpp"
#include "sslam/track/worlds/final_pass.hpp"
#include "sslam/track/worlds/no_final_pass.hpp"

namespace sslam::presets {

// The pipeline with one stage replaced, or more: With<Structure<double>, slots::Rotation<Gyroscope>>.
template <class Preset, class... Slots>
using With =
    Pipeline<typename Preset::ScalarType, typename detail::Replaced<typename Preset::Stages, Slots...>::Type>;

// Bundle adjustment around each new keyframe, with planes where a Manhattan frame is known.
template <Scalar S>
using BundleMapping = KeyframeMapping<S, MapAdjustment<S, BundleSolver<S>>, ManhattanPlanes<S>>;

template <Scalar S, StageTimer Clock>
struct StructureStages {
  using Rotation = ManhattanRotation<S>;
  using Initialisation = DecoupledInitialisation<S>;
  using Translation = DecoupledTranslation<S>;
  using Fallback = FeatureFallback<S>;
  using Refinement = LocalMapRefinement<S>;
  using Keyframes = SharedFeatureKeyframes<S>;
  using Mapping = BundleMapping<S>;
  using Loops = LoopClosing<S>;
  using Upkeep = ImmediateUpkeep<S>;
  using Final = FinalPass<S>;
  using Timer = Clock;
};

// Decoupled tracking with the Manhattan frame, fallback, refinement against the local map, local bundle
// adjustment, loop closing.
template <Scalar S, StageTimer Timer = NoTimer>
using Structure = Pipeline<S, StructureStages<S, Timer>>;

// The same as published (Li et al. 2020): landmarks stay as they were triangulated.
template <Scalar S, StageTimer Timer = NoTimer>
using Paper = With<Structure<S, Timer>, slots::Mapping<KeyframeMapping<S>>, slots::Loops<NoLoopClosing<S>>,
                   slots::Final<NoFinalPass<S>>>;

// No Manhattan world: points and lines alone.
template <Scalar S, StageTimer Timer = NoTimer>
using Features =
    With<Structure<S, Timer>, slots::Rotation<NoRotation<S>>, slots::Translation<NoTranslation<S>>>;

// Frame to frame, without refinement against the local map.
template <Scalar S, StageTimer Timer = NoTimer>
using Odometry = With<Structure<S, Timer>, slots::Refinement<NoRefinement<S>>, slots::Loops<NoLoopClosing<S>>,
                      slots::Final<NoFinalPass<S>>>;

}  // namespace sslam::presets
