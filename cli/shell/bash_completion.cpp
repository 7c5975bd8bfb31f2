// SPDX-License-Identifier: BSD-3-Clause
#include <CLI/CLI.hpp>

#include "cli/shell/completion.hpp"
#include "cli/shell/option_info.hpp"

namespace sslam::cli {
namespace {

std::string joined(const std::vector<std::string>& words, const char* between) {
  return CLI::detail::join(words, between);
}

// A branch for the options whose value is not a file's name, which bash completes by itself.
std::string value_branches(const CommandInfo& command) {
  std::string text;
  for (const OptionInfo& option : command.options) {
    const std::string flags = "        " + joined(option.flags, "|") + ") ";
    if (option.kind == ValueKind::kWord)
      text += flags + "kind=words; words='" + joined(option.words, " ") + "' ;;\n";
    if (option.kind == ValueKind::kFolder) text += flags + "kind=folder ;;\n";
    if (option.kind == ValueKind::kNumber || option.kind == ValueKind::kText)
      text += flags + "kind=nothing ;;\n";
    if (option.kind == ValueKind::kFile) text += flags + "kind=file ;;\n";
  }
  return text;
}

std::string flags_of(const CommandInfo& command) {
  std::vector<std::string> flags;
  for (const OptionInfo& option : command.options)
    for (const std::string& flag : option.flags) flags.push_back(flag);
  return joined(flags, " ");
}

// pattern: of the command's name; otherwise: what to complete when no option asks for a value.
std::string branch(const CommandInfo& command, const std::string& pattern, const std::string& otherwise) {
  const std::string values = value_branches(command);
  return "    " + pattern + ")\n      options='" + flags_of(command) + "'\n" +
         (values.empty() ? "" : "      case $previous in\n" + values + "      esac\n") + otherwise +
         "      ;;\n";
}

constexpr const char* kBegin =
    R"(# Completion of sslam's command line in bash, made by `sslam --completion bash`.
_sslam() {
  local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD-1]}
  local command='' options='' words='' kind=argument i
  # --option=value comes in three words
  if [[ $current == = ]]; then current=''
  elif [[ $previous == = ]]; then previous=${COMP_WORDS[COMP_CWORD-2]}; fi
  for ((i = 1; i < COMP_CWORD; ++i)); do
    if [[ ${COMP_WORDS[i]} != -* ]]; then command=${COMP_WORDS[i]}; break; fi
  done
  case $command in
)";

constexpr const char* kEnd = R"(    *) return ;;
  esac
  [[ $kind == argument && $current == -* ]] && { kind=words; words=$options; }
  COMPREPLY=()
  case $kind in
    words) mapfile -t COMPREPLY < <(compgen -W "$words" -- "$current"); compopt +o default 2>/dev/null ;;
    folder) compopt +o default -o dirnames 2>/dev/null ;;
    nothing) compopt +o default 2>/dev/null ;;
  esac
}
complete -o default -F _sslam sslam
)";

}  // namespace

std::string bash_completion(const CLI::App& app) {
  const CommandInfo whole = describe_command(app);
  const std::vector<CommandInfo> commands = describe_subcommands(app);
  std::vector<std::string> names;
  for (const CommandInfo& command : commands) names.push_back(command.name);
  std::string text = kBegin;
  text += branch(whole, "''",
                 "      [[ $kind == argument && $current != -* ]] && { kind=words; words='" +
                     joined(names, " ") + "'; }\n");
  for (const CommandInfo& command : commands) text += branch(command, command.name, "");
  return text + kEnd;
}

}  // namespace sslam::cli
