// SPDX-License-Identifier: BSD-3-Clause
#include "cli/input/open_images.hpp"

#include <cstdint>
#include <string>
#include <vector>

#include "cli/input/bag_reader.hpp"
#include "cli/input/image_file.hpp"
#include "sslam/io/datasets/open_dataset.hpp"
#include "sslam/io/files/video_content.hpp"

namespace sslam::cli {
namespace {

// Whether a file with the name of an image is read as a video: a PNG with frames. Throws Error for what holds
// several images and is not.
bool is_video_of_images(const std::filesystem::path& path) {
  std::error_code ignored;
  std::vector<std::uint8_t> bytes;
  ImageHeader header;
  std::string why;
  if (!io::is_image_name(path) || !std::filesystem::is_regular_file(path, ignored) ||
      !open_image(path, bytes, header, why) || !header.several)
    return false;
  if (header.format == ImageFormat::kPng) return true;
  throw Error(path.string() + ": holds several images, which are not read as a video; " + kTakeApart);
}

// A photo that is named as a video. Bare MJPEG, too, begins as a JPEG, and goes on behind its end.
void refuse_named_photo(const std::filesystem::path& path) {
  std::error_code ignored;
  if (!io::is_video_name(path) || !std::filesystem::is_regular_file(path, ignored)) return;
  constexpr std::size_t kHead = 4096;
  const std::string head = io::first_bytes(path, kHead);
  std::vector<std::uint8_t> bytes(head.begin(), head.end());
  ImageHeader header = read_image_header(bytes);
  std::string why;
  if (header.format == ImageFormat::kOther || !open_image(path, bytes, header, why) || header.several ||
      (header.end > 0 && header.end < bytes.size()))
    return;
  throw Error(path.string() +
              ": is one image, whatever its name says; a run needs a video, or a folder of images");
}

}  // namespace

std::filesystem::path folder_of(const std::filesystem::path& file) {
  return file.has_parent_path() ? file.parent_path() : std::filesystem::path(".");
}

io::Dataset dataset_at(const std::filesystem::path& path) {
  return io::open_dataset(path);
}

std::string_view layout_name(io::Layout layout) {
  return io::name(layout);
}

io::Dataset open_frames(const std::filesystem::path& path, const io::OpenOptions& options,
                        const io::BagTopics& topics, std::int64_t at_most) {
  refuse_named_photo(path);
  io::Dataset dataset = is_video_of_images(path) ? io::read_video(path) : io::open_dataset(path, options);
  const bool bag = dataset.layout == io::Layout::kBag;
  if (!bag && !(topics.images.empty() && topics.depth.empty()))
    throw Error(path.string() + ": is no bag, so it has no topics; leave --topic and --depth-topic out");
  if (bag) list_bag_frames(dataset, topics);
  if (dataset.layout == io::Layout::kVideo) {
    list_video_frames(dataset, at_most);
    io::complete_stray_scan(dataset);
  }
  return dataset;
}

io::Dataset open_images(const std::filesystem::path& path, const io::BagTopics& topics) {
  std::error_code ignored;
  if (std::filesystem::is_regular_file(path, ignored)) {
    const bool video = io::is_video_file(path);
    if (!video && io::is_image_name(path))
      return io::frames_from_images(folder_of(path), {path}, io::kDefaultFrameRate);
    if (!video && !io::is_bag_name(path))
      throw Error(
          path.string() +
          ": is neither an image (png, jpg, ...) nor a video (mp4, avi, ...) nor a bag (bag, mcap, db3)");
  }
  return open_frames(path, {}, topics);
}

}  // namespace sslam::cli
