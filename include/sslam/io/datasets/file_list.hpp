// SPDX-License-Identifier: BSD-3-Clause
// Lists of `stamp file`, however people's programs write them: names with blanks, in quotes, with
// backslashes, with more columns behind them, with a counter in front, or of another computer's folders.
#pragma once

#include <cmath>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sslam/core/file_kind.hpp"
#include "sslam/io/files/bad_entries.hpp"
#include "sslam/io/files/dated_rows.hpp"
#include "sslam/io/files/files.hpp"
#include "sslam/io/files/plain_text.hpp"
#include "sslam/io/files/stamp_unit.hpp"
#include "sslam/io/files/text.hpp"

namespace sslam::io {

struct StampedFile {
  double stamp = 0;
  std::string file;
};

namespace file_list_detail {

[[nodiscard]] inline bool is_file(const std::filesystem::path& path) {
  std::error_code ignored;
  return std::filesystem::is_regular_file(path, ignored);
}

// The file that a list below `root` names. Of a folder that is not on this computer, the end of the name
// counts.
[[nodiscard]] inline std::string find_listed(const std::filesystem::path& root, std::string name) {
  if (is_file(root / name)) return (root / name).string();
  if (name.starts_with("file://")) name.erase(0, std::string_view("file://").size());
  for (char& c : name)
    if (c == '\\') c = '/';
  const bool absolute = name.starts_with('/') || (name.size() > 1 && name[1] == ':');
  // As seen from a folder above.
  std::error_code ignored;
  std::filesystem::path above =
      std::filesystem::absolute(root / ".", ignored).lexically_normal().parent_path();
  constexpr int kLevels = 4;
  for (int i = 0; !absolute && name.find('/') != std::string::npos && i < kLevels; ++i) {
    above = above.parent_path();
    if (is_file(above / name)) return (above / name).string();
  }
  for (std::size_t at = absolute ? name.find('/') : 0; at != std::string::npos && at < name.size();) {
    const std::size_t start = name[at] == '/' ? at + 1 : at;
    if (is_file(root / name.substr(start))) return (root / name.substr(start)).string();
    if (!absolute) break;
    at = name.find('/', start);
  }
  return (root / name).string();
}

// The same, with the extension of an image where the name has none, and in small or capital letters, which
// are the same on other systems.
[[nodiscard]] inline std::string find_image(const std::filesystem::path& root, const std::string& name) {
  std::string file = find_listed(root, name);
  if (is_file(file)) return file;
  if (const std::filesystem::path path = file; is_image_name(path))
    for (const auto& extension :
         {lower_case(path.extension().string()), upper_case(path.extension().string())})
      if (auto other = std::filesystem::path(path).replace_extension(extension); is_file(other))
        return other.string();
  for (const char* extension : {".png", ".jpg", ".jpeg", ".PNG", ".JPG", ".JPEG", ".webp"})
    if (std::string longer = find_listed(root, name + extension); is_file(longer)) return longer;
  return file;
}

// Takes cells from the front of a row.
class RowReader {
 public:
  explicit RowReader(std::string_view row) : left_(row), separators_(cell_separators(row)) { skip(); }

  [[nodiscard]] bool done() const noexcept { return left_.empty(); }

  [[nodiscard]] std::string_view take_cell() { return take(cell_end(0)); }

  // A blank or a comma may be part of a name, which ends with the extension of an image. Where several do,
  // the first that is there counts.
  [[nodiscard]] std::string take_file(const std::filesystem::path& root) {
    if (in_quotes()) return find_image(root, std::string(take_cell()));
    std::optional<std::size_t> first;
    for (std::size_t end = cell_end(0);;) {
      if (const std::string name(left_.substr(0, end)); is_image_name(name)) {
        const std::string file = find_listed(root, name);
        if (is_file(file)) return take(end), file;
        if (!first) first = end;
      }
      const std::size_t next = left_.find_first_not_of(separators_, end);
      if (next == std::string_view::npos) break;
      end = cell_end(next);
    }
    return find_image(root, std::string(take(first.value_or(cell_end(0)))));
  }

 private:
  [[nodiscard]] bool in_quotes() const noexcept {
    return !left_.empty() && (left_.front() == '"' || left_.front() == '\'') &&
           left_.find(left_.front(), 1) != std::string_view::npos;
  }
  [[nodiscard]] std::size_t cell_end(std::size_t start) const noexcept {
    if (start == 0 && in_quotes()) return left_.find(left_.front(), 1) + 1;
    return std::min(left_.find_first_of(separators_, start), left_.size());
  }
  std::string_view take(std::size_t end) {
    const bool quoted = in_quotes() && end > 1;
    const std::string_view cell = quoted ? left_.substr(1, end - 2) : left_.substr(0, end);
    left_.remove_prefix(end);
    skip();
    return cell;
  }
  void skip() { left_.remove_prefix(std::min(left_.find_first_not_of(separators_), left_.size())); }

