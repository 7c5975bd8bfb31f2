// SPDX-License-Identifier: BSD-3-Clause
// What several exports say of a run that they cannot bring over whole.
#pragma once

#include <cmath>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>

#include "cli/results/run_folder.hpp"
#include "cli/shell/messages.hpp"

namespace sslam::cli {

// The run's camera is that of the undistorted images, and the files are those of the lens.
inline void warn_of_wide_lens(const RunFolder& run) {
  const auto settings = run.metrics.find("settings");
  if (settings == run.metrics.end() || !settings->is_object()) return;
  const auto degrees = settings->find("undistorted_to_degrees");
  if (degrees == settings->end() || !degrees->is_number()) return;
  print_warning(
      "the run's images are of a wide lens, and the exported camera is that of a pinhole's view of " +
      std::to_string(std::lround(degrees->get<double>())) +
      " degrees across: undistort the images to it before using them");
}

// Keyframes that were left out.
inline void warn_of_strangers(std::size_t count) {
  if (count > 0)
    print_warning(std::to_string(count) +
                  " keyframes are in no row of frames.csv (an earlier run's?): left out, since their images "
                  "are not known");
}

}  // namespace sslam::cli
