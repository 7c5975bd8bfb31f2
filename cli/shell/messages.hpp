// SPDX-License-Identifier: BSD-3-Clause
// One line a message on standard error, so that standard output stays a table or a result.
#pragma once

#include <cstddef>
#include <cstdio>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <vector>

namespace sslam::cli {

enum class MessageForm {
  kText,  // for people: sslam: warning: ...
  kJson,  // for programs: {"event":"warning","text":"..."}
};

// Where all messages go: standard error as it was at the first call. It stays when the libraries that decode
// images are cut off from there.
[[nodiscard]] std::FILE* message_stream();

// Of all messages from now on.
void set_message_form(MessageForm form);

void print_error(const std::string& text);
void print_warning(const std::string& text);
void print_note(const std::string& text);
void print_notes(std::span<const std::string> notes);
// A line of its own, whatever the form of messages.
void print_json(const nlohmann::ordered_json& object);

// Warnings that differ in their numbers alone, such as that of a frame.
struct WarningKind {
  const std::string* first;  // of the warnings that were given
  std::size_t count;
};

// In the order in which they came first.
[[nodiscard]] std::vector<WarningKind> kinds_of(std::span<const std::string> warnings);

// One line a kind, with a count: a thousand bad frames must not hide the line that matters. Warnings that
// differ in what stands before their last ": " alone, such as the file, are of one kind. At most so many
// kinds.
void print_warnings(std::span<const std::string> warnings, std::size_t at_most = 10);

}  // namespace sslam::cli
