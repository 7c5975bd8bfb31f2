// SPDX-License-Identifier: BSD-3-Clause
// Everything of the component ceres: bundle adjustment, local and global, and self-calibration.
#pragma once

#include "sslam/ceres/bundle_blocks.hpp"
#include "sslam/ceres/bundle_solver.hpp"
#include "sslam/ceres/camera_adjustment.hpp"
#include "sslam/ceres/camera_estimate.hpp"
#include "sslam/ceres/cost_functions.hpp"
#include "sslam/ceres/global_bundle_adjustment.hpp"
#include "sslam/ceres/lens_costs.hpp"
#include "sslam/ceres/local_bundle_adjustment.hpp"
#include "sslam/ceres/manifolds.hpp"
#include "sslam/ceres/marginal_covariance.hpp"
#include "sslam/ceres/plane_costs.hpp"
#include "sslam/ceres/schur_problem.hpp"
