// SPDX-License-Identifier: BSD-3-Clause
// Reads YAML as programs write it for cameras, and JSON, which is a part of it: maps and lists by indentation
// or in brackets, quotes, comments, tags, anchors. OpenCV's reader takes less (no list below its key, no tab,
// no file without its heading), and says what is wrong in terms of its functions.
#pragma once

#include <algorithm>
#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

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
    if (!ended() && !at_mark()) fail(line_, "'" + rest_of_line() + "' is no 'key: value'" + blank_hint());
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
    std::vector<TextNode> merged;
    while (!ended() && column() == indent && !at_mark()) {
      const std::size_t end = key_end();
      if (end == std::string_view::npos)
        fail(line_, "'" + rest_of_line() + "' is no 'key: value'" + blank_hint());
      std::string key = unquoted(trimmed(text_.substr(at_, end - at_)));
      const int line = line_;
      at_ = end + 1;
      const std::string anchor = take_marks();
      TextNode item = node(TextNode::Kind::kEmpty);
      if (peek() == '|' || peek() == '>') {
        item = long_text(indent);
        skip_to_block();
      } else if (!at_line_end()) {
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
      if (!anchor.empty()) anchors_[anchor] = item;
      if (key == "<<" && item.kind == TextNode::Kind::kMap) {
        merged.push_back(std::move(item));
      } else {
        add(map, std::move(key), std::move(item), line);
      }
    }
    for (const TextNode& more : merged) merge(map, more);
    if (!ended() && column() > indent) fail(line_, "'" + rest_of_line() + "' is indented too far");
    return map;
  }

  TextNode block_list(int indent) {
    TextNode list = node(TextNode::Kind::kList);
    while (!ended() && column() == indent && at_item() && !at_mark()) {
      ++at_;
      const int line = line_;
      const std::string anchor = take_marks();
      if (at_line_end()) skip_to_block();
      const bool empty = ended() || (line != line_ && column() <= indent);
      list.items.push_back(empty ? node(TextNode::Kind::kEmpty) : block());
      if (!anchor.empty()) anchors_[anchor] = list.items.back();
      skip_to_block();
    }
    return list;
  }

  // Where the colon has no blank behind it.
  [[nodiscard]] std::string blank_hint() const {
    const std::string row = rest_of_line();
    const std::size_t colon = row.find(':');
    return colon + 1 < row.size() ? "; YAML needs a blank behind the colon" : "";
  }

  // Passes over tags (!!float) and an anchor (&name), which is the answer; empty: none.
  std::string take_marks() {
    std::string anchor;
    for (skip_blanks(); peek() == '!' || peek() == '&'; skip_blanks()) {
      const std::size_t start = at_;
      while (!is_blank(peek())) ++at_;
      if (text_[start] == '&') anchor = text_.substr(start + 1, at_ - start - 1);
    }
    return anchor;
  }

  // Lines that are indented further than the key before them, behind | or >. No calibration has numbers
  // there.
  TextNode long_text(int indent) {
    TextNode scalar = node(TextNode::Kind::kScalar);
    for (next_line(); !ended(); next_line()) {
      const std::size_t first = text_.find_first_not_of(" \t\r", at_);
      const bool blank = first == std::string_view::npos || text_[first] == '\n';
      if (!blank && static_cast<int>(first - at_) <= indent) break;
    }
    return scalar;
  }

  // What an anchor has named before. Copies of copies could fill the memory.
  TextNode named_before() {
    const std::string name = rest_of_line().substr(1);
    const auto found = anchors_.find(name.substr(0, name.find_first_of(" \t#")));
    if (found == anchors_.end()) fail(line_, "'*" + name + "' is named nowhere before");
    copied_ += size_of(found->second);
    constexpr std::size_t kMost = 100'000;
    if (copied_ > kMost) fail(line_, "'*" + name + "' repeats more than any calibration holds");
    at_ = std::min(text_.find('\n', at_), text_.size());
    return found->second;
  }

  static std::size_t size_of(const TextNode& tree) {
    std::size_t size = 1;
    for (const TextNode& item : tree.items) size += size_of(item);
    return size;
  }

  // Keys that the map has itself count.
  static void merge(TextNode& map, const TextNode& more) {
    for (std::size_t i = 0; i < more.keys.size(); ++i) {
      if (map.has(more.keys[i])) continue;
      map.keys.push_back(more.keys[i]);
      map.items.push_back(more.items[i]);
    }
  }

  // In brackets, in quotes, or plain up to the end of the line.
  TextNode value() {
    if (peek() == '[' || peek() == '{' || peek() == '"' || peek() == '\'') return flow();
    if (peek() == '*') return named_before();
    if (peek() == '|' || peek() == '>' || peek() == '&')
      fail(line_, "'" + rest_of_line() + "' is YAML that no calibration needs");
    TextNode scalar = node(TextNode::Kind::kScalar);
    std::size_t end = std::min(text_.find('\n', at_), text_.size());
    if (const std::size_t comment = text_.substr(0, end).find(" #", at_); comment != std::string_view::npos)
      end = comment;
    scalar.text = trimmed(text_.substr(at_, end - at_));
    at_ = end;
    return scalar;
  }

  std::map<std::string, TextNode> anchors_;
  std::size_t copied_ = 0;
};

}  // namespace sslam
