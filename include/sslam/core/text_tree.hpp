// SPDX-License-Identifier: BSD-3-Clause
// Reads YAML as programs write it for cameras, and JSON, which is a part of it: maps and lists by indentation
// or in brackets, quotes, comments, tags. OpenCV's reader takes less (no list below its key, no tab, no file
// without its heading), and says what is wrong in terms of its functions.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>

#include "sslam/core/text_flow.hpp"

namespace sslam {

class TextTree : private TextFlow {
 public:
  // The first document of `text`. Throws Error in one line: file, line, what is wrong.
  [[nodiscard]] static TextNode parse(std::string_view text, const std::string& file) {
    TextTree tree(text, file);
    return tree.document();
  }

 private:
  TextTree(std::string_view text, const std::string& file) : TextFlow(text, file) {}

  // The marks that end a document.
  [[nodiscard]] bool at_mark() const {
    return column() == 0 && (text_.substr(at_, 3) == "---" || text_.substr(at_, 3) == "...");
  }

  TextNode document() {
    skip_to_block();
    while (!ended() && peek() == '%') {
      next_line();
      skip_to_block();
    }
    if (!ended() && at_mark()) at_ += 3;
    skip_to_block();
    if (ended()) throw Error(file_ + ": is empty; expected a calibration");
    TextNode root = block();
    skip_to_block();
    if (!ended() && !at_mark()) fail(line_, "'" + rest_of_line() + "' is no 'key: value'");
    return root;
  }

  // Where the key ends that starts here: the colon; npos: none starts here.
  [[nodiscard]] std::size_t key_end() const {
    const char first = peek();
    if (first == '[' || first == '{') return std::string_view::npos;
    std::size_t i = at_;
    if (first == '"' || first == '\'') {
      i = text_.find(first, at_ + 1);
      if (i == std::string_view::npos) return i;
      i = text_.find_first_not_of(" \t", i + 1);
      return i != std::string_view::npos && text_[i] == ':' ? i : std::string_view::npos;
    }
    for (; i < text_.size() && text_[i] != '\n'; ++i)
      if (text_[i] == ':' && (i + 1 == text_.size() || is_blank(text_[i + 1]))) return i;
    return std::string_view::npos;
  }

  TextNode block() {
    if (++depth_ > kDeepest) fail(line_, "is nested too deep for a calibration");
    TextNode made = at_item()                             ? block_list(column())
                    : key_end() != std::string_view::npos ? block_map(column())
                                                          : value();
    --depth_;
    return made;
  }

  TextNode block_map(int indent) {
    TextNode map = node(TextNode::Kind::kMap);
    while (!ended() && column() == indent && !at_mark()) {
      const std::size_t end = key_end();
      if (end == std::string_view::npos) fail(line_, "'" + rest_of_line() + "' is no 'key: value'");
      std::string key = unquoted(trimmed(text_.substr(at_, end - at_)));
      const int line = line_;
      at_ = end + 1;
      skip_tag();
      TextNode item = node(TextNode::Kind::kEmpty);
      if (!at_line_end()) {
        item = value();
        demand_line_end();
        skip_to_block();
      } else {
        skip_to_block();
        if (!ended() && column() > indent) {
          item = block();
          skip_to_block();
        } else if (!ended() && column() == indent && at_item()) {
          item = block_list(indent);
        }
      }
      add(map, std::move(key), std::move(item), line);
    }
    if (!ended() && column() > indent) fail(line_, "'" + rest_of_line() + "' is indented too far");
    return map;
  }

  TextNode block_list(int indent) {
    TextNode list = node(TextNode::Kind::kList);
    while (!ended() && column() == indent && at_item() && !at_mark()) {
      ++at_;
      const int line = line_;
      skip_blanks();
      if (at_line_end()) skip_to_block();
      const bool empty = ended() || (line != line_ && column() <= indent);
      list.items.push_back(empty ? node(TextNode::Kind::kEmpty) : block());
      skip_to_block();
    }
    return list;
  }

  void skip_tag() {
    skip_blanks();
    if (peek() != '!') return;
    while (!is_blank(peek())) ++at_;
    skip_blanks();
  }

  // In brackets, in quotes, or plain up to the end of the line.
  TextNode value() {
    if (peek() == '[' || peek() == '{' || peek() == '"' || peek() == '\'') return flow();
    if (std::string_view("|>&*").find(peek()) != std::string_view::npos)
      fail(line_, "'" + rest_of_line() + "' is YAML that no calibration needs");
    TextNode scalar = node(TextNode::Kind::kScalar);
    std::size_t end = std::min(text_.find('\n', at_), text_.size());
    if (const std::size_t comment = text_.substr(0, end).find(" #", at_); comment != std::string_view::npos)
      end = comment;
    scalar.text = trimmed(text_.substr(at_, end - at_));
    at_ = end;
    return scalar;
  }
};

}  // namespace sslam
