// SPDX-License-Identifier: BSD-3-Clause
// An option whose value is one of a few words.
#pragma once

#include <CLI/CLI.hpp>
#include <map>
#include <string>
#include <vector>

#include "cli/shell/option_info.hpp"
#include "sslam/io/files/text.hpp"

namespace sslam::cli {

// choose(value) gets the value of the word; `names` must outlive the parsing.
template <class Value, class Choose>
CLI::Option* add_choice_function(CLI::App& app, const std::string& flag, const Choose& choose,
                                 const std::map<std::string, Value>& names, const std::string& meaning) {
  std::vector<std::string> words;
  for (const auto& [name, value] : names) words.push_back(name);
  return app
      .add_option_function<std::string>(
          flag, [choose, &names](const std::string& word) { choose(names.at(word)); }, meaning)
      ->type_name(words_type(words))
      ->check([&names](const std::string& word) {
        if (names.count(word) != 0) return std::string();
        std::string known;
        for (const auto& [name, value] : names) io::add_to_list(known, name);
        return "'" + word + "' is not one of " + known;
      });
}

// `target` and `names` must outlive the parsing.
template <class Value>
void add_choice(CLI::App& app, const std::string& flag, Value& target,
                const std::map<std::string, Value>& names, const std::string& meaning) {
  add_choice_function(
      app, flag, [&target](const Value& value) { target = value; }, names, meaning);
}

}  // namespace sslam::cli
