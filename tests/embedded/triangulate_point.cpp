// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/solver/triangulation/triangulate_point.hpp"

namespace sslam::embedded {

void run_triangulate_point(std::span<const PointView<float>> views,
                           const PointTriangulationOptions<float>& options,
                           PointTriangulation<float>& out) noexcept {
  out = triangulate_point(views, options);
}

}  // namespace sslam::embedded
