// SPDX-License-Identifier: BSD-3-Clause
#include "cli/shell/messages.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cstdio>
#include <map>
#include <nlohmann/json.hpp>

#include "cli/shell/json_text.hpp"

namespace sslam::cli {
namespace {

MessageForm message_form = MessageForm::kText;

// A name of a file may hold line breaks and what moves a terminal's cursor; a message is one line.
std::string in_one_line(const std::string& text) {
  std::string line;
  for (const char c : text) {
    const bool control = static_cast<unsigned char>(c) < 0x20 || c == 0x7f;
    line += control ? '?' : c;
  }
  return line;
}

void print_message(const char* kind, const std::string& text) {
  if (message_form == MessageForm::kJson) return print_json({{"event", kind}, {"text", text}});
  // On a terminal, a bar may stand in this line.
  static const bool terminal = isatty(fileno(message_stream())) != 0;
  std::fprintf(message_stream(), "%ssslam: %s: %s\n", terminal ? "\r\033[K" : "", kind,
               in_one_line(text).c_str());
}

// What is the same in warnings of one kind: frames and rows differ by their numbers.
std::string without_numbers(const std::string& text) {
  std::string kind;
  for (const char c : text) {
    const bool digit = c >= '0' && c <= '9';
    if (!digit)
      kind += c;
    else if (kind.empty() || kind.back() != '#')
      kind += '#';
  }
  return kind;
}

}  // namespace

std::FILE* message_stream() {
  static std::FILE* const stream = [] {
    const int copy = fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
    std::FILE* const opened = copy < 0 ? nullptr : fdopen(copy, "w");
    if (opened == nullptr) return stderr;
    std::setvbuf(opened, nullptr, _IONBF, 0);
    return opened;
  }();
  return stream;
}

void set_message_form(MessageForm form) {
  message_form = form;
}

void print_error(const std::string& text) {
  print_message("error", text);
}
void print_warning(const std::string& text) {
  print_message("warning", text);
}
void print_note(const std::string& text) {
  print_message("note", text);
}

void print_notes(std::span<const std::string> notes) {
  for (const std::string& note : notes) print_note(note);
}

void print_json(const nlohmann::ordered_json& object) {
  std::fprintf(message_stream(), "%s\n", json_text(object).c_str());
}

std::vector<WarningKind> kinds_of(std::span<const std::string> warnings) {
  std::vector<WarningKind> kinds;
  std::map<std::string, std::size_t> places;  // of what is the same in them
  for (const std::string& warning : warnings) {
    const auto [known, is_new] = places.emplace(without_numbers(warning), kinds.size());
    if (is_new)
      kinds.push_back({&warning, 1});
    else
      ++kinds[known->second].count;
  }
  return kinds;
}

void print_warnings(std::span<const std::string> warnings, std::size_t at_most) {
  const std::vector<WarningKind> kinds = kinds_of(warnings);
  const std::size_t shown = kinds.size() <= at_most ? kinds.size() : at_most - 1;
  for (std::size_t i = 0; i < shown; ++i) {
    const std::string more =
        kinds[i].count > 1 ? " (and " + std::to_string(kinds[i].count - 1) + " more like this)" : "";
    print_warning(*kinds[i].first + more);
  }
  if (shown < kinds.size())
    print_warning("and warnings of " + std::to_string(kinds.size() - shown) + " more kinds");
}

}  // namespace sslam::cli
