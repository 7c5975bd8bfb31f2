// SPDX-License-Identifier: BSD-3-Clause
// What a YAML or JSON text holds, each part with the line that it stands in.
#pragma once

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sslam {

struct TextNode {
  enum class Kind { kEmpty, kScalar, kMap, kList };

  Kind kind = Kind::kEmpty;
  int line = 0;                   // counted from 1; 0: not known
  std::string text;               // of a scalar
  std::vector<std::string> keys;  // of a map, in the order of the file
  std::vector<TextNode> items;    // of a map, one a key, or of a list

  // Null where the map has no such key.
  [[nodiscard]] const TextNode* find(std::string_view key) const {
    const auto at = std::find(keys.begin(), keys.end(), key);
    return at == keys.end() ? nullptr : &items[static_cast<std::size_t>(at - keys.begin())];
  }
  // The first of several names for one thing.
  [[nodiscard]] const TextNode* find_any(const std::vector<std::string_view>& names) const {
    for (const std::string_view name : names)
      if (const TextNode* node = find(name)) return node;
    return nullptr;
  }
  [[nodiscard]] bool has(std::string_view key) const { return find(key) != nullptr; }
};

// The number that the whole text spells, also .nan and .inf as YAML writes them; nothing where it is none.
[[nodiscard]] inline std::optional<double> number_of(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  std::string plain(text);
  for (const std::string_view special : {".nan", ".NaN", ".inf", ".Inf", ".NAN", ".INF"})
    if (const auto at = plain.find(special); at != std::string::npos) plain.erase(at, 1);
  double value = 0;
  const auto [end, error] = std::from_chars(plain.data(), plain.data() + plain.size(), value);
  if (error != std::errc{} || end != plain.data() + plain.size()) return std::nullopt;
  return value;
}

}  // namespace sslam
