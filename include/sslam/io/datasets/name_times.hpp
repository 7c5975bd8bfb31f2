// SPDX-License-Identifier: BSD-3-Clause
// A time of day without a date in the names of images: 12-30-15.250, cam_12h30m15s, 123015.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sslam/io/datasets/name_date.hpp"
#include "sslam/io/datasets/name_parts.hpp"

namespace sslam::io {

namespace name_times_detail {

inline constexpr std::int64_t kDay = 86400;

// All that may be times, from left to right. Every number has two digits, but an hour before AM or PM.
[[nodiscard]] inline std::vector<NameDate> times_in(std::string_view stem) {
  using name_date_detail::is_digit;
  std::vector<NameDate> times;
  for (std::size_t at = 0; at < stem.size(); ++at) {
    if (!is_digit(stem[at]) || (at > 0 && is_digit(stem[at - 1]))) continue;
    name_date_detail::Scanner scan(stem, at);
    const std::size_t digits = scan.digits(), minutes = at + digits + 1;
    std::optional<name_date_detail::Time> time = name_date_detail::take_time(scan);
    if (!time || is_digit(scan.peek())) continue;
    const auto pair_at = [&](std::size_t i) {
      return i + 1 < stem.size() && is_digit(stem[i]) && is_digit(stem[i + 1]);
    };
    if (digits <= 2 && (!pair_at(minutes) || !pair_at(minutes + 3))) continue;
    const std::size_t end = scan.at() - time->fraction.size();
    name_date_detail::take_half_day(scan, *time);
    const bool half_day = scan.at() > end + time->fraction.size();
    if ((digits == 1 && !half_day) || time->hour > 23 || time->minute > 59 || time->second > 59) continue;
    NameDate name;
    name.second = (time->hour * 60 + time->minute) * 60 + time->second;
    name.fraction = std::move(time->fraction);
    name.form = form_of(stem.substr(at, end - at));
    name.before = stem.substr(0, at);
    name.after = scan.rest();
    times.push_back(std::move(name));
  }
  return times;
}

// Six digits may be a counter. A clock leaves out 60 to 99, so that its numbers jump where a minute ends; a
// counter that leaves them out, too, goes in even steps, or is small.
[[nodiscard]] inline bool jump_as_a_clock(const std::vector<NameDate>& names) {
  const auto as_number = [](const NameDate& name) {
    return name.second / 3600 * 10000 + name.second / 60 % 60 * 100 + name.second % 60;
  };
  bool even = true, minutes = false, hours = false;
  for (std::size_t i = 0; i < names.size(); ++i) {
    hours = hours || names[i].second >= 3600;
    if (i == 0) continue;
    minutes = minutes || names[i].second / 60 != names[i - 1].second / 60;
    even = even && as_number(names[i]) - as_number(names[i - 1]) == as_number(names[1]) - as_number(names[0]);
  }
  return minutes && hours && !even;
}

// Of 02_12_30_15 the last number: a second, or a counter behind one? `names` are read as the latter. A
// counter goes on by one, or begins anew with each second, and then not just after 59.
[[nodiscard]] inline bool count_behind_seconds(const std::vector<NameDate>& names) {
  bool runs_on = true, restarts = true, after_59 = true;
  int last = 0;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::string& after = names[i].after;
    const std::size_t digits = std::min(after.find_first_not_of("0123456789", 1), after.size());
    const auto number = digits == 3 && after[0] != '.'
                            ? parse_number<int>(std::string_view(after).substr(1, 2))
                            : std::nullopt;
    if (!number || *number > 59) return true;
    if (i > 0) {
      const bool next = *number == last + 1, anew = names[i].second != names[i - 1].second;
      runs_on = runs_on && next;
      restarts = restarts && (anew ? *number <= 1 : next);
      after_59 = after_59 && (!anew || last == 59);
    }
    last = *number;
  }
  return runs_on || (restarts && !after_59);
}

// Dates with years of two digits, where all names have one. Behind such a number may be a counter: the times
// must have hours, or jump as those of a clock.
[[nodiscard]] inline std::vector<NameDate> short_dates_in(const std::vector<std::string>& stems) {
  std::vector<NameDate> names;
  bool hours = false;
  for (const std::string& stem : stems) {
    names.push_back(date_in_name(stem, true));
    if (names.back().kind != DateKind::kDateAndTime) return {};
    hours = hours || names.back().second % kDay >= 3600;
  }
  if (!hours && !jump_as_a_clock(names)) return {};
  return names;
}

template <class Part>
[[nodiscard]] bool differ(const std::vector<NameDate>& names, Part NameDate::*part) {
  return std::any_of(names.begin(), names.end(),
                     [&](const NameDate& name) { return name.*part != names.front().*part; });
}

}  // namespace name_times_detail

// With the seconds since midnight; empty: the names hold no times of day. `stems` in their order. Of several
// numbers in a name that may be times, the first counts that is not the same in all: that one is a date or
// the name of a recording.
[[nodiscard]] inline std::vector<NameDate> times_in_names(const std::vector<std::string>& stems) {
  using namespace name_times_detail;
  std::vector<NameDate> of_one_second;
  for (std::size_t which = 0; !stems.empty(); ++which) {
    std::vector<NameDate> names;
    for (const std::string& stem : stems) {
      std::vector<NameDate> times = times_in(stem);
      if (which >= times.size()) return of_one_second;
      names.push_back(std::move(times[which]));
    }
    take_parts(names);
    const bool digits_alone = names.front().form == "#";
    if (!digits_alone && differ(names, &NameDate::second) && !count_behind_seconds(names)) continue;
    if (differ(names, &NameDate::second) && (!digits_alone || jump_as_a_clock(names))) return names;
    if (differ(names, &NameDate::fraction) && !digits_alone && of_one_second.empty())
      of_one_second = std::move(names);
  }
  return {};
}

// From evening to morning a day has passed; names that begin with the time have the morning first. Whether
// there is such a place.
inline bool pass_midnight(std::vector<NameDate>& names) {
  using name_times_detail::kDay;
  for (std::size_t i = 1; i < names.size(); ++i) {
    const std::int64_t step = names[i].second - names[i - 1].second;
    if (std::abs(step) <= kDay / 2) continue;
    const std::size_t begin = step < 0 ? i : 0, end = step < 0 ? names.size() : i;
    for (std::size_t j = begin; j < end; ++j) names[j].second += kDay;
    return true;
  }
  return false;
}

}  // namespace sslam::io
