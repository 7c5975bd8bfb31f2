// SPDX-License-Identifier: BSD-3-Clause
// What the tree of commands knows about itself, for what is made from it: the man page and the completions.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace sslam::cli {

enum class ValueKind {
  kNone,    // a flag
  kWord,    // one of a few words
  kFolder,  // DIR
  kNumber,
  kFile,
  kText,  // of one's own
};

struct OptionInfo {
  std::vector<std::string> flags;  // --long and -s; of a positional argument: none
  std::string name;                // of a positional argument
  ValueKind kind = ValueKind::kNone;
  std::string value;               // what stands for the value, such as FILE
  std::vector<std::string> words;  // that the value may be
  std::string meaning, default_value;
  bool required = false, repeated = false;
};

struct CommandInfo {
  std::string name, meaning;
  std::vector<OptionInfo> positionals, options;
};

// For Option::type_name: the value is one of these.
[[nodiscard]] std::string words_type(const std::vector<std::string>& words);

[[nodiscard]] OptionInfo describe_option(const CLI::Option& option);

// Of an application or a subcommand, in the order in which its options were added; hidden ones are left out.
[[nodiscard]] CommandInfo describe_command(const CLI::App& app);

[[nodiscard]] std::vector<CommandInfo> describe_subcommands(const CLI::App& app);

}  // namespace sslam::cli
