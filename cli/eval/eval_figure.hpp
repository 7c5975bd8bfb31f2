// SPDX-License-Identifier: BSD-3-Clause
// `sslam eval --plot`: paths, errors over time, and positions and angles one by one, on one page.
#pragma once

#include <string>
#include <vector>

#include "cli/eval/figure.hpp"
#include "sslam/io/trajectories/trajectory.hpp"

namespace sslam::cli {

struct PlottedEstimate {
  std::string name;
  io::Trajectory poses;                                                // aligned: in the ground truth's world
  std::vector<double> error_stamps, position_errors, rotation_errors;  // metres, radians
};

// seconds_per_stamp: of all stamps. Curves break where poses pause for more than five ordinary steps.
[[nodiscard]] Figure eval_figure(const io::Trajectory& truth, const std::vector<PlottedEstimate>& estimates,
                                 double seconds_per_stamp);

}  // namespace sslam::cli
