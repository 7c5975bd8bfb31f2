// SPDX-License-Identifier: BSD-3-Clause
// Stamps that are written as dates, '2011-09-26 13:02:25.964389445' or '2011-09-26T13:02:25.96+01:00', or as
// times of day, '13:02:25.96'.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "sslam/io/files/text.hpp"

namespace sslam::io {

struct DateStamp {
  std::int64_t second = 0;  // since 1970 in UTC; of a time of day, since midnight
  std::string fraction;     // digits of the rest of a second, behind the point
  bool dated = false;       // false: a time of day
  bool zoned = false;       // a time zone is written, and applied
  std::size_t length = 0;   // characters of the text
};

namespace date_stamps_detail {

[[nodiscard]] inline bool is_digit(char c) noexcept {
  return c >= '0' && c <= '9';
}

// Takes numbers and marks from the front of a text.
class Reader {
 public:
  explicit Reader(std::string_view text) : text_(text) {}

  [[nodiscard]] std::size_t at() const noexcept { return at_; }
  [[nodiscard]] char peek(std::size_t on = 0) const noexcept {
    return at_ + on < text_.size() ? text_[at_ + on] : '\0';
  }
  [[nodiscard]] std::size_t digits() const noexcept {
    std::size_t count = 0;
    while (is_digit(peek(count))) ++count;
    return count;
  }
  void skip(std::size_t count) noexcept { at_ += count; }
  // A number of so many digits; nothing, and nothing taken, where there are fewer.
  [[nodiscard]] std::optional<int> number(std::size_t count) noexcept {
    if (digits() < count) return std::nullopt;
    int value = 0;
    for (; count > 0; --count) value = 10 * value + (text_[at_++] - '0');
    return value;
  }
  [[nodiscard]] bool take(char mark) noexcept {
    if (peek() != mark || mark == '\0') return false;
    ++at_;
    return true;
  }
  [[nodiscard]] std::string take_digits() {
    const std::size_t count = digits();
    at_ += count;
    return std::string(text_.substr(at_ - count, count));
  }
  [[nodiscard]] bool ends_cell() const noexcept {
    return at_ >= text_.size() ||
           std::string_view(" \t\r\n,;|\"'").find(text_[at_]) != std::string_view::npos;
  }

