// SPDX-License-Identifier: BSD-3-Clause
// A folder of images, or a glob such as DIR/left_*.png: frames in the natural order of their names.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sslam/io/datasets/dataset.hpp"
#include "sslam/io/datasets/dataset_filling.hpp"
#include "sslam/io/datasets/image_kinds.hpp"
#include "sslam/io/datasets/name_stamps.hpp"
#include "sslam/io/datasets/times_beside.hpp"
#include "sslam/io/files/files.hpp"

namespace sslam::io {

// Stamps come from the names when each is one, else from a list of times beside them, else from the position
// and the frame rate.
[[nodiscard]] inline Dataset frames_from_images(const std::filesystem::path& root,
                                                const std::vector<std::filesystem::path>& images,
                                                double frame_rate) {
  Dataset dataset;
  dataset.layout = Layout::kImages;
  dataset.root = root;
  NameStamps named = stamps_of_names(images);
  if (const auto times = images.size() > 1 && named.seconds.empty()
                             ? find_times_beside(images.front().parent_path())
                             : std::filesystem::path();
      !times.empty()) {
    named.seconds = read_times_beside(times, images, dataset.warnings);
    if (!named.seconds.empty()) named.note.clear();
  }
  const bool counted = named.seconds.empty();
  if (!named.note.empty() && images.size() > 1)  // one image alone needs no clock
    dataset.warnings.push_back(root.string() + ": " + named.note +
                               (counted ? ": images are counted, at the frame rate" : ""));
  for (std::size_t i = 0; i < images.size(); ++i) {
    FrameEntry frame;
    frame.image = images[i].string();
    frame.stamp = counted ? static_cast<double>(i) / frame_rate : named.seconds[i];
    dataset.frames.push_back(std::move(frame));
  }
  drop_bad_frames(dataset, root);
  return dataset;
}

// A folder with images/ and their times beside it, as of TUM's monocular recordings.
[[nodiscard]] inline bool is_timed_folder(const std::filesystem::path& root) {
  return !list_files(root / "images", is_image_name).empty() && !find_times_beside(root / "images").empty();
}

[[nodiscard]] inline bool is_image_folder(const std::filesystem::path& root) {
  return !list_files(root, is_image_name).empty();
}

[[nodiscard]] inline Dataset read_image_folder(const std::filesystem::path& root,
                                               double frame_rate = kDefaultFrameRate) {
  const std::vector<std::filesystem::path> images = list_files(root, is_image_name);
  if (images.empty()) throw Error(root.string() + ": holds no image (png, jpg, bmp, ppm, pgm, tif, webp)");
  if (const std::string kinds = image_kinds(images); !kinds.empty())
    throw Error(root.string() + ": holds images of several kinds side by side; say which are meant, as in '" +
                (root / "NAMES").string() + "' with NAMES one of " + kinds);
  return frames_from_images(root, images, frame_rate);
}

// images/ with its times, and the ground truth beside it, whose poses may not be those of all frames.
[[nodiscard]] inline Dataset read_timed_folder(const std::filesystem::path& root,
                                               double frame_rate = kDefaultFrameRate) {
  Dataset dataset = read_image_folder(root / "images", frame_rate);
  dataset.layout = Layout::kTimedImages;
  dataset.root = root;
  const auto truth = first_file({root / "groundtruthSync.txt", root / "groundtruth.txt"});
  if (!truth.empty()) attach_truth_file(dataset, truth);
  return dataset;
}

// A number as FFmpeg and OpenCV name it in a sequence of images: img_%06d.png.
struct NumberPattern {
  std::string before, after;
  std::size_t width = 0;  // digits at least

  [[nodiscard]] bool matches(std::string_view name) const {
    if (name.size() <= before.size() + after.size() || !name.starts_with(before) || !name.ends_with(after))
      return false;
    const std::string_view number = name.substr(before.size(), name.size() - before.size() - after.size());
    return all_digits(number) && number.size() >= width &&
           (number.size() == width || number[0] != '0' || number.size() == 1);
  }
};

[[nodiscard]] inline std::optional<NumberPattern> number_pattern(const std::string& name) {
  const std::size_t at = name.find('%');
  const std::size_t end = at == std::string::npos ? at : name.find_first_not_of("0123456789", at + 1);
  if (end == std::string::npos || (name[end] != 'd' && name[end] != 'u' && name[end] != 'i'))
    return std::nullopt;
  const std::string digits = name.substr(at + 1, end - at - 1);
  const auto width = digits.empty() ? std::optional<std::size_t>(0) : parse_number<std::size_t>(digits);
  if (!width) return std::nullopt;
  return NumberPattern{name.substr(0, at), name.substr(end + 1), *width};
}

// The images whose names fit the pattern in the last part of the path.
[[nodiscard]] inline Dataset read_numbered_images(const std::filesystem::path& path,
                                                  const NumberPattern& pattern,
                                                  double frame_rate = kDefaultFrameRate) {
  const std::filesystem::path root = path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
  const std::vector<std::filesystem::path> images =
      list_files(root, [&pattern](const std::filesystem::path& name) {
        return is_image_name(name) && pattern.matches(name.string());
      });
  if (images.empty()) throw Error(path.string() + ": no image matches");
  return frames_from_images(root, images, frame_rate);
}

// Wildcards * and ? in the last part of the path.
[[nodiscard]] inline Dataset read_image_glob(const std::filesystem::path& glob,
                                             double frame_rate = kDefaultFrameRate) {
  const std::filesystem::path root = glob.has_parent_path() ? glob.parent_path() : std::filesystem::path(".");
  if (has_wildcards(root.string()))
    throw Error(glob.string() + ": wildcards are understood in the last part of the path only");
  const std::string pattern = glob.filename().string();
  const std::vector<std::filesystem::path> images =
      list_files(root, [&pattern](const std::filesystem::path& name) {
        return is_image_name(name) && matches_wildcards(name.string(), pattern);
      });
  if (images.empty()) throw Error(glob.string() + ": no image matches");
  return frames_from_images(root, images, frame_rate);
}

}  // namespace sslam::io
