// SPDX-License-Identifier: BSD-3-Clause
// The heavy kernels are instantiated once for each scalar, in src/, instead of once for every pipeline. A
// program that includes this must link sslam::stages, which has them for double. SSLAM_FLOAT_KERNELS says
// that those for float are linked as well.
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

// One macro for each family: KERNELS(extern, S) declares what KERNELS(, S) instantiates.
#define SSLAM_MANHATTAN_KERNELS(EXTERN, S)                                                                   \
  EXTERN template ManhattanEstimate<S> track_manhattan(                                                      \
      const NormalView<float>&, std::span<const LineVote<S>>, const ManhattanPrior<S>&,                      \
      const ManhattanOptions<S>&, std::span<std::int8_t>) noexcept;                                          \
  EXTERN template ManhattanEstimate<S> find_manhattan(const NormalView<float>&,                              \
                                                      std::span<const LineVote<S>>, const SearchOptions<S>&, \
                                                      std::uint64_t, std::span<std::int8_t>) noexcept;

#define SSLAM_TWO_VIEW_KERNELS(EXTERN, S)                                                                    \
  EXTERN template TranslationEstimate<S> translation_from_rotation(                                          \
      std::span<const BearingMatch<S>>, const SO3<S>&, const TranslationOptions<S>&, std::uint64_t,          \
      std::span<std::uint8_t>) noexcept;                                                                     \
  EXTERN template RelativePoseSummary<S> refine_relative_pose(std::span<const BearingMatch<S>>, SO3<S>&,     \
                                                              Vec3<S>&, const RelativePoseOptions<S>&,       \
                                                              std::span<std::uint8_t>) noexcept;             \
  EXTERN template RelativePoseSummary<S> find_relative_pose(                                                 \
      std::span<const BearingMatch<S>>, const FindRelativePoseOptions<S>&, std::uint64_t, SO3<S>&, Vec3<S>&, \
      std::span<std::uint8_t>) noexcept;

#define SSLAM_TRIANGULATION_KERNELS(EXTERN, S)                                                           \
  EXTERN template PointTriangulation<S> triangulate_point(std::span<const PointView<S>>,                 \
                                                          const PointTriangulationOptions<S>&) noexcept; \
  EXTERN template LineTriangulation<S> triangulate_line(std::span<const LineView<S>>,                    \
                                                        const LineTriangulationOptions<S>&) noexcept;

#define SSLAM_POSE_KERNELS(EXTERN, S)                                                                        \
  EXTERN template PoseSummary<S, 6> refine_pose(const Pinhole<S>&, std::span<const PointObservation<S>>,     \
                                                std::span<const LineObservation<S>>, SE3<S>&,                \
                                                const PoseRefinementOptions<S>&, std::span<std::uint8_t>,    \
                                                std::span<std::uint8_t>, const RotationPrior<S>*) noexcept;  \
  EXTERN template PoseSummary<S, 3> refine_translation(                                                      \
      const Pinhole<S>&, std::span<const PointObservation<S>>, std::span<const LineObservation<S>>, SE3<S>&, \
      const PoseRefinementOptions<S>&, std::span<std::uint8_t>, std::span<std::uint8_t>) noexcept;

#define SSLAM_KERNELS(EXTERN, S)         \
  SSLAM_MANHATTAN_KERNELS(EXTERN, S)     \
  SSLAM_TWO_VIEW_KERNELS(EXTERN, S)      \
  SSLAM_TRIANGULATION_KERNELS(EXTERN, S) \
  SSLAM_POSE_KERNELS(EXTERN, S)          \
  EXTERN template class BundleSolver<S>;

namespace sslam {

SSLAM_KERNELS(extern, double)
extern template class PoseGraphSolver<double>;
#ifdef SSLAM_FLOAT_KERNELS
SSLAM_KERNELS(extern, float)
#endif

}  // namespace sslam
