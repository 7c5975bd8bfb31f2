// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/system/compiled_pipelines.hpp"
#include "sslam/system/compiled_stages.hpp"

template class sslam::PipelineEngine<sslam::FeaturesPipeline>;
