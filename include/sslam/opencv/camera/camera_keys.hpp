// SPDX-License-Identifier: BSD-3-Clause
// The numbers of a calibration by their keys. What is wrong with one is told with file, line, key and remedy.
#pragma once

#include <cmath>
#include <cstdio>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sslam/core/error.hpp"
#include "sslam/core/text_node.hpp"
#include "sslam/opencv/camera/wide_lens.hpp"

namespace sslam {

struct CameraFile {
  Camera<double> camera;    // width and height are 0 when the file does not give them
  double depth_factor = 0;  // depth image units a metre; 0: not given
  double frame_rate = 0;    // frames a second; 0: not given
  // A lens that is no radial-tangential one: `camera` has no distortion then, and is its plane alone.
  std::optional<WideLens> wide{};
  std::string wide_reason{};  // why it is none
  // Radians across, where that is all that the file says, without the image's size: `camera` is empty then.
  double view_across = 0;
  // Of a file with several cameras whose images it does not tell: their names, and all but this one.
  std::string name{};
  std::vector<CameraFile> others{};
  std::vector<std::string> notes{};  // what the user should know about how the file was read
};

// "CAM_A (1280x800), CAM_B (640x400)": of all cameras of a file with several.
[[nodiscard]] inline std::string camera_names(const CameraFile& file) {
  std::string names =
      file.name + " (" + std::to_string(file.camera.width) + "x" + std::to_string(file.camera.height) + ")";
  for (const CameraFile& other : file.others) names += ", " + camera_names(other);
  return names;
}

namespace detail {

// The first of these is the answer, with the others beside it.
[[nodiscard]] inline CameraFile one_of(std::vector<CameraFile> cameras) {
  CameraFile first = std::move(cameras.front());
  first.others.assign(std::make_move_iterator(cameras.begin() + 1), std::make_move_iterator(cameras.end()));
  return first;
}

[[nodiscard]] inline std::string short_text(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", value);
  return text;
}

class CameraKeys {
 public:
  using Names = std::vector<std::string_view>;  // of one thing; the first is the one to tell of

  // `where` stands before the keys in messages, such as "cam0.".
  CameraKeys(const TextNode& map, std::string file, std::string where = {})
      : map_(map), file_(std::move(file)), where_(std::move(where)) {}

  [[nodiscard]] const TextNode& map() const { return map_; }
  [[nodiscard]] const std::string& file() const { return file_; }
  [[nodiscard]] const std::string& where() const { return where_; }
  [[nodiscard]] bool has(std::string_view key) const { return map_.has(key); }
  [[nodiscard]] bool has_any(const Names& names) const { return map_.find_any(names) != nullptr; }

  [[noreturn]] void fail(const std::string& what) const { throw Error(file_ + ": " + what); }
  [[noreturn]] void fail(const TextNode& node, std::string_view key, const std::string& what) const {
    const std::string line = node.line > 0 ? "line " + std::to_string(node.line) + ": " : "";
    throw Error(file_ + ": " + line + where_ + std::string(key) + " " + what);
  }

  // The text of a scalar; empty where there is none.
  [[nodiscard]] std::string text(const Names& names) const {
    const TextNode* const node = map_.find_any(names);
    return node != nullptr && node->kind == TextNode::Kind::kScalar ? node->text : std::string();
  }

