// SPDX-License-Identifier: BSD-3-Clause
// A command line as it was given, in words from which the same one can be made again.
#pragma once

#include <CLI/CLI.hpp>
#include <algorithm>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace sslam::cli {

// "stride"; of what has no such name, its place: "dataset".
[[nodiscard]] inline std::string name_of(const CLI::Option& option) {
  return option.get_lnames().empty() ? option.get_single_name() : option.get_lnames().front();
}

// The options that were given, by the command line or a file, but those that are to be left out.
[[nodiscard]] inline std::vector<const CLI::Option*> given_options(const CLI::App& command,
                                                                   std::span<const char* const> without) {
  std::vector<const CLI::Option*> given;
  for (const CLI::Option* option : command.get_options()) {
    const std::string name = name_of(*option);
    if (option->count() > 0 && std::find(without.begin(), without.end(), name) == without.end())
      given.push_back(option);
  }
  return given;
}

// Those that stand without a name come last, behind "--".
[[nodiscard]] inline std::vector<std::string> words_of(const CLI::App& command,
                                                       std::span<const char* const> without) {
  std::vector<std::string> words, places;
  for (const CLI::Option* option : given_options(command, without))
    for (const std::string& value : option->results()) {
      if (option->get_positional())
        places.push_back(value);
      else
        words.push_back("--" + name_of(*option) + "=" + value);
    }
  words.emplace_back("--");
  words.insert(words.end(), places.begin(), places.end());
  return words;
}

}  // namespace sslam::cli
