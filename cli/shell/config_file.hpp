// SPDX-License-Identifier: BSD-3-Clause
// --config FILE for a subcommand: the long names of its options as TOML keys, and a table [set] for
// parameters. What stands on the command line wins.
#pragma once

#include <CLI/CLI.hpp>
#include <map>
#include <string>

namespace sslam::cli {

// Call it before any other option is added: options are read in the order in which they were added. What is
// wrong with the file is an Error with file, line, key, what was found, and what would be right. `places`: of
// each parameter of [set], as --set takes it, "FILE: line N: "; null: nobody asks.
void add_config_option(CLI::App& command, std::map<std::string, std::string>* places = nullptr);

}  // namespace sslam::cli
