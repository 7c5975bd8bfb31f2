// SPDX-License-Identifier: BSD-3-Clause
// Calibrations as rows of numbers: COLMAP's cameras.txt, the camera.txt of DSO and of mono_dataset, a camera
// matrix, and "fx fy cx cy k1 k2 p1 p2 k3".
#pragma once

#include <algorithm>
#include <cctype>
#include <iterator>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sslam/opencv/camera/matrix_cameras.hpp"

namespace sslam {
namespace detail {

// Words, row after row; comments (#, %, //) and empty rows are left out, and what follows the first few.
// Programs put commas or brackets around numbers, and NumPy the word array.
using WordRows = std::vector<std::vector<std::string>>;

[[nodiscard]] inline bool is_number(const std::string& word) {
  return number_of(word).has_value();
}

[[nodiscard]] inline std::vector<std::string> words_of(const std::string& line) {
  std::istringstream words(line);
  return {std::istream_iterator<std::string>(words), std::istream_iterator<std::string>()};
}

[[nodiscard]] inline WordRows word_rows(const std::string& text) {
  WordRows rows;
  std::istringstream lines(text);
  constexpr std::size_t kEnough = 6;  // a matrix has four
  for (std::string line; rows.size() < kEnough && std::getline(lines, line);) {
    line.erase(std::min({line.find_first_of("#%"), line.find("//"), line.size()}));
    std::string bare = line;
    if (const std::size_t array = bare.find("array("); array != std::string::npos) bare.erase(0, array + 5);
    for (char& c : bare)
      if (std::string_view(",;[]()").find(c) != std::string_view::npos) c = ' ';
    std::vector<std::string> row = words_of(bare);
    if (!std::all_of(row.begin(), row.end(), is_number)) row = words_of(line);
    if (!row.empty()) rows.push_back(std::move(row));
  }
  return rows;
}

// Whether numbers are written as 500,5: blanks or semicolons separate them, and each comma is between two
// digits.
[[nodiscard]] inline bool has_decimal_commas(const std::string& line) {
  std::string bare = line.substr(0, line.find('#'));
  for (char& c : bare)
    if (std::string_view(";[]").find(c) != std::string_view::npos) c = ' ';
  const std::vector<std::string> cells = words_of(bare);
  bool any = false;
  for (std::string cell : cells) {
    const std::size_t comma = cell.find(',');
    if (comma != std::string::npos) {
      if (comma == 0 || comma + 1 == cell.size() || cell.find('.') != std::string::npos) return false;
      cell[comma] = '.';
      any = true;
    }
    if (!is_number(cell)) return false;
  }
  return any && cells.size() > 1;
}

[[nodiscard]] inline std::vector<double> row_numbers(const CameraKeys& keys,
                                                     const std::vector<std::string>& row, std::size_t from) {
  std::vector<double> values;
  for (std::size_t i = from; i < row.size(); ++i) {
    const auto value = number_of(row[i]);
    if (!value || !std::isfinite(*value)) keys.fail("'" + row[i] + "' is no finite number");
    values.push_back(*value);
  }
  return values;
}

inline void demand_numbers(const CameraKeys& keys, const std::string& model, std::size_t found,
                           std::size_t wanted) {
  if (found < wanted)
    keys.fail(model + " has " + std::to_string(found) + " numbers; expected " + std::to_string(wanted));
}

// fx and fy, positive.
inline void set_pinhole(const CameraKeys& keys, double fx, double fy, double cx, double cy,
                        CameraFile& file) {
  if (!(fx > 0) || !(fy > 0))
    keys.fail("the focal lengths are " + short_text(fx) + " and " + short_text(fy) +
              "; expected pixels, greater than 0");
  file.camera.pinhole = {fx, fy, cx, cy};
}

inline int row_pixels(const CameraKeys& keys, double value) {
  return keys.whole_pixels(TextNode{}, "the image's width or height", value);
}

// Numbers behind the size; 0: a model that is not known here.
[[nodiscard]] inline std::size_t colmap_count(const std::string& model) {
  using Count = std::pair<std::string_view, std::size_t>;
  for (const auto& [name, count] :
       {Count{"SIMPLE_PINHOLE", 3}, Count{"PINHOLE", 4}, Count{"SIMPLE_RADIAL", 4}, Count{"RADIAL", 5},
        Count{"OPENCV", 8}, Count{"OPENCV_FISHEYE", 8}, Count{"FULL_OPENCV", 12}, Count{"FOV", 5},
        Count{"SIMPLE_RADIAL_FISHEYE", 4}, Count{"RADIAL_FISHEYE", 5}})
    if (model == name) return count;
  return 0;
}

// Of several cameras: "; another is of 320x240"; empty where all have one size.
[[nodiscard]] inline std::string other_size(const WordRows& rows) {
  for (const std::vector<std::string>& row : rows)
    if (row.size() > 3 && (row[2] != rows.front()[2] || row[3] != rows.front()[3]))
      return " (" + rows.front()[2] + "x" + rows.front()[3] + "; another is of " + row[2] + "x" + row[3] +
             ": for its images, keep its row alone)";
  return {};
}

// CAMERA_ID MODEL WIDTH HEIGHT PARAMS[]. The first pixel's centre is (0.5, 0.5).
[[nodiscard]] inline CameraFile read_colmap(const CameraKeys& keys, const WordRows& rows) {
  CameraFile file;
  const std::vector<std::string>& row = rows.front();
  const std::string& model = row[1];
  const std::vector<double> v = row_numbers(keys, row, 2);
  const std::size_t count = colmap_count(model);
  if (count == 0) refuse_lens(keys, model);
  if (v.size() != count + 2)
    keys.fail(model + " has " + std::to_string(v.size()) + " numbers; expected " + std::to_string(count + 2) +
              ": the width, the height, and " + std::to_string(count) + " of the model");
  file.camera.width = row_pixels(keys, v[0]);
  file.camera.height = row_pixels(keys, v[1]);
  const bool one_focal = model.starts_with("SIMPLE_") || model == "RADIAL" || model.starts_with("RADIAL_");
  const std::size_t first = one_focal ? 5 : 6;
  set_pinhole(keys, v[2], one_focal ? v[2] : v[3], v[first - 2] - 0.5, v[first - 1] - 0.5, file);
  std::vector<double> lens(v.begin() + static_cast<std::ptrdiff_t>(first), v.end());
  set_lens(keys, model, lens, file);
  if (rows.size() > 1)
    file.notes.push_back(keys.file() + ": has several cameras; the first is taken" + other_size(rows));
  return file;
}

// "[MODEL] fx fy cx cy omega or k1 k2 p1 p2", then "width height"; the first row may count in shares of the
// image.
[[nodiscard]] inline CameraFile read_dso(const CameraKeys& keys, const WordRows& rows) {
  CameraFile file;
  const bool named = std::isalpha(static_cast<unsigned char>(rows[0][0][0])) != 0;
  std::vector<double> v = row_numbers(keys, rows[0], named ? 1 : 0);
  demand_numbers(keys, "the first row", v.size(), 4);
  const std::vector<double> size = row_numbers(keys, rows[1], 0);
  file.camera.width = row_pixels(keys, size[0]);
  file.camera.height = row_pixels(keys, size[1]);
  if (v[2] < 1 && v[3] < 1) {
    v[0] *= size[0];
    v[1] *= size[1];
    v[2] = v[2] * size[0] - 0.5;
    v[3] = v[3] * size[1] - 0.5;
  }
  set_pinhole(keys, v[0], v[1], v[2], v[3], file);
  std::vector<double> lens(v.begin() + 4, v.end());
  const std::string model = named ? rows[0][0] : lens.size() > 1 ? "RadTan" : "FOV";
  if (lens.size() == 1 && lens[0] == 0) return file;  // omega: the lens is straight
  set_lens(keys, model, lens, file);
  return file;
}

// Whether a principal point may be at this place of so many pixels.
[[nodiscard]] constexpr bool is_middle(double place, double pixels) noexcept {
  return place > 0.3 * pixels && place < 0.7 * pixels;
}

// Nothing where the text is of none of these kinds.
[[nodiscard]] inline std::optional<CameraFile> read_camera_rows(const std::string& text,
                                                                const std::string& path) {
  const WordRows rows = word_rows(text);
  if (rows.empty()) return std::nullopt;
  std::istringstream lines(text);
  int number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    if (has_decimal_commas(line))
      throw Error(path + ": line " + std::to_string(number) + ": '" + line.substr(0, 60) +
                  "' has decimal commas; expected decimal points");
    if (words_of(line).size() > 20) break;  // no row of a calibration
  }
  const TextNode none;
  const CameraKeys keys(none, path);
  const auto numeric = [](const std::vector<std::string>& row, std::size_t from) {
    return row.size() > from &&
           std::all_of(row.begin() + static_cast<std::ptrdiff_t>(from), row.end(), is_number);
  };
  const std::vector<std::string>& first = rows.front();
  if (first.size() >= 5 && numeric({first[0]}, 0) &&
      std::isupper(static_cast<unsigned char>(first[1][0])) != 0)
    return read_colmap(keys, rows);
  const bool size_next = rows.size() > 1 && rows[1].size() == 2 && numeric(rows[1], 0);
  if (size_next && (numeric(first, 0) || (numeric(first, 1) && first[0].find(':') == std::string::npos)))
    return read_dso(keys, rows);
  if (!numeric(first, 0)) return std::nullopt;
  std::vector<double> all;
  for (const std::vector<std::string>& row : rows)
    for (const double value : row_numbers(keys, row, 0)) all.push_back(value);
  CameraFile file;
  const bool matrix_in_one = rows.size() == 1 && all.size() == 9 && all[1] == 0 && all[3] == 0;
  if (rows.size() == 3 || rows.size() == 4 || matrix_in_one) {
    set_matrix(keys, "the camera matrix", all, file);
    return file;
  }
  if (rows.size() == 1 && all.size() == 6 && is_middle(all[4], all[0]) &&
      is_middle(all[5], all[1])) {  // ARKitScenes' .pincam
    file.camera.width = row_pixels(keys, all[0]);
    file.camera.height = row_pixels(keys, all[1]);
    set_pinhole(keys, all[2], all[3], all[4], all[5], file);
    file.notes.push_back(path + ": its six numbers are read as width height fx fy cx cy");
    return file;
  }
  if (rows.size() > 1 || (all.size() != 4 && all.size() != 8 && all.size() != 9))
    keys.fail(
        "rows of numbers that are no calibration; expected fx fy cx cy with k1 k2 p1 p2 k3, or a 3x3 matrix");
  set_pinhole(keys, all[0], all[1], all[2], all[3], file);
  set_lens(keys, "plumb_bob", {all.begin() + 4, all.end()}, file);
  return file;
}

}  // namespace detail
}  // namespace sslam
