// SPDX-License-Identifier: BSD-3-Clause
#include "cli/batch/suite_options.hpp"

#include <CLI/CLI.hpp>

#include "cli/batch/suite_table.hpp"
#include "cli/shell/usage_text.hpp"

namespace sslam::cli {
namespace {

bool is_flag(const std::string& key) {
  RunSettings ignored;
  CLI::App command;
  add_run_options(command, ignored);
  return command.get_option("--" + key)->get_expected_max() == 0;
}

}  // namespace

std::vector<SuiteOption> read_options(SuiteTable& table, std::string_view key) {
  std::vector<SuiteOption> options;
  const std::string name(key);
  for (const SuiteTable::Word& word : table.words(key)) {
    const bool flag = is_flag(name);
    if (flag != word.is_flag)
      table.fail(key, flag ? "expected true or false" : "expected a value, not true or false");
    options.push_back({name, word.text, flag, table.line_of(key)});
    try {
      if (const std::string argument = argument_of(options.back()); !argument.empty())
        (void)parse_run({"dataset", argument});
    } catch (const Error& error) {
      table.fail(key, error.what());
    }
  }
  return options;
}

std::string argument_of(const SuiteOption& option) {
  if (!option.flag) return "--" + option.key + "=" + option.value;
  return option.value == "true" ? "--" + option.key : "";
}

RunSettings parse_run(const std::vector<std::string>& words) {
  RunSettings settings;
  CLI::App command;
  add_run_options(command, settings);
  try {
    command.parse(std::vector<std::string>(words.rbegin(), words.rend()));  // as CLI11 takes them
  } catch (const CLI::ParseError& error) {
    throw Error(usage_text(error.what()));
  }
  return settings;
}

}  // namespace sslam::cli
