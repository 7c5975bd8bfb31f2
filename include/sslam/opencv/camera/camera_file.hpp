// SPDX-License-Identifier: BSD-3-Clause
// Camera files of all the programs that docs/inputs.md lists.
#pragma once

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <opencv2/core.hpp>
#include <opencv2/core/persistence.hpp>
#include <string>
#include <string_view>
#include <utility>

#include "sslam/core/colmap_cameras.hpp"
#include "sslam/core/error.hpp"
#include "sslam/core/file_kind.hpp"
#include "sslam/core/plain_text.hpp"
#include "sslam/core/text_tree.hpp"
#include "sslam/opencv/camera/assigned_tree.hpp"
#include "sslam/opencv/camera/camera_rows.hpp"
#include "sslam/opencv/camera/camera_trees.hpp"
#include "sslam/opencv/camera/metashape.hpp"

namespace sslam {
namespace detail {

// A wide lens gets the plane and the size that the file has by now.
inline void complete_wide(CameraFile& read) {
  for (CameraFile& other : read.others) complete_wide(other);
  if (!read.wide) return;
  read.wide->pinhole = read.camera.pinhole;
  read.wide->width = read.camera.width;
  read.wide->height = read.camera.height;
}

// As UTF-8 with plain line ends.
[[nodiscard]] inline std::string read_camera_text(const std::filesystem::path& path) {
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) throw Error(path.string() + ": no such camera file");
  if (!std::filesystem::is_regular_file(path, ignored))
    throw Error(path.string() + ": is not a file; expected a camera file");
  constexpr std::uintmax_t kLargest = 64U << 20U;  // lists of frames with their poses may be long
  if (std::filesystem::file_size(path, ignored) > kLargest)
    throw Error(path.string() + ": is larger than 64 MiB; expected a camera file");
  std::ifstream file(path, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  if (!file) throw Error(path.string() + ": cannot open this camera file");
  if (path.filename() == "cameras.bin") {
    std::string rows;
    for (const ColmapCamera& camera : parse_colmap_binary(text, path.string())) rows += camera.row + "\n";
    return rows;
  }
  if (const std::string other = file_kind(text); !other.empty())
    throw Error(path.string() + ": " + other +
                "; expected a calibration in plain text, such as a row 'fx fy cx cy k1 k2 p1 p2 k3'");
  text = plain_text(std::move(text));
  if (text.find('\0') != std::string::npos)
    throw Error(path.string() + ": is no text; expected a camera file in plain text");
  return text;
}

// OpenCV's XML, as its calibration samples write it.
[[nodiscard]] inline TextNode tree_of(const cv::FileNode& node) {
  TextNode made;
  if (node.isMap() || node.isSeq()) {
    made.kind = node.isMap() ? TextNode::Kind::kMap : TextNode::Kind::kList;
    if (node.isMap()) made.keys = node.keys();
    for (const cv::FileNode& item : node) made.items.push_back(tree_of(item));
  } else if (!node.empty() && !node.isNone()) {
    made.kind = TextNode::Kind::kScalar;
    made.text = node.isString() ? node.string() : cv::format("%.17g", node.real());
  }
  return made;
}

// OpenCV's reader goes deeper into the stack with each element within another. Whoever counts all that begin
// need not know comments and quotes as it does, and cannot be misled by them.
[[nodiscard]] inline bool has_few_elements(std::string_view xml) noexcept {
  constexpr std::size_t kMost = 4000;
  std::size_t begun = 0;
  for (std::size_t at = xml.find('<'); at != std::string_view::npos; at = xml.find('<', at + 1))
    begun += xml.substr(at + 1).starts_with('/') ? 0 : 1;
  return begun <= kMost;
}

[[nodiscard]] inline TextNode parse_xml(const std::string& text, const std::string& file) {
  if (!has_few_elements(text))
    throw Error(file + ": has more than 4000 XML elements; expected a camera file as OpenCV writes it");
  try {
    const cv::FileStorage storage(
        text, cv::FileStorage::READ | cv::FileStorage::MEMORY | cv::FileStorage::FORMAT_XML);
    return tree_of(storage.root());
  } catch (const cv::Exception& error) {
    throw Error(file +
                ": no calibration in XML; expected that of OpenCV (<opencv_storage>) or of Metashape (" +
                "<calibration>): " + error.err.substr(0, error.err.find('\n')));
  }
}

// Of texts that calibration programs write beside the file that is to be taken: which that is; empty: another
// text.
[[nodiscard]] inline std::string other_output(std::string_view text) {
  const auto has = [text](std::string_view part) { return text.find(part) != std::string_view::npos; };
  if (has("# oST version"))
    return "is the text form (ost.txt) of ROS's calibrator; expected the ost.yaml beside it";
  if ((has("PPX:") && has("Fx:")) || (has("p[") && has("f[") && has("Brown Conrady")))
    return "is what RealSense's tools print; expected one row of text with fx fy cx cy (Fx Fy PPX PPY) of "
           "the stream";
  if (has("projection: [") && has("distortion: [") && has("+-"))
    return "is the report of Kalibr; expected the camchain.yaml beside it";
  if (has("fc = [") && has("cc = [") && has("kc = ["))
    return "is a script of MATLAB's calibration toolbox; expected one row of text with fx fy cx cy (its "
           "fc and cc) and k1 k2 p1 p2 k3 (its kc)";
  return {};
}

[[nodiscard]] inline CameraFile read_any_camera(const std::string& text, const std::string& source) {
  const auto first = text.find_first_not_of(" \t\r\n");
  if (const std::string other = other_output(text); !other.empty()) throw Error(source + ": " + other);
  try {
    if (first != std::string::npos && text[first] == '<') {
      if (const std::string_view element = metashape_element(text); !element.empty())
        return read_metashape(element, source);
      return read_camera_tree(parse_xml(text, source), source);
    }
    if (const TextNode named = named_row(text); !named.keys.empty()) return read_camera_tree(named, source);
    if (auto rows = read_camera_rows(text, source)) return *rows;
    if (const std::string row = braced_row(text); !row.empty())
      return read_camera_tree(TextTree::parse(row, source), source);
    if (is_assigned(text)) return read_camera_tree(parse_assigned(text, source), source);
    return read_camera_tree(TextTree::parse(text, source), source);
  } catch (const Error& error) {
    std::string line = error.what();  // keys and values in quotes may span lines
    std::replace(line.begin(), line.end(), '\n', ' ');
    throw Error(line);
  }
}

}  // namespace detail

// As read_camera_file, of text that is no file; `source` says where it is from.
[[nodiscard]] inline CameraFile parse_camera_text(const std::string& text, const std::string& source) {
  CameraFile read = detail::read_any_camera(text, source);
  if (!read.others.empty())
    throw Error(source + ": has several cameras: " + camera_names(read) + "; expected one: keep it alone");
  if (read.wide) throw Error(read.wide_reason);
  if (read.view_across > 0)
    throw Error(source + ": camera_angle_x without w and h; give --fov " +
                detail::short_text(read.view_across * 180 / std::numbers::pi) + " instead of this file");
  return read;
}

// As read_wide_camera_file, of text that is no file.
[[nodiscard]] inline CameraFile parse_wide_camera_text(const std::string& text, const std::string& source) {
  CameraFile read = detail::read_any_camera(text, source);
  detail::complete_wide(read);
  return read;
}

// Also of a lens that is too wide for a pinhole, `wide` of the answer, of a file that says no more than
// `view_across`, and of several cameras: `others` of the answer. Throws Error as read_camera_file.
[[nodiscard]] inline CameraFile read_wide_camera_file(const std::filesystem::path& path) {
  return parse_wide_camera_text(detail::read_camera_text(path), path.string());
}

// Throws Error, in one line, when the file cannot be read, is of no known kind, has a lens that is not near a
// radial-tangential one, or misses a key that must be there; also when a number is none, not finite or not
// positive where it must be.
[[nodiscard]] inline CameraFile read_camera_file(const std::filesystem::path& path) {
  return parse_camera_text(detail::read_camera_text(path), path.string());
}

}  // namespace sslam
