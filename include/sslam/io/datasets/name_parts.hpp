// SPDX-License-Identifier: BSD-3-Clause
// Parts of a second behind the times in the names of images.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "sslam/io/datasets/name_date.hpp"
#include "sslam/io/files/text.hpp"

namespace sslam::io {

namespace name_parts_detail {

// Digits behind a point or a comma.
inline void take_decimals(NameDate& name) {
  const std::string& after = name.after;
  if (!name.fraction.empty() || after.size() < 2 || (after[0] != '.' && after[0] != ',')) return;
  const std::size_t end = std::min(after.find_first_not_of("0123456789", 1), after.size());
  name.fraction = after.substr(1, end - 1);
  if (!name.fraction.empty()) name.after.erase(0, end);
}

// 3, 6 or 9 digits behind another mark than a point are part of a second where all names have as many. Where
// each is one more than the one before, they count the images.
inline void take_marked_decimals(std::vector<NameDate>& names) {
  const std::string& first = names.front().after;
  const auto digits = [](const std::string& after) {
    return after.empty() ? 0 : std::min(after.find_first_not_of("0123456789", 1), after.size()) - 1;
  };
  const std::size_t count = digits(first);
  if ((count != 3 && count != 6 && count != 9) ||
      std::string_view("_-:").find(first[0]) == std::string_view::npos)
    return;
  bool counts = true;
  std::int64_t last = -1;
  for (const NameDate& name : names) {
    if (!name.fraction.empty() || name.after.empty() || name.after[0] != first[0] ||
        digits(name.after) != count)
      return;
    const auto part = parse_number<std::int64_t>(name.after.substr(1, count)).value_or(0);
    counts = counts && (part == last + 1 || part <= 1 || last < 0);
    last = part;
  }
  if (counts) return;
  for (NameDate& name : names) {
    name.fraction = name.after.substr(1, count);
    name.after.erase(0, count + 1);
  }
}

}  // namespace name_parts_detail

// Moves them from what stands behind the seconds. At least one name.
inline void take_parts(std::vector<NameDate>& names) {
  for (NameDate& name : names) name_parts_detail::take_decimals(name);
  name_parts_detail::take_marked_decimals(names);
}

}  // namespace sslam::io
