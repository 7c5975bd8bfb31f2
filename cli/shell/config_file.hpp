// SPDX-License-Identifier: BSD-3-Clause
// --config FILE for a subcommand: the long names of its options as TOML keys, and a table [set] for
// parameters. What stands on the command line wins.
#pragma once

#include <CLI/CLI.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "cli/shell/toml_text.hpp"
#include "sslam/core/closest_word.hpp"
#include "sslam/core/error.hpp"

namespace sslam::cli {

namespace detail {

inline void apply_config_item(CLI::App& command, const std::string& file, const CLI::ConfigItem& item) {
  if (item.name == "++" || item.name == "--") return;  // CLI11's marks of where a section begins and ends
  const bool parameter = !item.parents.empty() && item.parents.front() == "set";
  const std::string key = item.fullname();
  CLI::Option* const option = command.get_option_no_throw(parameter ? "--set" : "--" + key);
  if (key == "config") throw Error(file + ": 'config': a file of options names no other one");
  if (option == nullptr) {
    std::vector<std::string> known;
    for (const CLI::Option* each : command.get_options())
      for (const std::string& name : each->get_lnames()) known.push_back(name);
    const std::string nearest = closest_word(key, known);
    throw Error(file + ": '" + key + "' is not an option of sslam " + command.get_name() +
                (nearest.empty() ? "" : "; did you mean '" + nearest + "'?"));
  }
  if (parameter) {
    // Of two settings of one parameter the later holds, and the command line has been read already.
    const std::vector<std::string> given = option->results();
    option->clear();
    option->add_result(key.substr(std::string("set.").size()) + "=" + item.inputs.at(0));
    option->add_result(given);
  } else if (option->count() == 0) {
    for (const std::string& value : item.inputs) option->add_result(value);
  }
}

}  // namespace detail

// Call it before any other option is added: options are read in the order in which they were added.
inline void add_config_option(CLI::App& command) {
  const auto apply = [&command](const std::string& file) {
    try {
      std::istringstream text(read_toml_text(file));
      for (const CLI::ConfigItem& item : CLI::ConfigTOML().from_config(text))
        detail::apply_config_item(command, file, item);
    } catch (const CLI::Error& error) {
      throw Error(file + ": " + error.what());
    }
  };
  command
      .add_option_function<std::string>("--config", apply,
                                        "TOML file of options; a table [set] for parameters")
      ->check(CLI::ExistingFile);
}

}  // namespace sslam::cli
