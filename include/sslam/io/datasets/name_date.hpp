// SPDX-License-Identifier: BSD-3-Clause
// A date and a time of day in the name of an image: 2024-05-01_12-30-15.123, IMG_20240501_123015,
// 20240501T123015Z, "Screenshot 2024-05-01 at 12.30.15".
#pragma once

#include <algorithm>
#include <cctype>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace sslam::io {

enum class DateKind : std::uint8_t {
  kNone,
  kDateAlone,   // without a time to the second
  kImpossible,  // in the form of a date and a time, but there is no such one
  kDateAndTime,
};

struct NameDate {
  DateKind kind = DateKind::kNone;
  std::int64_t second = 0;  // since 1970, as if the date were in UTC
  std::string fraction;     // digits that run on from the seconds
  std::string form;         // what stands between the numbers, each number as #
  std::string before;       // the name up to the date
  std::string after;        // and from the seconds on
};

namespace name_date_detail {

[[nodiscard]] inline bool is_digit(char c) noexcept {
  return c >= '0' && c <= '9';
}

}  // namespace name_date_detail

// Each run of digits as #.
[[nodiscard]] inline std::string form_of(std::string_view text) {
  std::string form;
  for (const char c : text) {
    const bool digit = name_date_detail::is_digit(c);
    if (!digit || form.empty() || form.back() != '#') form += digit ? '#' : c;
  }
  return form;
}

namespace name_date_detail {

class Scanner {
 public:
  Scanner(std::string_view text, std::size_t at) : text_(text), at_(at) {}

  [[nodiscard]] std::size_t at() const noexcept { return at_; }
  [[nodiscard]] std::string_view rest() const { return text_.substr(at_); }
  [[nodiscard]] char peek() const noexcept { return at_ < text_.size() ? text_[at_] : '\0'; }
  // How many digits stand here.
  [[nodiscard]] std::size_t digits() const noexcept {
    std::size_t end = at_;
    while (end < text_.size() && is_digit(text_[end])) ++end;
    return end - at_;
  }
  [[nodiscard]] int number(std::size_t count) noexcept {
    int value = 0;
    for (; count > 0; --count) value = 10 * value + (text_[at_++] - '0');
    return value;
  }
  [[nodiscard]] std::string take(std::size_t count) {
    const std::string taken(text_.substr(at_, count));
    at_ += count;
    return taken;
  }
  // A number of one or two digits behind one of these characters, which is told.
  [[nodiscard]] bool separated(std::string_view any_of, char& separator, int& value) noexcept {
    Scanner next = *this;
    separator = next.peek();
    if (separator == '\0' || any_of.find(separator) == std::string_view::npos) return false;
    ++next.at_;
    const std::size_t count = next.digits();
    if (count < 1 || count > 2) return false;
    value = next.number(count);
    at_ = next.at_;
    return true;
  }
  // What stands between a date and a time; false: no such thing.
  [[nodiscard]] bool gap() noexcept {
    for (const std::string_view word : {" at ", "_at_", "-at-"})
      if (rest().starts_with(word)) {
        at_ += word.size();
        return true;
      }
    const std::size_t end = std::min(text_.find_first_not_of("Tt_- ,", at_), text_.size());
    const std::size_t length = end - at_;
    at_ = end;
    return length >= 1 && length <= 3;
  }

