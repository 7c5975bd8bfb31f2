// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/solver/triangulation/triangulate_line.hpp"

namespace sslam::embedded {

void run_triangulate_line(std::span<const LineView<float>> views,
                          const LineTriangulationOptions<float>& options,
                          LineTriangulation<float>& out) noexcept {
  out = triangulate_line(views, options);
}

}  // namespace sslam::embedded
