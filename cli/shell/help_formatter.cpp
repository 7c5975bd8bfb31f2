// SPDX-License-Identifier: BSD-3-Clause
#include "cli/shell/help_formatter.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <utility>

#include "cli/shell/option_info.hpp"
#include "sslam/io/files/text.hpp"

namespace sslam::cli {
namespace {

constexpr std::size_t kSecondColumn = 26;

// Of the terminal, else as COLUMNS says, else 80; lines that are too long are hard to read.
std::size_t help_width() {
  constexpr std::size_t kLeast = 50, kMost = 110, kUsual = 80;
  winsize size{};
  std::size_t columns = 0;
  if (ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0) columns = size.ws_col;
  if (const char* const wanted = std::getenv("COLUMNS"); columns == 0 && wanted != nullptr)
    columns = io::parse_number<std::size_t>(wanted).value_or(0);
  return columns == 0 ? kUsual : std::clamp(columns, kLeast, kMost);
}

}  // namespace

std::string wrapped(std::string_view text, std::size_t width, std::size_t indent) {
  std::string result;
  std::size_t column = indent;
  const auto new_line = [&] {
    result += '\n' + std::string(indent, ' ');
    column = indent;
  };
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t end = std::min(text.find_first_of(" \n", at), text.size());
    const std::size_t length = end - at;
    const bool begins = column == indent;
    if (!begins && column + 1 + length > width) {
      new_line();
    } else if (!begins && length > 0) {
      result += ' ';
      ++column;
    }
    result += text.substr(at, length);
    column += length;
    if (length == 0 && column == indent && end < text.size() && text[end] == ' ') {  // its own indentation
      result += ' ';
      ++column;
    }
    if (end < text.size() && text[end] == '\n') new_line();
    at = end + 1;
  }
  return result;
}

HelpFormatter::HelpFormatter() : width_(help_width()) {}

std::string HelpFormatter::two_columns(const std::string& left, const std::string& text) const {
  std::string line = "  " + left;
  if (line.size() + 2 > kSecondColumn && !text.empty())
    line += '\n' + std::string(kSecondColumn, ' ');
  else
    line.resize(std::max(line.size(), kSecondColumn), ' ');
  return line + wrapped(text, width_, kSecondColumn) + '\n';
}

std::string HelpFormatter::make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const {
  return CLI::detail::find_and_replace(CLI::Formatter::make_help(app, std::move(name), mode), "\n\n\n",
                                       "\n\n");
}

// What is checked of a value, messages tell.
std::string HelpFormatter::make_option_opts(const CLI::Option* option) const {
  const OptionInfo info = describe_option(*option);
  if (info.kind == ValueKind::kNone) return {};
  std::string text = " " + (info.words.empty() ? info.value : "{" + CLI::detail::join(info.words, ",") + "}");
  if (!info.default_value.empty()) text += "=" + info.default_value;
  if (info.repeated) text += " ...";
  return text + (info.required ? " REQUIRED" : "");
}

std::string HelpFormatter::make_option(const CLI::Option* option, bool is_positional) const {
  return two_columns(make_option_name(option, is_positional) + make_option_opts(option),
                     make_option_desc(option));
}

std::string HelpFormatter::make_subcommand(const CLI::App* command) const {
  return two_columns(command->get_display_name(true), command->get_description());
}

std::string HelpFormatter::make_description(const CLI::App* app) const {
  return wrapped(app->get_description(), width_, 0) + '\n';
}

std::string HelpFormatter::make_footer(const CLI::App* app) const {
  return wrapped(app->get_footer(), width_, 0) + '\n';
}

void put_in_group(CLI::App& command, const std::string& heading, std::initializer_list<const char*> options) {
  for (const char* name : options) command.get_option(name)->group(heading);
}

}  // namespace sslam::cli