 private:
  std::string_view text_;
  std::size_t at_;
};

struct Date {
  int year = 0, month = 0, day = 0;
  bool runs_on = false;  // the time follows without a gap
};

// 240501, and 240501123015. A year of two digits is one of these decades: other numbers look like it, too.
[[nodiscard]] inline std::optional<Date> take_short_date(Scanner& scan) {
  constexpr int kFirst = 10, kLast = 49;
  const std::size_t digits = scan.digits();
  Date date;
  date.runs_on = digits == 12 || digits == 15 || digits == 18;
  if (digits != 6 && !date.runs_on) return std::nullopt;
  date.year = scan.number(2);
  if (date.year < kFirst || date.year > kLast) return std::nullopt;
  date.year += 2000;
  date.month = scan.number(2);
  date.day = scan.number(2);
  return date;
}

[[nodiscard]] inline std::optional<Date> take_date(Scanner& scan) {
  Date date;
  const std::size_t digits = scan.digits();
  date.runs_on = digits == 14 || digits == 17 || digits == 20 || digits == 23;
  if (digits != 4 && digits != 8 && !date.runs_on) return std::nullopt;
  date.year = scan.number(4);
  if (date.year < 1970 || date.year > 2099) return std::nullopt;
  if (digits != 4) {
    date.month = scan.number(2);
    date.day = scan.number(2);
    return date;
  }
  char first = 0, second = 0;
  if (!scan.separated("-_.: ", first, date.month) || !scan.separated({&first, 1}, second, date.day))
    return std::nullopt;
  return date;
}

struct Time {
  int hour = 0, minute = 0, second = 0;
  std::string fraction;
};

// 123015, 123015123, 12-30-15, 12:30:15, 12h30m15s123.
[[nodiscard]] inline std::optional<Time> take_time(Scanner& scan) {
  Time time;
  const std::size_t digits = scan.digits();
  if (digits == 6 || digits == 9 || digits == 12 || digits == 15) {
    time.hour = scan.number(2);
    time.minute = scan.number(2);
    time.second = scan.number(2);
    time.fraction = scan.take(scan.digits());
    return time;
  }
  if (digits < 1 || digits > 2) return std::nullopt;
  time.hour = scan.number(digits);
  char first = 0, second = 0;
  if (!scan.separated("-_.:h", first, time.minute)) return std::nullopt;
  const char next = first == 'h' ? 'm' : first;
  if (!scan.separated({&next, 1}, second, time.second)) return std::nullopt;
  if (next == 'm' && scan.peek() == 's') {
    (void)scan.take(1);
    time.fraction = scan.take(scan.digits());
  }
  return time;
}

// " PM" and the like behind a time of twelve hours.
inline void take_half_day(Scanner& scan, Time& time) {
  std::string_view rest = scan.rest();
  const std::size_t all = rest.size();
  for (const std::string_view blank : {" ", "_", "\xe2\x80\xaf"})  // the last: macOS's narrow blank
    if (rest.starts_with(blank)) rest.remove_prefix(blank.size());
  if (rest.size() < 2 || (rest.size() > 2 && std::isalpha(static_cast<unsigned char>(rest[2])) != 0)) return;
  const bool evening = rest[0] == 'P' || rest[0] == 'p';
  const bool named = evening || rest[0] == 'A' || rest[0] == 'a';
  if (!named || (rest[1] != 'M' && rest[1] != 'm') || time.hour < 1 || time.hour > 12) return;
  time.hour = time.hour % 12 + (evening ? 12 : 0);
  (void)scan.take(all - rest.size() + 2);
}

// Of the date that begins at this place, if one does.
[[nodiscard]] inline NameDate date_at(std::string_view stem, std::size_t at, bool short_year) {
  namespace chrono = std::chrono;
  NameDate found;
  Scanner scan(stem, at);
  const std::optional<Date> date = short_year ? take_short_date(scan) : take_date(scan);
  if (!date) return found;
  const chrono::year_month_day day(chrono::year(date->year),
                                   chrono::month(static_cast<unsigned>(date->month)),
                                   chrono::day(static_cast<unsigned>(date->day)));
  std::optional<Time> time;
  if (date->runs_on || scan.gap()) time = take_time(scan);
  if (!time) {
    if (day.ok()) found.kind = DateKind::kDateAlone;
    return found;
  }
  const std::size_t end = scan.at() - time->fraction.size();
  take_half_day(scan, *time);
  // A leap second is the 60th.
  const bool possible = day.ok() && time->hour < 24 && time->minute < 60 && time->second <= 60;
  found.kind = possible ? DateKind::kDateAndTime : DateKind::kImpossible;
  if (!possible) return found;
  const std::int64_t days = chrono::sys_days(day).time_since_epoch().count();
  found.second = ((days * 24 + time->hour) * 60 + time->minute) * 60 + time->second;
  found.fraction = std::move(time->fraction);
  found.form = form_of(stem.substr(at, end - at));
  found.before = stem.substr(0, at);
  found.after = scan.rest();
  return found;
}

}  // namespace name_date_detail

// The first date with a time in the name without its extension; else what comes nearest to one.
// `short_year`: its year has two digits.
[[nodiscard]] inline NameDate date_in_name(std::string_view stem, bool short_year = false) {
  NameDate best;
  for (std::size_t at = 0; at < stem.size(); ++at) {
    const bool begins =
        name_date_detail::is_digit(stem[at]) && (at == 0 || !name_date_detail::is_digit(stem[at - 1]));
    if (!begins) continue;
    NameDate found = name_date_detail::date_at(stem, at, short_year);
    if (found.kind > best.kind) best = std::move(found);
    if (best.kind == DateKind::kDateAndTime) break;
  }
  return best;
}

}  // namespace sslam::io
