// SPDX-License-Identifier: BSD-3-Clause
// Blessed combinations of stages. An ablation is an alias: the same pipeline with a null model in one place.
#pragma once

#include "sslam/track/fallback.hpp"
#include "sslam/track/initialisation.hpp"
#include "sslam/track/keyframe_choice.hpp"
#include "sslam/track/mapping.hpp"
#include "sslam/track/pipeline.hpp"
#include "sslam/track/refinement.hpp"
#include "sslam/track/rotation.hpp"
#include "sslam/track/translation.hpp"

namespace sslam::presets {

// The paper's method: decoupled tracking with the Manhattan frame, fallback, refinement against the local map.
template <Scalar S, MapOptimiser<S> Optimiser = NoOptimiser<S>, StageTimer Timer = NoTimer>
using Structure = Pipeline<S, ManhattanRotation<S>, DecoupledInitialisation<S>, DecoupledTranslation<S>,
                           FeatureFallback<S>, LocalMapRefinement<S>, SharedFeatureKeyframes<S>,
                           KeyframeMapping<S, Optimiser>, Timer>;

// No Manhattan world: points and lines alone.
template <Scalar S, MapOptimiser<S> Optimiser = NoOptimiser<S>, StageTimer Timer = NoTimer>
using Features = Pipeline<S, NoRotation<S>, DecoupledInitialisation<S>, NoTranslation<S>, FeatureFallback<S>,
                          LocalMapRefinement<S>, SharedFeatureKeyframes<S>, KeyframeMapping<S, Optimiser>, Timer>;

// Frame to frame, without the local map: what the decoupled tracking does on its own.
template <Scalar S, MapOptimiser<S> Optimiser = NoOptimiser<S>, StageTimer Timer = NoTimer>
using Odometry = Pipeline<S, ManhattanRotation<S>, DecoupledInitialisation<S>, DecoupledTranslation<S>,
                          FeatureFallback<S>, NoRefinement<S>, SharedFeatureKeyframes<S>,
                          KeyframeMapping<S, Optimiser>, Timer>;

}  // namespace sslam::presets
