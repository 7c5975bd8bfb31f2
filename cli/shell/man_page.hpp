// SPDX-License-Identifier: BSD-3-Clause
// The man page, made from the tree of commands, so that it cannot say anything else than --help.
#pragma once

#include <string>

namespace CLI {
class App;
}

namespace sslam::cli {

// troff with the macros of man(7).
[[nodiscard]] std::string man_page(const CLI::App& app);

}  // namespace sslam::cli
