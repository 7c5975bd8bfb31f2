// SPDX-License-Identifier: BSD-3-Clause
// The heavy kernels are instantiated once, in src/, instead of once for every pipeline.
#pragma once

#include "sslam/manhattan/rotation.hpp"
#include "sslam/manhattan/search.hpp"
#include "sslam/solver/bundle/bundle_solver.hpp"
#include "sslam/solver/bundle/pose_graph_solver.hpp"
#include "sslam/solver/pose/pose_refinement.hpp"
#include "sslam/solver/triangulation/triangulate_line.hpp"
#include "sslam/solver/triangulation/triangulate_point.hpp"
#include "sslam/solver/two_view/find_relative_pose.hpp"
#include "sslam/solver/two_view/relative_pose.hpp"
#include "sslam/solver/two_view/translation.hpp"

namespace sslam {

extern template ManhattanEstimate<double> track_manhattan(
    const NormalView<float>&, std::span<const LineVote<double>>, const ManhattanPrior<double>&,
    const ManhattanOptions<double>&, std::span<std::int8_t>) noexcept;  // kernels_manhattan.cpp
extern template ManhattanEstimate<double> find_manhattan(
    const NormalView<float>&, std::span<const LineVote<double>>, const SearchOptions<double>&, std::uint64_t,
    std::span<std::int8_t>) noexcept;  // kernels_manhattan.cpp
extern template TranslationEstimate<double> translation_from_rotation(
    std::span<const BearingMatch<double>>, const SO3<double>&, const TranslationOptions<double>&,
    std::uint64_t, std::span<std::uint8_t>) noexcept;  // kernels_two_view.cpp
extern template RelativePoseSummary<double> refine_relative_pose(
    std::span<const BearingMatch<double>>, SO3<double>&, Vec3<double>&, const RelativePoseOptions<double>&,
    std::span<std::uint8_t>) noexcept;  // kernels_two_view.cpp
extern template RelativePoseSummary<double> find_relative_pose(
    std::span<const BearingMatch<double>>, const FindRelativePoseOptions<double>&, std::uint64_t,
    SO3<double>&, Vec3<double>&, std::span<std::uint8_t>) noexcept;  // kernels_two_view.cpp
extern template PointTriangulation<double> triangulate_point(
    std::span<const PointView<double>>,
    const PointTriangulationOptions<double>&) noexcept;  // kernels_mapping.cpp
extern template LineTriangulation<double> triangulate_line(
    std::span<const LineView<double>>,
    const LineTriangulationOptions<double>&) noexcept;  // kernels_mapping.cpp
extern template PoseSummary<double, 6> refine_pose(
    const Pinhole<double>&, std::span<const PointObservation<double>>,
    std::span<const LineObservation<double>>, SE3<double>&, const PoseRefinementOptions<double>&,
    std::span<std::uint8_t>, std::span<std::uint8_t>,
    const RotationPrior<double>*) noexcept;     // kernels_mapping.cpp
extern template class BundleSolver<double>;     // adjustment.cpp
extern template class PoseGraphSolver<double>;  // loops.cpp
extern template PoseSummary<double, 3> refine_translation(
    const Pinhole<double>&, std::span<const PointObservation<double>>,
    std::span<const LineObservation<double>>, SE3<double>&, const PoseRefinementOptions<double>&,
    std::span<std::uint8_t>, std::span<std::uint8_t>) noexcept;  // kernels_mapping.cpp

}  // namespace sslam
