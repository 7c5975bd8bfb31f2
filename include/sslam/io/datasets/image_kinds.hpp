// SPDX-License-Identifier: BSD-3-Clause
// Images of several kinds side by side in one folder, such as left_1.png and right_1.png: nobody knows which
// are meant.
#pragma once

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <filesystem>
#include <iterator>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "sslam/io/datasets/name_date.hpp"
#include "sslam/io/files/text.hpp"

namespace sslam::io {

namespace image_kinds_detail {

struct Kind {
  std::set<std::string> numbers;   // in the names
  std::set<std::string> patterns;  // the names, each digit as `?`

  [[nodiscard]] std::string glob(std::string form) const {
    std::replace(form.begin(), form.end(), '#', '*');
    return "'" + (patterns.size() == 1 ? *patterns.begin() : form) + "' (" + std::to_string(numbers.size()) +
           ")";
  }
};

// By the form of the names, their numbers as `#`. A single digit within a word, as in cam0_0001, is part of
// it.
[[nodiscard]] inline std::map<std::string, Kind> kinds_of(const std::vector<std::filesystem::path>& images) {
  using name_date_detail::is_digit;
  std::map<std::string, Kind> kinds;
  for (const std::filesystem::path& image : images) {
    const std::string name = image.filename().string();
    std::string form, pattern, numbers;
    for (std::size_t i = 0; i < name.size();) {
      std::size_t end = i;
      while (end < name.size() && is_digit(name[end])) ++end;
      const bool after_letter = i > 0 && std::isalpha(static_cast<unsigned char>(name[i - 1])) != 0;
      const bool part = end == i + 1 && after_letter && end < name.size() && name[end] != '.';
      if (end == i || part) {
        form += name[i];
        pattern += name[i++];
      } else {
        form += '#';
        pattern.append(end - i, '?');
        numbers += name.substr(i, end - i) + ' ';
        i = end;
      }
    }
    kinds[form].numbers.insert(std::move(numbers));
    kinds[form].patterns.insert(std::move(pattern));
  }
  return kinds;
}

// Counted alike: most numbers of each are also the other's.
[[nodiscard]] inline bool go_together(const Kind& a, const Kind& b) {
  std::vector<std::string> shared;
  std::set_intersection(a.numbers.begin(), a.numbers.end(), b.numbers.begin(), b.numbers.end(),
                        std::back_inserter(shared));
  return shared.size() >= 2 && 2 * shared.size() > std::max(a.numbers.size(), b.numbers.size());
}

}  // namespace image_kinds_detail

// Globs of the kinds that go together, for people; empty: the images are of one kind.
[[nodiscard]] inline std::string image_kinds(const std::vector<std::filesystem::path>& images) {
  using namespace image_kinds_detail;
  std::map<std::string, Kind> kinds = kinds_of(images);
  std::erase_if(kinds, [](const auto& kind) { return kind.second.numbers.size() < 2; });
  constexpr std::size_t kMost = 16;  // of names without any system there are more
  std::set<std::string> globs;
  for (auto a = kinds.begin(); a != kinds.end() && kinds.size() <= kMost; ++a)
    for (auto b = std::next(a); b != kinds.end(); ++b)
      if (go_together(a->second, b->second)) {
        globs.insert(a->second.glob(a->first));
        globs.insert(b->second.glob(b->first));
      }
  std::string list;
  for (const std::string& glob : globs) add_to_list(list, glob);
  return list;
}

}  // namespace sslam::io
