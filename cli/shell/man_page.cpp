// SPDX-License-Identifier: BSD-3-Clause
#include "cli/shell/man_page.hpp"

#include <CLI/CLI.hpp>

#include "cli/shell/option_info.hpp"
#include "sslam/io/files/text.hpp"
#include "sslam/version.hpp"

namespace sslam::cli {
namespace {

// Text as troff takes it: no character is a command, and a line break stays one.
std::string plain(const std::string& text) {
  std::string safe;
  for (const char c : text) {
    if (safe.empty() || safe.back() == '\n') safe += "\\&";
    if (c == '\\')
      safe += "\\e";
    else if (c == '-')
      safe += "\\-";
    else if (c == '\n')
      safe += "\n.br\n";
    else
      safe += c;
  }
  return safe;
}

std::string bold(const std::string& text) {
  return "\\fB" + plain(text) + "\\fR";
}

std::string italic(const std::string& text) {
  return "\\fI" + plain(text) + "\\fR";
}

std::string heading(const OptionInfo& option) {
  if (option.flags.empty()) return italic(option.name);
  std::string text;
  for (const std::string& flag : option.flags) io::add_to_list(text, bold(flag));
  if (option.kind != ValueKind::kNone) text += " " + italic(option.value);
  return text + (option.repeated ? " ..." : "");
}

std::string entry(const OptionInfo& option) {
  std::string text = ".TP\n" + heading(option) + "\n" + plain(option.meaning);
  if (!option.words.empty()) {
    std::string words;
    for (const std::string& word : option.words) io::add_to_list(words, bold(word));
    text += "\n.br\nOne of " + words + ".";
  }
  if (!option.default_value.empty()) text += "\n.br\nDefault: " + plain(option.default_value) + ".";
  return text + "\n";
}

std::string usage(const CommandInfo& command) {
  std::string text = ".B sslam " + plain(command.name) + "\n[" + italic("OPTIONS") + "]";
  for (const OptionInfo& argument : command.positionals)
    text += argument.required ? " " + italic(argument.name) : " [" + italic(argument.name) + "]";
  return text + "\n";
}

std::string section(const CommandInfo& command) {
  std::string text =
      ".SS " + plain(command.name) + "\n" + plain(command.meaning) + ".\n.PP\n" + usage(command);
  for (const OptionInfo& argument : command.positionals) text += entry(argument);
  for (const OptionInfo& option : command.options) text += entry(option);
  return text;
}

// Of "Exit codes: 0 this; 1 that." at the footer's end.
std::string exit_status(std::string footer) {
  footer.erase(0, footer.find(':', footer.find("Exit codes")) + 1);
  if (footer.ends_with('.')) footer.pop_back();
  std::string text;
  for (std::string code : CLI::detail::split(footer, ';')) {
    CLI::detail::trim(code);
    const auto space = code.find(' ');
    text += ".TP\n" + bold(code.substr(0, space)) + "\n" + plain(code.substr(space + 1)) + "\n";
  }
  return text;
}

}  // namespace

std::string man_page(const CLI::App& app) {
  const CommandInfo whole = describe_command(app);
  std::string text = ".TH SSLAM 1 \"\" \"sslam " SSLAM_VERSION "\" \"User Commands\"\n.SH NAME\nsslam \\- " +
                     plain(whole.meaning) + "\n.SH SYNOPSIS\n.B sslam\n" + italic("COMMAND") + " [" +
                     italic("OPTIONS") + "] " + italic("ARGUMENTS") + "\n.SH OPTIONS\n";
  for (const OptionInfo& option : whole.options) text += entry(option);
  text += ".SH COMMANDS\n";
  for (const CommandInfo& command : describe_subcommands(app)) text += section(command);
  return text + ".SH EXIT STATUS\n" + exit_status(app.get_footer());
}

}  // namespace sslam::cli
