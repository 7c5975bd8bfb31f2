// SPDX-License-Identifier: BSD-3-Clause
// Stamps from the dates or the times of day in the names of images, where all names hold one, in one form.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <numeric>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sslam/io/datasets/name_date.hpp"
#include "sslam/io/datasets/name_parts.hpp"
#include "sslam/io/datasets/name_times.hpp"
#include "sslam/io/files/files.hpp"
#include "sslam/io/files/text.hpp"

namespace sslam::io {

struct NameDates {
  std::vector<double> seconds;  // since 1970 or midnight, one for each name; empty: they are no stamps
  std::string note;             // how they are read, or why they are not; empty: names hold no dates
};

namespace name_dates_detail {

struct Zone {
  std::int64_t seconds = 0;    // east of Greenwich
  std::size_t length = 0;      // of its text
  bool may_be_number = false;  // -0500 could be a counter
};

// Z, +02, +0200, +02:00; with a minus sign only behind a T, and with minutes.
[[nodiscard]] inline std::optional<Zone> zone_of(const NameDate& name) {
  const std::string_view text = name.after;
  if (text.starts_with('Z') || text.starts_with('z')) return Zone{0, 1, false};
  const bool west = text.starts_with('-');
  if (!west && !text.starts_with('+')) return std::nullopt;
  if (west && name.form.find_first_of("Tt") == std::string::npos) return std::nullopt;
  const auto two = [&](std::size_t at) {
    const std::string_view digits = text.substr(std::min(at, text.size()), 2);
    return digits.size() == 2 && all_digits(digits) ? parse_number<int>(digits) : std::nullopt;
  };
  const auto hours = two(1);
  const bool colon = text.size() > 3 && text[3] == ':';
  const auto minutes = two(colon ? 4 : 3);
  const std::size_t length = minutes ? (colon ? 6 : 5) : 3;
  const bool ends = text.size() <= length || !name_date_detail::is_digit(text[length]);
  if (!hours || *hours > 14 || minutes.value_or(0) % 15 != 0 || minutes.value_or(0) > 45 || !ends ||
      (west && !minutes))
    return std::nullopt;
  const std::int64_t east = (*hours * 60 + minutes.value_or(0)) * 60;
  return Zone{west ? -east : east, length, west && !colon};
}

enum class Zones { kNone, kAll, kSome };

[[nodiscard]] inline Zones take_zones(std::vector<NameDate>& names) {
  std::vector<std::optional<Zone>> zones;
  for (const NameDate& name : names) zones.push_back(zone_of(name));
  const auto is_sure = [](const std::optional<Zone>& zone) { return zone && !zone->may_be_number; };
  if (!std::all_of(zones.begin(), zones.end(), [](const auto& zone) { return zone.has_value(); }))
    return std::any_of(zones.begin(), zones.end(), is_sure) ? Zones::kSome : Zones::kNone;
  for (std::size_t i = 0; i < names.size(); ++i) {
    names[i].second -= zones[i]->seconds;
    names[i].after.erase(0, zones[i]->length);
  }
  return Zones::kAll;
}

// Names of one second.
struct OneSecond {
  std::int64_t second = 0;
  std::size_t first = 0, count = 0;  // places in the order by time
};

[[nodiscard]] inline std::vector<OneSecond> seconds_of(const std::vector<NameDate>& names,
                                                       const std::vector<std::size_t>& order) {
  std::vector<OneSecond> groups;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const std::int64_t second = names[order[i]].second;
    if (groups.empty() || groups.back().second != second) groups.push_back({second, i, 0});
    ++groups.back().count;
  }
  return groups;
}

// The time in the names of a video's frames may be that of the video.
[[nodiscard]] inline bool are_of_recording(const std::vector<OneSecond>& groups) {
  constexpr std::size_t kMostASecond = 250;  // that a camera takes
  return groups.size() == 1 || std::any_of(groups.begin(), groups.end(),
                                           [](const OneSecond& group) { return group.count > kMostASecond; });
}

// Images of one second are spread evenly over it. The first second of a recording and its last are not
// whole: there the step is that of the neighbour. `order`: the names by their time.
[[nodiscard]] inline std::vector<double> spread_seconds(const std::vector<OneSecond>& groups,
                                                        const std::vector<std::size_t>& order) {
  const auto count_at = [&](std::size_t group, std::int64_t second) {
    return groups[group].second == second ? groups[group].count : std::size_t{0};
  };
  std::vector<double> seconds(order.size());
  for (std::size_t g = 0; g < groups.size(); ++g) {
    const OneSecond& group = groups[g];
    std::size_t places = group.count;
    if (g == 0 && groups.size() > 1) places = std::max(places, count_at(1, group.second + 1));
    const std::size_t skipped = g == 0 ? places - group.count : 0;
    if (g > 0 && g + 1 == groups.size()) places = std::max(places, count_at(g - 1, group.second - 1));
    for (std::size_t i = 0; i < group.count; ++i)
      seconds[order[group.first + i]] =
          static_cast<double>(group.second) + static_cast<double>(skipped + i) / static_cast<double>(places);
  }
  return seconds;
}

// Why names that hold dates or times are no stamps; empty where they may be.
[[nodiscard]] inline std::string objection(const std::vector<NameDate>& names,
                                           const std::vector<std::string>& stems, Zones zones) {
  if (zones == Zones::kSome) return "some have a time zone and others have none";
  const NameDate& first = names.front();
  const std::string before = form_of(first.before);
  std::string after;  // some names may have nothing there
  bool same = true;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::string own = form_of(names[i].after);
    if (after.empty()) after = own;
    if (names[i].form != first.form || form_of(names[i].before) != before || (!own.empty() && own != after))
      return "they have more than one form, such as " + stems.front() + " and " + stems[i];
    same = same && names[i].before == first.before;
    if (!same && i > 0 && names[i].second < names[i - 1].second)
      return "they go back in time from " + stems[i - 1] + " to " + stems[i];
  }
  return {};
}

}  // namespace name_dates_detail

