// SPDX-License-Identifier: BSD-3-Clause
// The stamps of a folder of images in a list in it or beside it: times.txt or timestamps.txt with a row an
// image, as of TUM's monocular recordings: 'id stamp exposure', 'stamp', 'stamp file' or 'file,stamp'.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sslam/io/files/bad_entries.hpp"
#include "sslam/io/files/dated_rows.hpp"
#include "sslam/io/files/files.hpp"
#include "sslam/io/files/plain_text.hpp"
#include "sslam/io/files/stamp_unit.hpp"
#include "sslam/io/files/text.hpp"

namespace sslam::io {

// The list; empty: none. Beside the folder, only where no other folder of images lies there, whose it may be.
[[nodiscard]] inline std::filesystem::path find_times_beside(const std::filesystem::path& images) {
  std::error_code ignored;
  const std::filesystem::path full = std::filesystem::absolute(images / ".", ignored).lexically_normal();
  const std::filesystem::path folder = full.parent_path(), above = folder.parent_path();
  const auto list_in = [&](const std::filesystem::path& place) {
    return first_file(
        {place / "times.txt", place / "timestamps.txt", place / "timestamps.csv", place / "times.csv"});
  };
  if (auto list = list_in(folder); !list.empty()) return list;
  auto list = list_in(above);
  if (list.empty()) return {};
  for (const std::filesystem::path& each : list_folders(above))
    if (each != folder && !list_files(each, is_image_name).empty()) return {};
  return list;
}

namespace times_beside_detail {

// A row's stamp, and the image that it names by its file or by its number; nothing where it has no stamp.
struct Row {
  double stamp = 0;
  std::string image;  // empty: it names none
};

[[nodiscard]] inline std::optional<Row> row_of(const TextRow& row) {
  std::array<std::optional<double>, 2> numbers;
  for (std::size_t i = 0; i < std::min<std::size_t>(2, row.cells.size()); ++i) {
    numbers[i] = parse_decimal(row.cells[i]);
    if (numbers[i] && !std::isfinite(*numbers[i])) return std::nullopt;
  }
  const auto stem = [](std::string_view file) { return std::filesystem::path(file).stem().string(); };
  if (row.cells.size() == 1) return numbers[0] ? std::optional(Row{*numbers[0], {}}) : std::nullopt;
  if (numbers[0] && is_image_name(std::string(row.cells[1])))
    return Row{*numbers[0], stem(std::string(row.cells[1]))};
  if (!numbers[1]) return std::nullopt;
  const bool named = !numbers[0] || row.cells.size() > 2 || all_digits(row.cells[0]);
  return named ? std::optional(Row{*numbers[1], stem(std::string(row.cells[0]))}) : std::nullopt;
}

}  // namespace times_beside_detail

// Of the images, in their order and in seconds; empty, with the reason among the warnings, where the list
// does not tell. A warning also says that it is used.
[[nodiscard]] inline std::vector<double> read_times_beside(const std::filesystem::path& list,
                                                           const std::vector<std::filesystem::path>& images,
                                                           Warnings& warnings) {
  const auto unused = [&](const std::string& why) {
    warnings.push_back(list.string() + ": is not used for the stamps of the images: " + why +
                       "; expected a row an image, 'stamp' or 'file stamp'");
    return std::vector<double>{};
  };
  const std::string text = with_seconds(read_plain_text(list), list, warnings);
  std::vector<TextRow> rows = split_rows(text);
  if (!rows.empty() && is_header(rows.front())) rows.erase(rows.begin());
  std::vector<double> in_order;
  std::map<std::string, double> by_name;
  for (const TextRow& row : rows) {
    const auto found = times_beside_detail::row_of(row);
    if (!found) return unused("line " + std::to_string(row.line) + " has no stamp");
    in_order.push_back(found->stamp);
    if (!found->image.empty()) by_name.emplace(found->image, found->stamp);
  }
  std::vector<double> stamps;
  if (by_name.empty() && in_order.size() == images.size()) stamps = in_order;
  if (by_name.size() == in_order.size())
    for (const std::filesystem::path& image : images)
      if (const auto named = by_name.find(image.stem().string()); named != by_name.end())
        stamps.push_back(named->second);
  if (stamps.size() != images.size())
    return unused("it has " + std::to_string(rows.size()) + " rows for " + std::to_string(images.size()) +
                  " images" + (by_name.empty() ? "" : ", and not the names of all"));
  const StampUnit unit = stamp_unit_of(stamps, StampsOf::kImages);
  for (double& stamp : stamps) stamp /= unit.per_second;
  warnings.push_back(list.string() + ": has the stamps of the images" +
                     (unit.is_seconds() ? "" : "; " + unit_note(unit)));
  return stamps;
}

}  // namespace sslam::io