  [[nodiscard]] double required(const Names& names, const std::string& meaning) const {
    if (!has_any(names)) fail(where_ + std::string(names.front()) + " is missing; expected " + meaning);
    return optional(names, 0, meaning);
  }
  [[nodiscard]] double optional(const Names& names, double otherwise, const std::string& meaning) const {
    for (const std::string_view name : names)
      if (const TextNode* const node = map_.find(name)) return number(*node, name, meaning);
    return otherwise;
  }
  [[nodiscard]] double required_positive(const Names& names, const std::string& meaning) const {
    (void)required(names, meaning);
    return optional_positive(names, meaning);
  }
  // 0 when absent.
  [[nodiscard]] double optional_positive(const Names& names, const std::string& meaning) const {
    for (const std::string_view name : names) {
      const TextNode* const node = map_.find(name);
      if (node == nullptr) continue;
      const double value = number(*node, name, meaning);
      if (value > 0) return value;
      fail(*node, name, "is " + short_text(value) + "; expected " + meaning + ", greater than 0");
    }
    return 0;
  }
  // A width or height, 0 when absent.
  [[nodiscard]] int optional_pixels(const Names& names) const {
    const std::string meaning = "a whole number of pixels";
    const double value = optional_positive(names, meaning);
    return value == 0 ? 0 : whole_pixels(*map_.find_any(names), names.front(), value);
  }
  [[nodiscard]] int whole_pixels(const TextNode& node, std::string_view key, double value) const {
    constexpr double kLargest = 65535;
    if (value >= 1 && value <= kLargest && value == std::floor(value)) return static_cast<int>(value);
    fail(node, key, "is " + short_text(value) + "; expected a whole number of pixels");
  }

  // Of a list, of lists in a list, of the `data` of a matrix, or of a row of numbers; empty when absent.
  [[nodiscard]] std::vector<double> numbers(const Names& names, const std::string& meaning) const {
    std::vector<double> values;
    for (const std::string_view name : names) {
      const TextNode* const node = map_.find(name);
      if (node == nullptr) continue;
      const TextNode* const data = node->find("data");
      gather(data != nullptr ? *data : *node, name, meaning, values);
      if (data != nullptr) demand_count(*node, name, values.size());
      break;
    }
    return values;
  }

 private:
  [[nodiscard]] double number(const TextNode& node, std::string_view key, const std::string& meaning) const {
    if (node.kind != TextNode::Kind::kScalar) fail(node, key, "is not a number; expected " + meaning);
    const auto value = number_of(node.text);
    if (!value) {
      std::string point = node.text;
      if (const auto comma = point.find(','); comma != std::string::npos) point[comma] = '.';
      const bool decimal_comma = point != node.text && number_of(point);
      fail(node, key,
           "is '" + node.text + "', not a number; expected " +
               (decimal_comma ? "a decimal point: " + point : meaning));
    }
    if (!std::isfinite(*value)) fail(node, key, "is not finite; expected " + meaning);
    return *value;
  }

  // A matrix that has another number of numbers than its rows and columns say is cut off, or is another
  // one's.
  void demand_count(const TextNode& matrix, std::string_view key, std::size_t found) const {
    const TextNode* const rows = matrix.find("rows");
    const TextNode* const columns = matrix.find("cols");
    if (rows == nullptr || columns == nullptr) return;
    const double wanted = number_of(rows->text).value_or(0) * number_of(columns->text).value_or(0);
    if (wanted > 0 && wanted != static_cast<double>(found))
      fail(matrix, key,
           "has " + std::to_string(found) + " numbers, and by its rows and cols " + short_text(wanted) +
               "; expected as many as these say");
  }

  void gather(const TextNode& node, std::string_view key, const std::string& meaning,
              std::vector<double>& values) const {
    if (node.kind == TextNode::Kind::kMap) fail(node, key, "is not a list of numbers; expected " + meaning);
    if (node.kind == TextNode::Kind::kList)
      for (const TextNode& item : node.items) gather(item, key, meaning, values);
    if (node.kind != TextNode::Kind::kScalar) return;
    TextNode cell = node;
    for (std::size_t at = node.text.find_first_not_of(" \t"); at != std::string::npos;) {
      const std::size_t end = std::min(node.text.find_first_of(" \t", at), node.text.size());
      cell.text = node.text.substr(at, end - at);
      values.push_back(number(cell, key, meaning));
      at = node.text.find_first_not_of(" \t", end);
    }
  }

  const TextNode& map_;
  std::string file_, where_;
};

}  // namespace detail
}  // namespace sslam
