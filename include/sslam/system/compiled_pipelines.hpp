// SPDX-License-Identifier: BSD-3-Clause
// The pipelines compiled in sslam::system: a program that includes this and links it does not compile them.
#pragma once

#include "sslam/live/mapping_thread.hpp"
#include "sslam/system/pipeline_engine.hpp"
#include "sslam/track/presets.hpp"

namespace sslam {

using StructurePipeline = presets::Structure<double, WallTimer>;
using LiveStructurePipeline = live::Structure<double, WallTimer>;
using PaperPipeline = presets::Paper<double, WallTimer>;
using FeaturesPipeline = presets::Features<double, WallTimer>;
using OdometryPipeline = presets::Odometry<double, WallTimer>;

extern template class PipelineEngine<StructurePipeline>;      // src/structure.cpp
extern template class PipelineEngine<LiveStructurePipeline>;  // src/structure_live.cpp
extern template class PipelineEngine<PaperPipeline>;          // src/paper.cpp
extern template class PipelineEngine<FeaturesPipeline>;       // src/features.cpp
extern template class PipelineEngine<OdometryPipeline>;       // src/odometry.cpp

}  // namespace sslam
