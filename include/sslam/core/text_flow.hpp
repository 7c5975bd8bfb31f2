// SPDX-License-Identifier: BSD-3-Clause
// The part of YAML that is JSON: texts, quotes, lists in brackets and maps in braces; and a place in the
// text, with its line.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>

#include "sslam/core/error.hpp"
#include "sslam/core/text_node.hpp"

namespace sslam {

class TextFlow {
 protected:
  TextFlow(std::string_view text, const std::string& file) : text_(text), file_(file) {}

  [[noreturn]] void fail(int line, const std::string& what) const {
    throw Error(file_ + ": line " + std::to_string(line) + ": " + what);
  }
  [[nodiscard]] char peek(std::size_t ahead = 0) const {
    return at_ + ahead < text_.size() ? text_[at_ + ahead] : '\n';
  }
  [[nodiscard]] bool ended() const { return at_ >= text_.size(); }
  [[nodiscard]] int column() const { return static_cast<int>(at_ - line_start_); }
  [[nodiscard]] bool at_line_end() const { return peek() == '\n' || peek() == '#'; }
  [[nodiscard]] bool at_item() const { return peek() == '-' && is_blank(peek(1)); }
  static bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

  TextNode node(TextNode::Kind kind) const {
    TextNode made;
    made.kind = kind;
    made.line = line_;
    return made;
  }

  void skip_blanks() {
    while (!ended() && (peek() == ' ' || peek() == '\t' || peek() == '\r')) ++at_;
  }
  void next_line() {
    at_ = std::min(text_.find('\n', at_), text_.size() - 1) + 1;
    line_start_ = at_;
    ++line_;
  }
  // To the next thing that is neither blank nor comment.
  void skip_to_content() {
    for (skip_blanks(); !ended() && at_line_end(); skip_blanks()) next_line();
  }
  void skip_to_block() {
    skip_to_content();
    if (text_.substr(line_start_, at_ - line_start_).find('\t') != std::string_view::npos && !ended() &&
        peek() != '{')
      fail(line_, "is indented by a tab; YAML indents with blanks");
  }
  void demand_line_end() {
    skip_blanks();
    if (!at_line_end()) fail(line_, "expected the end of the line before '" + rest_of_line() + "'");
  }
  [[nodiscard]] std::string rest_of_line() const {
    std::string_view rest = text_.substr(at_, text_.find('\n', at_) - at_);
    return trimmed(rest.substr(0, 40));
  }
  static std::string trimmed(std::string_view text) {
    const auto from = text.find_first_not_of(" \t\r");
    if (from == std::string_view::npos) return {};
    return std::string(text.substr(from, text.find_last_not_of(" \t\r") - from + 1));
  }
  // A plain text within braces ends before the colon if it is a key.
  TextNode flow(bool key = false) {
    if (peek() == '[' || peek() == '{') return flow_items();
    TextNode scalar = node(TextNode::Kind::kScalar);
    if (peek() == '"' || peek() == '\'') {
      scalar.text = quoted();
      return scalar;
    }
    const std::size_t end = std::min(text_.find_first_of(key ? ",]}:\n#" : ",]}\n#", at_), text_.size());
    scalar.text = trimmed(text_.substr(at_, end - at_));
    at_ = end;
    return scalar;
  }

  TextNode flow_items() {
    if (++depth_ > kDeepest) fail(line_, "is nested too deep for a calibration");
    const bool map = peek() == '{';
    const char open = peek(), close = map ? '}' : ']';
    TextNode made = node(map ? TextNode::Kind::kMap : TextNode::Kind::kList);
    const auto unclosed = [&] {
      fail(made.line, std::string("the '") + open + "' that opens here is not closed");
    };
    ++at_;
    for (skip_to_content(); peek() != close; skip_to_content()) {
      if (ended()) unclosed();
      const std::size_t before = at_;
      const int line = line_;
      TextNode item = flow(map);
      skip_to_content();
      if (map) {
        if (peek() != ':' || item.kind != TextNode::Kind::kScalar)
          fail(line, "expected 'key: value' within the braces");
        ++at_;
        skip_to_content();
        if (ended()) unclosed();
        std::string key = std::move(item.text);
        add(made, std::move(key), flow(), line);
        skip_to_content();
      } else {
        made.items.push_back(std::move(item));
      }
      if (peek() == ',') {
        ++at_;
      } else if (peek() != close || at_ == before) {
        if (ended()) unclosed();
        fail(line_, std::string("expected ',' or '") + close + "' before '" + rest_of_line() + "'");
      }
    }
    ++at_;
    --depth_;
    return made;
  }

  std::string quoted() {
    const char mark = peek();
    const int line = line_;
    std::string content;
    for (++at_; peek() != mark; ++at_) {
      if (ended() || peek() == '\n') fail(line, "the quotes that open here are not closed");
      if (mark == '"' && peek() == '\\') ++at_;
      content += peek();
    }
    ++at_;
    return content;
  }

  static std::string unquoted(std::string text) {
    const bool marked = text.size() > 1 && (text[0] == '"' || text[0] == '\'') && text.back() == text[0];
    return marked ? text.substr(1, text.size() - 2) : text;
  }

  // One key, two values: which one counts, nobody knows.
  void add(TextNode& map, std::string key, TextNode item, int line) const {
    item.line = line;
    const TextNode* before = map.find(key);
    if (before != nullptr && (before->kind != item.kind || before->text != item.text))
      fail(line, key + " is given a second time, after line " + std::to_string(before->line));
    if (before != nullptr) return;
    map.keys.push_back(std::move(key));
    map.items.push_back(std::move(item));
  }

  static constexpr int kDeepest = 40;
  std::string_view text_;
  const std::string& file_;
  std::size_t at_ = 0, line_start_ = 0;
  int line_ = 1, depth_ = 0;
};

}  // namespace sslam