// `images` in the order of their names.
[[nodiscard]] inline NameDates dates_of_names(const std::vector<std::filesystem::path>& images) {
  using namespace name_dates_detail;
  std::vector<NameDate> names;
  std::vector<std::string> stems;
  bool any = false, all_dates = !images.empty();
  for (const std::filesystem::path& image : images) {
    stems.push_back(image.stem().string());
    names.push_back(date_in_name(stems.back()));
    any = any || names.back().kind >= DateKind::kImpossible;
    all_dates = all_dates && names.back().kind >= DateKind::kDateAlone;
  }
  bool dated = any || all_dates;  // eight digits in some names need not be a date
  if (!dated) names = times_in_names(stems);
  if (names.empty()) {
    names = name_times_detail::short_dates_in(stems);
    dated = !names.empty();
  }
  if (names.empty()) return {};
  const auto refuse = [dated](const std::string& why) {
    return NameDates{{}, std::string("names hold ") + (dated ? "dates" : "times") + ", but " + why};
  };
  for (std::size_t i = 0; dated && i < names.size(); ++i) {
    if (names[i].kind == DateKind::kImpossible) return refuse("there is no such time as in " + stems[i]);
    if (names[i].kind == DateKind::kDateAlone) return refuse("no time to the second, such as " + stems[i]);
    if (names[i].kind == DateKind::kNone) return refuse("not all of them, such as " + stems[i]);
  }
  if (dated) take_parts(names);
  const Zones zones = dated ? take_zones(names) : Zones::kNone;
  const bool midnight = !dated && pass_midnight(names);
  if (const std::string why = objection(names, stems, zones); !why.empty()) return refuse(why);

  const bool fine =
      std::any_of(names.begin(), names.end(), [](const auto& n) { return !n.fraction.empty(); });
  NameDates dates;
  for (const NameDate& name : names)
    dates.seconds.push_back(parse_number<double>(std::to_string(name.second) + "." +
                                                 (name.fraction.empty() ? "0" : name.fraction))
                                .value_or(0));
  std::vector<std::size_t> order(names.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    if (dates.seconds[a] != dates.seconds[b]) return dates.seconds[a] < dates.seconds[b];
    return natural_less(names[a].after, names[b].after);
  });
  bool several = false;
  for (std::size_t i = 1; i < order.size(); ++i) {
    const std::size_t a = order[i - 1], b = order[i];
    if (dates.seconds[a] != dates.seconds[b]) continue;
    several = true;
    if (fine || names[a].after == names[b].after)
      return refuse("some are of the same time, such as " + images[a].filename().string() + " and " +
                    images[b].filename().string());
  }
  if (several) {
    const std::vector<OneSecond> groups = seconds_of(names, order);
    if (are_of_recording(groups))
      return refuse("too many are of one second, such as " + stems[order[groups.back().first]]);
    dates.seconds = spread_seconds(groups, order);
  }
  dates.note =
      dated ? "names are dates and times, such as " + stems.front() + ": stamps are seconds since 1970"
            : "names are times of day, such as " + stems.front() + ": stamps are seconds since midnight";
  if (dated && zones == Zones::kNone) dates.note += ", as if in UTC";
  if (midnight) dates.note += "; those of the morning are of the next day";
  if (several) dates.note += "; images of one second are spread evenly over it";
  return dates;
}

}  // namespace sslam::io
