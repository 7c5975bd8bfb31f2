// SPDX-License-Identifier: BSD-3-Clause
// Large files from the network, resumed where an earlier try has stopped.
#pragma once

#include <filesystem>
#include <string>

#include "cli/shell/progress.hpp"

namespace sslam::cli {

// Into `file`, by way of `file`.part, which an earlier try may have left. Throws Error in one line; Stop
// when interrupted. What has been received stays in both cases.
void download(const std::string& address, const std::filesystem::path& file, Verbosity verbosity);

}  // namespace sslam::cli
