// SPDX-License-Identifier: BSD-3-Clause
#include "cli/shell/messages.hpp"

#include <cstdio>
#include <nlohmann/json.hpp>

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
  std::fprintf(stderr, "sslam: %s: %s\n", kind, in_one_line(text).c_str());
}

}  // namespace

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

void print_json(const nlohmann::ordered_json& object) {
  // File names need not be UTF-8.
  const std::string line = object.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
  std::fprintf(stderr, "%s\n", line.c_str());
}

void print_warnings(std::span<const std::string> warnings, std::size_t at_most) {
  const std::size_t shown = warnings.size() <= at_most ? warnings.size() : at_most - 1;
  for (std::size_t i = 0; i < shown; ++i) print_warning(warnings[i]);
  if (shown < warnings.size())
    print_warning("and " + std::to_string(warnings.size() - shown) + " more like these");
}

}  // namespace sslam::cli