  std::string_view left_, separators_;
};

// Whether a file that is not there has a number in front of its name: a counter, or what a decimal comma has
// cut off.
[[nodiscard]] inline bool has_second_number(const StampedFile& entry, const std::filesystem::path& root) {
  if (is_file(entry.file)) return false;
  const std::string name = std::filesystem::path(entry.file).lexically_relative(root).string();
  const std::vector<std::string_view> cells = split_cells(name);
  return cells.size() > 1 && parse_number<double>(cells[0]) && is_image_name(cells[1]);
}

// `stamp file`, `file stamp`, or a stamp that is the name of a file, too.
[[nodiscard]] inline std::optional<StampedFile> take_stamped_file(RowReader& row,
                                                                  const std::filesystem::path& root) {
  if (row.done()) return std::nullopt;
  const std::string_view first = row.take_cell();
  const auto stamp = parse_decimal(first);
  if (stamp && !std::isfinite(*stamp)) return std::nullopt;
  if (row.done()) {
    const std::string file = stamp ? find_image(root, std::string(first)) : std::string();
    return is_file(file) ? std::optional(StampedFile{*stamp, file}) : std::nullopt;
  }
  if (stamp) return StampedFile{*stamp, row.take_file(root)};
  const auto second = is_image_name(first) ? parse_decimal(row.take_cell()) : std::nullopt;
  if (!second || !std::isfinite(*second)) return std::nullopt;
  return StampedFile{*second, find_image(root, std::string(first))};
}

// Where the names of a list without folders lie: in the folder of the list's own name, as rgb/ beside
// rgb.txt, if the first row's file is there alone.
[[nodiscard]] inline std::filesystem::path root_of_names(const std::filesystem::path& list,
                                                         const std::filesystem::path& root, RowReader first) {
  const std::filesystem::path folder = root / list.stem();
  const auto entry = take_stamped_file(first, root);
  if (!entry || is_file(entry->file)) return root;
  const std::filesystem::path name = std::filesystem::path(entry->file).filename();
  return root / name == entry->file && is_file(find_image(folder, name.string())) ? folder : root;
}

// Whether each row counts itself in front of its stamp, as those of UZH-FPV do. The stamps increase; behind a
// decimal comma, which looks alike, the other part of a number would not.
[[nodiscard]] inline bool are_counted(const std::vector<TextRow>& rows) {
  double last = -1;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto& cells = rows[i].cells;
    if (cells.size() < 3 || !is_image_name(std::string(cells[2]))) return false;
    const auto first = parse_number<std::size_t>(rows.front().cells[0]);
    const auto count = parse_number<std::size_t>(cells[0]);
    const auto stamp = parse_number<double>(cells[1]);
    if (!first || !count || *count != *first + i || !stamp || !(*stamp > last)) return false;
    last = *stamp;
  }
  return rows.size() > 1;
}

}  // namespace file_list_detail

// What the layout of a list has, and no warning needs to tell.
struct ListForm {
  bool counted = false;  // its first column counts the rows
  StampUnit unit{};
};

// Turns stamps into seconds, and says so where their unit is not the usual one.
template <class Entry>
void to_seconds(std::vector<Entry>& entries, StampsOf whose, const std::filesystem::path& source,
                Warnings& warnings, StampUnit usual = {}) {
  std::vector<double> stamps;
  stamps.reserve(entries.size());
  for (const Entry& entry : entries) stamps.push_back(entry.stamp);
  const StampUnit unit = stamp_unit_of(stamps, whose);
  if (unit.is_seconds()) return;
  for (Entry& entry : entries) entry.stamp /= unit.per_second;
  if (unit.per_second != usual.per_second) warnings.push_back(source.string() + ": " + unit_note(unit));
}

// Rows of `stamp file`, file relative to root, stamps in seconds. `second`: of rows of `stamp file stamp
// file`, what follows; null: not wanted. Throws Error when nothing usable is in the list.
[[nodiscard]] inline std::vector<StampedFile> read_file_list(const std::filesystem::path& list,
                                                             const std::filesystem::path& root,
                                                             Warnings& warnings, const ListForm& form = {},
                                                             std::vector<StampedFile>* second = nullptr) {
  std::string text = read_plain_text(list);
  if (const std::string kind = file_kind(text); !kind.empty())
    throw Error(list.string() + ": " + kind + "; expected rows of 'stamp file' in plain text");
  text = with_seconds(std::move(text), list, warnings);
  std::vector<TextRow> rows = split_rows(text);
  if (!rows.empty() && is_header(rows.front())) rows.erase(rows.begin());
  if (rows.empty()) throw Error(list.string() + ": names no image; expected rows of 'stamp file'");
  const bool counted = file_list_detail::are_counted(rows);
  if (counted && !form.counted)
    warnings.push_back(list.string() + ": its first column counts the rows: left out");
  BadEntries bad(list);
  std::vector<StampedFile> files;
  const auto reader_of = [counted](const TextRow& row) {
    file_list_detail::RowReader reader(row.text);
    if (counted) (void)reader.take_cell();
    return reader;
  };
  const std::filesystem::path folder = file_list_detail::root_of_names(list, root, reader_of(rows.front()));
  for (const TextRow& row : rows) {
    file_list_detail::RowReader reader = reader_of(row);
    auto file = file_list_detail::take_stamped_file(reader, folder);
    if (!file) {
      bad.add(row.line, "expected 'stamp file' with the stamp as a number, or as 2011-09-26T13:02:25.96");
      continue;
    }
    if (file_list_detail::has_second_number(*file, folder)) {
      bad.add(row.line, "has two numbers before the file; expected 'stamp file', with a decimal point");
      continue;
    }
    files.push_back(std::move(*file));
    if (second == nullptr) continue;
    if (auto other = file_list_detail::take_stamped_file(reader, folder))
      second->push_back(std::move(*other));
  }
  bad.settle(rows.size(), warnings);
  to_seconds(files, StampsOf::kImages, list, warnings, form.unit);
  Warnings told;  // once is enough
  if (second != nullptr) to_seconds(*second, StampsOf::kImages, list, told);
  return files;
}

}  // namespace sslam::io