 private:
  std::string_view text_;
  std::size_t at_ = 0;
};

// 2011-09-26, 2011/09/26, or 20110926 in front of a T; days since 1970.
[[nodiscard]] inline std::optional<std::int64_t> take_day(Reader& reader) {
  namespace chrono = std::chrono;
  const std::size_t digits = reader.digits();
  const bool compact = digits == 8;
  if (!compact && digits != 4) return std::nullopt;
  const auto year = reader.number(4);
  const char mark = reader.peek();
  if (!compact && ((mark != '-' && mark != '/') || !reader.take(mark))) return std::nullopt;
  const auto month = reader.number(2);
  if (!month || (!compact && !reader.take(mark))) return std::nullopt;
  const auto day = reader.number(2);
  if (!day || *year < 1970 || *year > 2099) return std::nullopt;
  if (compact && reader.peek() != 'T' && reader.peek() != 't') return std::nullopt;
  const chrono::year_month_day date(chrono::year(*year), chrono::month(static_cast<unsigned>(*month)),
                                    chrono::day(static_cast<unsigned>(*day)));
  if (!date.ok()) return std::nullopt;
  return chrono::sys_days(date).time_since_epoch().count();
}

// 13:02:25, or 130225; seconds since midnight. A leap second is the 60th.
[[nodiscard]] inline std::optional<int> take_clock(Reader& reader, bool may_be_compact) {
  const std::size_t digits = reader.digits();
  const bool compact = may_be_compact && digits == 6;
  if (!compact && digits != 1 && digits != 2) return std::nullopt;
  const auto hour = reader.number(compact ? 2 : digits);
  if (!compact && !reader.take(':')) return std::nullopt;
  const auto minute = reader.number(2);
  if (!minute || (!compact && !reader.take(':'))) return std::nullopt;
  const auto second = reader.number(2);
  if (!second || *hour > 23 || *minute > 59 || *second > 60) return std::nullopt;
  return (*hour * 60 + *minute) * 60 + *second;
}

// Behind a point, or behind a comma that separates nothing: three, six or nine digits at the cell's end, or
// any in a row of `;`.
inline void take_fraction(Reader& reader, std::string& fraction, bool semicolons) {
  Reader ahead = reader;
  const bool comma = ahead.peek() == ',';
  if (!ahead.take('.') && !ahead.take(',')) return;
  fraction = ahead.take_digits();
  const bool whole = semicolons || (fraction.size() % 3 == 0 && ahead.peek() != ',' && ahead.peek() != '.');
  if (fraction.empty() || (comma && !whole)) return fraction.clear();
  reader = ahead;
}

// Z, +01, +0100, +01:00, -05:00, also UTC or one with a + behind a blank; seconds east of Greenwich.
[[nodiscard]] inline std::optional<int> take_zone(Reader& reader) {
  Reader ahead = reader;
  const bool blank = ahead.take(' ');
  for (const std::string_view word : {"Z", "z", "UTC", "GMT"}) {
    Reader behind = ahead;
    std::size_t same = 0;
    while (same < word.size() && behind.take(word[same])) ++same;
    if (same < word.size() || !behind.ends_cell()) continue;
    reader = behind;
    return 0;
  }
  const bool west = !blank && ahead.peek() == '-';
  if (!west && ahead.peek() != '+') return std::nullopt;
  ahead.skip(1);
  const auto hours = ahead.number(2);
  const bool colon = ahead.take(':');
  const auto minutes = ahead.number(2);
  const bool complete = minutes || (!colon && !blank);
  if (!hours || !complete || *hours > 14 || minutes.value_or(0) > 59 || !ahead.ends_cell())
    return std::nullopt;
  reader = ahead;
  const int east = (*hours * 60 + minutes.value_or(0)) * 60;
  return west ? -east : east;
}

}  // namespace date_stamps_detail

// Of a date and a time to the second, or a time alone, that `text` begins with and that fills its cell;
// nothing where there is none. `semicolons`: these separate cells, and not commas.
[[nodiscard]] inline std::optional<DateStamp> date_stamp_at(std::string_view text, bool semicolons = false) {
  using namespace date_stamps_detail;
  Reader reader(text);
  DateStamp found;
  std::int64_t days = 0;
  const std::size_t digits = reader.digits();
  found.dated = digits == 4 || digits == 8;
  if (found.dated) {
    const auto day = take_day(reader);
    if (!day) return std::nullopt;
    days = *day;
    const bool gap = reader.take('T') || reader.take('t') || reader.take('_') || reader.take(',') ||
                     reader.take(';') || reader.take(' ') || reader.take('\t');
    if (!gap) return std::nullopt;
    (void)reader.take(' ');  // behind a comma
  }
  const auto clock = take_clock(reader, found.dated);
  if (!clock) return std::nullopt;
  take_fraction(reader, found.fraction, semicolons);
  const auto zone = found.dated ? take_zone(reader) : std::nullopt;
  if (!reader.ends_cell()) return std::nullopt;
  constexpr std::int64_t kDay = 86400;
  found.zoned = zone.has_value();
  found.second = days * kDay + *clock - zone.value_or(0);
  found.length = reader.at();
  return found;
}

// The seconds of a text that is a date and a time and nothing else; nothing where it is not.
[[nodiscard]] inline std::optional<double> seconds_of_date(std::string_view text) {
  const auto stamp = date_stamp_at(text);
  if (!stamp || stamp->length != text.size() || !stamp->dated) return std::nullopt;
  return parse_number<double>(std::to_string(stamp->second) + "." + stamp->fraction + "0");
}

}  // namespace sslam::io
