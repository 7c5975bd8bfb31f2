// SPDX-License-Identifier: BSD-3-Clause
// Completion of the command line in a shell, made from the tree of commands.
#pragma once

#include <string>

namespace CLI {
class App;
}

namespace sslam::cli {

// For bash to source.
[[nodiscard]] std::string bash_completion(const CLI::App& app);  // bash_completion.cpp

// _sslam, for a folder in zsh's fpath.
[[nodiscard]] std::string zsh_completion(const CLI::App& app);  // zsh_completion.cpp

}  // namespace sslam::cli
