// SPDX-License-Identifier: BSD-3-Clause
// Blessed combinations of stages. An ablation is an alias: the same pipeline with a null model in one place.
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

namespace sslam::presets {

// Bundle adjustment around each new keyframe, with planes where a Manhattan frame is known.
template <Scalar S>
using BundleMapping = KeyframeMapping<S, MapAdjustment<S, BundleSolver<S>>, ManhattanPlanes<S>>;

// Decoupled tracking with the Manhattan frame, fallback, refinement against the local map, local bundle
// adjustment, loop closing.
template <Scalar S, StageTimer Timer = NoTimer, class Upkeep = ImmediateUpkeep<S>>
using Structure = Pipeline<S, ManhattanRotation<S>, DecoupledInitialisation<S>, DecoupledTranslation<S>,
                           FeatureFallback<S>, LocalMapRefinement<S>, SharedFeatureKeyframes<S>,
                           BundleMapping<S>, LoopClosing<S>, Timer, Upkeep>;

// The same as published (Li et al. 2020): landmarks stay as they were triangulated.
template <Scalar S, StageTimer Timer = NoTimer>
using Paper =
    Pipeline<S, ManhattanRotation<S>, DecoupledInitialisation<S>, DecoupledTranslation<S>, FeatureFallback<S>,
             LocalMapRefinement<S>, SharedFeatureKeyframes<S>, KeyframeMapping<S>, NoLoopClosing<S>, Timer>;

// No Manhattan world: points and lines alone.
template <Scalar S, StageTimer Timer = NoTimer>
using Features =
    Pipeline<S, NoRotation<S>, DecoupledInitialisation<S>, NoTranslation<S>, FeatureFallback<S>,
             LocalMapRefinement<S>, SharedFeatureKeyframes<S>, BundleMapping<S>, LoopClosing<S>, Timer>;

// Frame to frame, without refinement against the local map.
template <Scalar S, StageTimer Timer = NoTimer>
using Odometry =
    Pipeline<S, ManhattanRotation<S>, DecoupledInitialisation<S>, DecoupledTranslation<S>, FeatureFallback<S>,
             NoRefinement<S>, SharedFeatureKeyframes<S>, BundleMapping<S>, NoLoopClosing<S>, Timer>;

}  // namespace sslam::presets
