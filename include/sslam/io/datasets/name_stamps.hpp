// SPDX-License-Identifier: BSD-3-Clause
// Stamps that are the names of images: seconds with a point (1341836537.655662), whole numbers of a finer
// unit (1341836537655662000), seconds and the rest (1341836537_655662000), or dates (20240501_123015). Other
// numbers are counters.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sslam/io/datasets/name_dates.hpp"
#include "sslam/io/files/files.hpp"
#include "sslam/io/files/stamp_unit.hpp"
#include "sslam/io/files/text.hpp"

namespace sslam::io {

struct NameStamps {
  std::vector<double> seconds;  // one for each name; empty: the names are no stamps
  std::string note;             // what is to be said about them; empty: nothing
};

namespace name_stamps_detail {

struct Numbers {
  std::vector<double> seconds;
  StampUnit unit;  // of the names
};

// 1998 to 2065.
[[nodiscard]] inline bool is_epoch(double seconds) noexcept {
  return seconds > 9e8 && seconds < 3e9;
}

struct SplitName {
  std::string whole, part;  // before and after the separator
  char separator = 0;       // 0: none
};

// Nothing for a name that is not digits, or digits on both sides of one separator.
[[nodiscard]] inline std::optional<SplitName> split_name(const std::string& stem) {
  const std::size_t at = stem.find_first_not_of("0123456789");
  SplitName name{stem.substr(0, at), {}, 0};
  if (at != std::string::npos) {
    name.separator = stem[at];
    name.part = stem.substr(at + 1);
    const bool known = std::string_view("._- ").find(name.separator) != std::string_view::npos;
    if (!known || !all_digits(name.part)) return std::nullopt;
  }
  if (name.whole.empty()) return std::nullopt;
  return name;
}

// Whole numbers. `since_1970`: of no other clock, and not of seconds: ids and counters have ten digits, too.
[[nodiscard]] inline std::optional<Numbers> stamps_of_numbers(std::vector<double> stamps, bool since_1970) {
  const StampUnit unit = stamp_unit_of(stamps, StampsOf::kOther);
  for (double& stamp : stamps) stamp /= unit.per_second;
  const double last = *std::max_element(stamps.begin(), stamps.end());
  constexpr double kLongestRun = 1e6;  // days, for a clock that begins with the recording
  const bool fine = !unit.is_seconds();
  const bool sensible = since_1970 ? fine && is_epoch(last) : is_epoch(last) || (fine && last < kLongestRun);
  return sensible ? std::optional(Numbers{std::move(stamps), unit}) : std::nullopt;
}

// Seconds and, as another number, what is left of them. Without leading zeros its unit is that of the
// longest.
[[nodiscard]] inline Numbers stamps_of_pairs(const std::vector<SplitName>& names) {
  std::size_t longest = 0;
  bool padded = true;
  for (const SplitName& name : names) {
    longest = std::max(longest, name.part.size());
    padded = padded && name.part.size() == names.front().part.size();
  }
  const std::size_t digits = padded ? longest : (longest > 6 ? 9 : (longest > 3 ? 6 : 3));
  Numbers result;
  for (const SplitName& name : names) {
    const std::string zeros(digits > name.part.size() ? digits - name.part.size() : 0, '0');
    result.seconds.push_back(parse_number<double>(name.whole + "." + zeros + name.part).value_or(0));
  }
  return result;
}

// Nothing where the names are no numbers of a clock.
[[nodiscard]] inline std::optional<Numbers> numbers_of_names(const std::vector<std::string>& stems,
                                                             bool since_1970) {
  std::vector<SplitName> names;
  for (const std::string& stem : stems) {
    auto name = split_name(stem);
    if (!name || (!names.empty() && name->separator != names.front().separator)) return std::nullopt;
    names.push_back(std::move(*name));
  }
  const char separator = names.front().separator;
  std::vector<double> wholes;
  for (const SplitName& name : names) {
    wholes.push_back(parse_number<double>(name.whole).value_or(0));
    // Two numbers that are no seconds of a clock may be anything, such as a run and a counter.
    if (separator != 0 && separator != '.' && !is_epoch(wholes.back())) return std::nullopt;
  }
  if (separator == 0) return stamps_of_numbers(std::move(wholes), since_1970);
  if (separator != '.') return stamps_of_pairs(names);
  Numbers result;
  for (const SplitName& name : names)
    result.seconds.push_back(parse_number<double>(name.whole + "." + name.part).value_or(0));
  result.unit = stamp_unit_of(result.seconds, StampsOf::kOther);
  for (double& stamp : result.seconds) stamp /= result.unit.per_second;
  if (since_1970 && !is_epoch(result.seconds.back())) return std::nullopt;
  return result;
}

// Takes what all names have in front of a number and behind the last one: of frame_1700000000033_left the
// number is left. `at`: where the number begins in the first. False where the names differ there.
[[nodiscard]] inline bool strip_names(std::vector<std::string>& stems, std::size_t at) {
  const std::string before = stems.front().substr(0, at);
  const std::string after = stems.front().substr(stems.front().find_last_of("0123456789") + 1);
  for (std::string& stem : stems) {
    if (stem.size() < before.size() + after.size() || !stem.starts_with(before) || !stem.ends_with(after))
      return false;
    stem = stem.substr(at, stem.size() - at - after.size());
  }
  return true;
}

// Stamps since 1970 with the same text before and behind them in all names.
[[nodiscard]] inline NameStamps stamps_within_names(const std::vector<std::string>& stems) {
  const std::string& first = stems.front();
  for (std::size_t at = 0; at < first.size(); ++at) {
    const auto digit = [&first](std::size_t i) { return all_digits({&first[i], 1}); };
    if (!digit(at) || (at > 0 && digit(at - 1))) continue;
    std::vector<std::string> numbers = stems;
    if (!strip_names(numbers, at)) break;
    if (auto found = numbers_of_names(numbers, true))
      return {std::move(found->seconds),
              "names hold stamps, such as " + numbers.front() + " of " + first +
                  (found->unit.is_seconds() ? ": seconds since 1970" : ": " + unit_note(found->unit))};
  }
  return {};
}

}  // namespace name_stamps_detail

// `images` in the order of their names.
[[nodiscard]] inline NameStamps stamps_of_names(const std::vector<std::filesystem::path>& images) {
  NameDates dates = dates_of_names(images);
  if (!dates.seconds.empty()) return {std::move(dates.seconds), std::move(dates.note)};
  if (images.empty()) return {};
  std::vector<std::string> stems;
  for (const std::filesystem::path& image : images) stems.push_back(image.stem().string());
  if (auto numbers = name_stamps_detail::numbers_of_names(stems, false))
    return {std::move(numbers->seconds),
            numbers->unit.is_seconds() ? std::string() : "names are " + unit_note(numbers->unit)};
  if (NameStamps within = name_stamps_detail::stamps_within_names(stems); !within.seconds.empty())
    return within;
  return {{}, std::move(dates.note)};
}

}  // namespace sslam::io
