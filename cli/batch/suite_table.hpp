// SPDX-License-Identifier: BSD-3-Clause
// A table of a suite file, read strictly: every complaint names file, line and key, and a key that nobody
// asked for is one.
#pragma once

#include "cli/shell/toml_parser.hpp"

#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sslam/core/closest_word.hpp"
#include "sslam/core/error.hpp"

namespace sslam::cli {

[[nodiscard]] inline std::string at_line(const std::string& file, std::int64_t line) {
  return file + ": line " + std::to_string(line) + ": ";
}

// As on a command line.
[[nodiscard]] inline std::string plain_number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.10g", value);
  return text;
}

class SuiteTable {
 public:
  // `what` is how the user wrote it, such as "[[sequence]]". The table must outlive this.
  SuiteTable(const toml::table& table, std::string file, std::string what)
      : table_(table), file_(std::move(file)), what_(std::move(what)) {}

  [[nodiscard]] const std::string& file() const noexcept { return file_; }
  [[nodiscard]] int line() const { return static_cast<int>(table_.source().begin.line); }
  [[nodiscard]] int line_of(std::string_view key) const {
    const toml::node* const node = table_.get(key);
    return node == nullptr ? line() : static_cast<int>(node->source().begin.line);
  }
  [[noreturn]] void fail(std::string_view key, const std::string& wrong) const {
    throw Error(at_line(file_, line_of(key)) + std::string(key) + " in " + what_ + ": " + wrong);
  }

  // What stands under a key; a null pointer where nothing does.
  [[nodiscard]] const toml::node* find(std::string_view key) {
    known_.emplace_back(key);
    return table_.get(key);
  }

  [[nodiscard]] std::optional<std::string> text(std::string_view key) {
    const toml::node* const node = find(key);
    if (node == nullptr) return std::nullopt;
    return text_of(key, *node);
  }
  [[nodiscard]] std::string required_text(std::string_view key, const std::string& meaning) {
    if (auto found = text(key)) return *found;
    throw Error(at_line(file_, line()) + what_ + " has no " + std::string(key) + ": expected " + meaning);
  }

  // A text, or a list of them.
  [[nodiscard]] std::vector<std::string> texts(std::string_view key) {
    std::vector<std::string> all;
    for_each(key, [&](const toml::node& node) { all.push_back(text_of(key, node)); });
    return all;
  }
  [[nodiscard]] std::vector<double> numbers(std::string_view key) {
    std::vector<double> all;
    for_each(key, [&](const toml::node& node) { all.push_back(number_of(key, node)); });
    return all;
  }

  // A value as on a command line, or a list of them.
  struct Word {
    std::string text;
    bool is_flag = false;  // true or false
  };
  [[nodiscard]] std::vector<Word> words(std::string_view key) {
    std::vector<Word> all;
    for_each(key, [&](const toml::node& node) { all.push_back(word_of(key, node)); });
    return all;
  }

  [[nodiscard]] std::vector<std::int64_t> whole_numbers(std::string_view key, std::int64_t least) {
    std::vector<std::int64_t> all;
    for_each(key, [&](const toml::node& node) { all.push_back(whole_of(key, node, least)); });
    return all;
  }

  [[nodiscard]] double number(std::string_view key, double otherwise, double least, double most) {
    const toml::node* const node = find(key);
    if (node == nullptr) return otherwise;
    const double value = number_of(key, *node);
    if (value < least || value > most) fail(key, "is out of range" + range_text(least, most));
    return value;
  }
  [[nodiscard]] std::int64_t whole_number(std::string_view key, std::int64_t otherwise, std::int64_t least) {
    const toml::node* const node = find(key);
    return node == nullptr ? otherwise : whole_of(key, *node, least);
  }
  [[nodiscard]] bool flag(std::string_view key, bool otherwise) {
    const toml::node* const node = find(key);
    if (node == nullptr) return otherwise;
    if (!node->is_boolean()) fail(key, "expected true or false");
    return node->value_or(otherwise);
  }

  // Call it when every key has been asked for.
  void refuse_others() const {
    for (const auto& [key, node] : table_) {
      const std::string found(key.str());
      if (std::find(known_.begin(), known_.end(), found) != known_.end()) continue;
      throw Error(at_line(file_, key.source().begin.line) + "'" + found + "' is not a key of " + what_ +
                  suggestion(found, known_));
    }
  }

 private:
  [[nodiscard]] static std::string range_text(double least, double most) {
    if (!std::isfinite(most)) return "; it must be at least " + short_number(least);
    return "; it goes from " + short_number(least) + " to " + short_number(most);
  }
  [[nodiscard]] static std::string short_number(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%g", value);
    return text;
  }

  template <class Take>
  void for_each(std::string_view key, Take take) {
    const toml::node* const node = find(key);
    if (node == nullptr) return;
    const toml::array* const list = node->as_array();
    if (list == nullptr) return take(*node);
    if (list->empty()) fail(key, "is an empty list; leave it out or name something");
    for (const toml::node& element : *list) take(element);
  }

  [[nodiscard]] std::string text_of(std::string_view key, const toml::node& node) const {
    const auto value = node.value_exact<std::string>();
    if (!value) fail(key, "expected text in quotes");
    if (value->empty()) fail(key, "is empty");
    return *value;
  }
  [[nodiscard]] Word word_of(std::string_view key, const toml::node& node) const {
    if (node.is_boolean()) return {node.value_or(false) ? "true" : "false", true};
    if (const auto whole = node.value_exact<std::int64_t>()) return {std::to_string(*whole)};
    if (node.is_floating_point()) return {plain_number(number_of(key, node))};
    if (!node.is_string()) fail(key, "expected text in quotes, a number, true or false");
    return {text_of(key, node)};
  }
  [[nodiscard]] double number_of(std::string_view key, const toml::node& node) const {
    const auto value = node.is_number() ? node.value<double>() : std::nullopt;
    if (!value || !std::isfinite(*value)) fail(key, "expected a number");
    return *value;
  }
  [[nodiscard]] std::int64_t whole_of(std::string_view key, const toml::node& node,
                                      std::int64_t least) const {
    const auto value = node.value_exact<std::int64_t>();
    if (!value || *value < least) fail(key, "expected a whole number from " + std::to_string(least) + " on");
    return *value;
  }

  const toml::table& table_;
  std::string file_;
  std::string what_;
  std::vector<std::string> known_;
};

}  // namespace sslam::cli
