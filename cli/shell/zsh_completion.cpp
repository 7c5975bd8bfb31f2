// SPDX-License-Identifier: BSD-3-Clause
#include <CLI/CLI.hpp>

#include "cli/shell/completion.hpp"
#include "cli/shell/option_info.hpp"

namespace sslam::cli {
namespace {

// Its first line, in single quotes of the shell, with a backslash before each of `special`.
std::string quoted(const std::string& text, const std::string& special) {
  std::string safe;
  for (const char c : text.substr(0, text.find('\n'))) {
    if (special.find(c) != std::string::npos) safe += '\\';
    if (c == '\'')
      safe += "'\\''";
    else
      safe += c;
  }
  return safe;
}

std::string action(const OptionInfo& option) {
  switch (option.kind) {
    case ValueKind::kWord:
      return "(" + CLI::detail::join(option.words, " ") + ")";
    case ValueKind::kFolder:
      return "_files -/";
    case ValueKind::kNumber:
    case ValueKind::kText:
    case ValueKind::kNone:
      return " ";
    case ValueKind::kFile:
      break;
  }
  return "_files";
}

// As _arguments takes them.
std::string option_lines(const CommandInfo& command) {
  std::string text;
  for (const OptionInfo& option : command.options) {
    for (const std::string& flag : option.flags) {
      text += " \\\n        '" + std::string(option.repeated ? "*" : "") + flag + "[" +
              quoted(option.meaning, "[]\\") + "]";
      if (option.kind != ValueKind::kNone) text += ":" + quoted(option.value, ":\\") + ":" + action(option);
      text += "'";
    }
  }
  return text;
}

std::string branch(const CommandInfo& command) {
  std::string text = "    " + command.name + ")\n      _arguments" + option_lines(command);
  for (const OptionInfo& argument : command.positionals)
    text += " \\\n        ':" + quoted(argument.name, ":\\") + ":" + action(argument) + "'";
  return text + "\n      ;;\n";
}

}  // namespace

std::string zsh_completion(const CLI::App& app) {
  std::string text =
      "#compdef sslam\n# Completion of sslam's command line in zsh, made by `sslam --completion zsh`.\n"
      "local context state line curcontext=$curcontext\ntypeset -A opt_args\nlocal -a commands\ncommands=(\n";
  const std::vector<CommandInfo> commands = describe_subcommands(app);
  for (const CommandInfo& command : commands)
    text += "  '" + command.name + ":" + quoted(command.meaning, ":\\") + "'\n";
  text += ")\n_arguments -C" + option_lines(describe_command(app)) +
          " \\\n        '1:command:->command' \\\n        '*::argument:->argument'\ncase $state in\n"
          "command) _describe command commands ;;\nargument)\n  case $line[1] in\n";
  for (const CommandInfo& command : commands) text += branch(command);
  return text + "  esac\n  ;;\nesac\n";
}

}  // namespace sslam::cli
