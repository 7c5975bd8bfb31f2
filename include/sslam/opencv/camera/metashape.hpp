// SPDX-License-Identifier: BSD-3-Clause
// Calibrations of Agisoft Metashape in XML: "Export calibration" in its own format, or all cameras.
#pragma once

#include <cmath>
#include <string>
#include <string_view>

#include "sslam/opencv/camera/photo_cameras.hpp"

namespace sslam {
namespace detail {

// The calibration element of Metashape, the adjusted one where there are two; empty: none.
[[nodiscard]] inline std::string_view metashape_element(std::string_view xml) noexcept {
  std::string_view found;
  for (std::size_t at = xml.find("<calibration"); at != std::string_view::npos;
       at = xml.find("<calibration", at + 1)) {
    const std::size_t end = xml.find("</calibration>", at);
    if (end == std::string_view::npos) break;
    const std::string_view element = xml.substr(at, end - at);
    const bool adjusted = element.substr(0, element.find('>')).find("\"adjusted\"") != std::string_view::npos;
    if (found.empty() || adjusted) found = element;
    if (adjusted) break;
  }
  return found.find("<f>") != std::string_view::npos || found.find("<fx>") != std::string_view::npos
             ? found
             : std::string_view{};
}

// <name>value</name> of the element as a map, with width and height of <resolution width="" height=""/>.
[[nodiscard]] inline TextNode metashape_values(std::string_view element) {
  TextNode map;
  map.kind = TextNode::Kind::kMap;
  const auto put = [&map](std::string_view key, std::string_view value) {
    if (map.has(key)) return;
    TextNode node;
    node.kind = TextNode::Kind::kScalar;
    node.text = value.substr(std::min(value.find_first_not_of(" \t\n"), value.size()));
    node.text.erase(node.text.find_last_not_of(" \t\n") + 1);
    map.keys.emplace_back(key);
    map.items.push_back(std::move(node));
  };
  for (std::size_t at = element.find('<'); at != std::string_view::npos; at = element.find('<', at + 1)) {
    const std::size_t end = element.find('>', at);
    if (end == std::string_view::npos) break;
    const std::string_view tag = element.substr(at + 1, end - at - 1);
    const std::string_view name = tag.substr(0, tag.find_first_of(" /"));
    for (const std::string_view key : {"width", "height", "type"}) {
      const std::size_t value = tag.find(" " + std::string(key) + "=\"");
      if (value == std::string_view::npos || (name != "resolution" && name != "calibration")) continue;
      const std::size_t start = value + key.size() + 3;
      put(key, tag.substr(start, tag.find('"', start) - start));
    }
    if (!name.empty() && tag.find_first_of(" /") == std::string_view::npos)
      put(name, element.substr(end + 1, element.find('<', end) - end - 1));
  }
  return map;
}

// The first pixel's centre is (0.5, 0.5), cx and cy count from the middle of the image, and p1 and p2 stand
// in the other order than OpenCV's.
[[nodiscard]] inline CameraFile read_metashape(std::string_view element, const std::string& source) {
  const TextNode map = metashape_values(element);
  const CameraKeys keys(map, source, "calibration.");
  CameraFile file;
  const std::string type = keys.text({"projection", "type"});
  if (!type.empty() && type != "frame") refuse_lens(keys, type);
  file.camera.width = keys.optional_pixels({"width"});
  file.camera.height = keys.optional_pixels({"height"});
  if (file.camera.width == 0 || file.camera.height == 0)
    keys.fail("calibration.width and height are missing; expected the size of the images");
  const double fy = keys.required_positive({"f", "fy", "fx"}, kFocal);
  const double fx =
      keys.required_positive({"f", "fx"}, kFocal) + keys.optional({"b1"}, 0, "a difference of focal lengths");
  file.camera.pinhole = {fx, fy, from_middle(keys.optional({"cx"}, 0, kCentre), file.camera.width) - 0.5,
                         from_middle(keys.optional({"cy"}, 0, kCentre), file.camera.height) - 0.5};
  constexpr double kSquare = 1e-3;  // half a pixel across an image
  if (std::abs(keys.optional({"b2", "skew"}, 0, "a skew")) > kSquare * fx)
    keys.fail("calibration.b2 is a skew, which no pinhole has here; expected 0, or " + std::string(kWayOut));
  for (const std::string_view key : {"k4", "p3", "p4"})
    if (keys.optional({key}, 0, kCoefficient) != 0)
      keys.fail("calibration." + std::string(key) +
                " is no coefficient that is known here; expected k1 k2 k3 p1 p2: calibrate without it, or " +
                kWayOut);
  set_lens(keys, "radtan", named_values(keys, {"k1", "k2", "p2", "p1", "k3"}), file);
  return file;
}

}  // namespace detail
}  // namespace sslam
