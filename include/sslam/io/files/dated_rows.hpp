// SPDX-License-Identifier: BSD-3-Clause
// Tables whose stamps are dates or times of day: read as tables whose stamps are seconds.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sslam/core/error.hpp"
#include "sslam/io/files/bad_entries.hpp"
#include "sslam/io/files/date_stamps.hpp"
#include "sslam/io/files/text.hpp"

namespace sslam::io {

namespace dated_rows_detail {

// Writes rows anew, with seconds in place of dates.
class DateReplacer {
 public:
  explicit DateReplacer(const std::filesystem::path& source) : source_(source) {}

  // `row`: a line without its end. Appends it to `out`.
  void add(std::string_view row, int line, std::string& out) {
    const bool semicolons = row.find(';') != std::string_view::npos;
    std::size_t done = 0;
    for (std::size_t at = 0; at < row.size(); ++at) {
      const bool begins =
          at == 0 || std::string_view(" \t,;|\"'").find(row[at - 1]) != std::string_view::npos;
      if (!begins || !date_stamps_detail::is_digit(row[at])) continue;
      const auto stamp = date_stamp_at(row.substr(at), semicolons);
      if (!stamp || (!stamp->dated && follows_number(row.substr(0, at)))) continue;
      const std::string_view text = row.substr(at, stamp->length);
      note(*stamp, text, line);
      out += row.substr(done, at - done);
      out += std::to_string(stamp->dated ? stamp->second : past_midnight(stamp->second));
      if (!stamp->fraction.empty()) {
        const bool comma = semicolons && text.find(',') != std::string_view::npos;  // as in the other cells
        out += (comma ? ',' : '.') + stamp->fraction;
      }
      done = at + stamp->length;
      at = done;
    }
    out += row.substr(done);
  }

  // What to say about it; empty: there was no date.
  [[nodiscard]] std::string note() const {
    if (first_.empty()) return {};
    const std::string such = source_.string() + ": stamps such as '" + first_ + "' are ";
    if (!dated_) return such + "times of day: read as seconds since midnight";
    return such + "dates: read as seconds since 1970, " + (zoned_ ? "in their time zone" : "in UTC");
  }

 private:
  // Then a time of day is that of a date in another form, or one of several numbers.
  [[nodiscard]] static bool follows_number(std::string_view before) {
    const std::vector<std::string_view> cells = split_cells(before);
    return !cells.empty() && cells.back().find_first_not_of("0123456789-/.") == std::string_view::npos;
  }

  void note(const DateStamp& stamp, std::string_view text, int line) {
    if (first_.empty()) {
      first_ = text;
      dated_ = stamp.dated;
      zoned_ = stamp.zoned;
      return;
    }
    if (stamp.dated == dated_ && stamp.zoned == zoned_) return;
    throw Error(
        source_.string() + ": line " + std::to_string(line) + ": '" + std::string(text) + "' and '" + first_ +
        "' are not of one form; expected a " +
        (stamp.dated == dated_ ? "time zone in all stamps, or in none" : "date in all stamps, or in none"));
  }

  [[nodiscard]] std::int64_t past_midnight(std::int64_t second) noexcept {
    constexpr std::int64_t kDay = 86400;
    if (second + days_ * kDay < last_ - kDay / 2) ++days_;
    last_ = second + days_ * kDay;
    return last_;
  }

  std::filesystem::path source_;
  std::string first_;  // stamp, as written
  bool dated_ = false, zoned_ = false;
  std::int64_t days_ = 0, last_ = 0;
};

}  // namespace dated_rows_detail

// The text with seconds in place of dates and times of day, each a cell of its own, in rows that are no
// comments (# or %); the same text where there is none. A warning says how they are read. Throws Error where
// only some have a time zone, or a date.
[[nodiscard]] inline std::string with_seconds(std::string text, const std::filesystem::path& source,
                                              Warnings& warnings) {
  if (text.find(':') == std::string::npos && text.find('T') == std::string::npos &&
      text.find('t') == std::string::npos)
    return text;
  dated_rows_detail::DateReplacer replacer(source);
  std::string out;
  out.reserve(text.size());
  int line = 0;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    const std::string_view row = std::string_view(text).substr(at, end - at);
    const std::size_t first = std::min(row.find_first_not_of(" \t"), row.size());
    const bool comment = row.substr(first).starts_with('#') || row.substr(first).starts_with('%');
    ++line;
    if (comment)
      out += row;
    else
      replacer.add(row, line, out);
    if (end < text.size()) out += '\n';
    at = end + 1;
  }
  std::string note = replacer.note();
  if (note.empty()) return text;
  warnings.push_back(std::move(note));
  return out;
}

}  // namespace sslam::io
