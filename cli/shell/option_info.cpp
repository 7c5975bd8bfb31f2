// SPDX-License-Identifier: BSD-3-Clause
#include "cli/shell/option_info.hpp"

namespace sslam::cli {
namespace {

// "{a,b}" as in TEXT:{a,b}
std::vector<std::string> words_of_type(const std::string& type) {
  const auto open = type.find('{'), close = type.rfind('}');
  if (open == std::string::npos || close == std::string::npos || close < open) return {};
  return CLI::detail::split(type.substr(open + 1, close - open - 1), ',');
}

ValueKind kind_of(const OptionInfo& info) {
  if (!info.words.empty()) return ValueKind::kWord;
  if (info.value == "DIR") return ValueKind::kFolder;
  // Arguments are data sets, files or folders.
  if (info.flags.empty() || info.value == "FILE" || info.value == "SOURCE") return ValueKind::kFile;
  for (const char* number : {"INT", "UINT", "FLOAT"})
    if (info.value == number) return ValueKind::kNumber;
  return ValueKind::kText;
}

}  // namespace

OptionInfo describe_option(const CLI::Option& option) {
  OptionInfo info;
  for (const std::string& name : option.get_snames()) info.flags.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) info.flags.push_back("--" + name);
  if (option.get_positional()) info.name = option.get_name(true);
  info.meaning = option.get_description();
  info.required = option.get_required();
  if (option.get_items_expected_max() == 0) return info;
  const std::string type = option.get_type_name();
  info.words = words_of_type(type);
  info.value = type.substr(0, type.find(':'));  // behind it, CLI11 says what is checked
  if (!info.words.empty()) info.value = "WORD";
  if (type.ends_with(":FILE")) info.value = "FILE";
  info.kind = kind_of(info);
  info.default_value = option.get_default_str();
  info.repeated = option.get_items_expected_max() > 1;
  return info;
}

std::string words_type(const std::vector<std::string>& words) {
  return "{" + CLI::detail::join(words, ",") + "}";
}

CommandInfo describe_command(const CLI::App& app) {
  CommandInfo command{app.get_name(), app.get_description(), {}, {}};
  for (const CLI::Option* option : app.get_options()) {
    if (option->get_group().empty()) continue;
    (option->get_positional() ? command.positionals : command.options).push_back(describe_option(*option));
  }
  return command;
}

std::vector<CommandInfo> describe_subcommands(const CLI::App& app) {
  std::vector<CommandInfo> commands;
  for (const CLI::App* command : app.get_subcommands(nullptr))
    if (!command->get_group().empty()) commands.push_back(describe_command(*command));
  return commands;
}

}  // namespace sslam::cli
