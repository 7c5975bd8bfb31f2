// SPDX-License-Identifier: BSD-3-Clause
#include "cli/input/image_file.hpp"

#include <fstream>
#include <string_view>
#include <system_error>

#include "cli/input/image_limit.hpp"
#include "cli/input/quiet_decoders.hpp"
#include "cli/input/size_text.hpp"
#include "cli/input/video_reader.hpp"
#include "sslam/io/datasets/video.hpp"

namespace sslam::cli {

namespace fs = std::filesystem;

bool is_too_large(const ImageHeader& header, cv::Size expected) {
  return header.size != expected &&
         static_cast<std::int64_t>(header.size.width) * header.size.height > kMostPixels;
}

bool check_image(const fs::path& name, const std::vector<std::uint8_t>& bytes, ImageHeader& header,
                 std::string& why, cv::Size expected) {
  header = read_image_header(bytes);
  if (!header.complete || bytes.empty()) {
    why = name.string() + ": truncated image";
    return false;
  }
  if (is_too_large(header, expected)) {
    why = name.string() + ": claims " + size_text(header.size) + " pixels, more than " +
          std::to_string(kMostPixels / 1'000'000) + " million; give a camera file with this size to allow it";
    return false;
  }
  return true;
}

bool open_image(const fs::path& path, std::vector<std::uint8_t>& bytes, ImageHeader& header, std::string& why,
                cv::Size expected) {
  std::error_code error;
  if (!fs::is_regular_file(path, error)) {
    why = path.string() + ": no such image";
    return false;
  }
  const std::uintmax_t size = fs::file_size(path, error);
  if (!error && size > kMostImageBytes) {
    why =
        path.string() + ": no image; its file has more than " + std::to_string(kMostImageBytes >> 20) + " MB";
    return false;
  }
  bytes.resize(error ? 0 : static_cast<std::size_t>(size));
  std::ifstream file(path, std::ios::binary);
  if (error ||
      !file.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()))) {
    why = path.string() + ": cannot read this image";
    return false;
  }
  return check_image(path, bytes, header, why, expected);
}

cv::Mat decode_image(const fs::path& path, const std::vector<std::uint8_t>& bytes, const ImageHeader& header,
                     int flags, std::string& why) {
  cv::Mat image;
  try {
    const QuietDecoders quiet;
    image =
        cv::imdecode(bytes, flags == cv::IMREAD_UNCHANGED ? flags : flags | cv::IMREAD_IGNORE_ORIENTATION);
  } catch (const cv::Exception&) {
    image.release();
  }
  if (!image.empty()) return image;
  why = path.string() + ": cannot decode this image";
  constexpr std::string_view kPointer = "version https://git-lfs";
  if (std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size()).starts_with(kPointer))
    why += ": it is a pointer of Git LFS; `git lfs pull` fetches the image";
  if (header.format == ImageFormat::kHeif) why += ": it is HEIC or AVIF; convert it to JPEG or PNG";
  if (header.several) why += std::string(": it holds several images; ") + kTakeApart;
  return image;
}

cv::Mat load_image(const fs::path& path, int flags, std::string& why) {
  std::vector<std::uint8_t> bytes;
  ImageHeader header;
  if (!open_image(path, bytes, header, why)) return {};
  return decode_image(path, bytes, header, flags, why);
}

namespace {

// What makes pixels other than a camera's: nothing is done about it.
void tell_of_pixels(io::Dataset& dataset, const VideoInfo& info) {
  const std::string file = dataset.root.string();
  char text[200];
  std::snprintf(
      text, sizeof text,
      ": its pixels are %.3g times as wide as high; `ffmpeg -i IN -vf scale=iw*sar:ih,setsar=1 OUT` "
      "makes them square",
      info.pixel_aspect);
  constexpr double kSquare = 0.005;
  if (std::abs(info.pixel_aspect - 1) > kSquare) dataset.warnings.push_back(file + text);
  std::snprintf(text, sizeof text,
                ": its tag turns it by %.3g degrees, which is no multiple of 90: the images are read as they "
                "are stored; `ffmpeg -i IN OUT` turns them",
                info.odd_turn);
  if (info.odd_turn != 0) dataset.warnings.push_back(file + text);
  if (info.interlaced)
    dataset.warnings.push_back(
        file +
        ": is interlaced: every other row shows another moment; `ffmpeg -i IN -vf yadif OUT` fixes that");
}

}  // namespace

void list_video_frames(io::Dataset& dataset, std::int64_t at_most) {
  const VideoInfo info = VideoReader(dataset.root).info();
  const VideoTimes found = read_video_times(dataset.root, at_most);
  if (found.times.empty())
    io::fill_video_frames(dataset, found.frames, info.frame_rate);
  else
    io::fill_video_frames(dataset, found.times);
  tell_of_pixels(dataset, info);
  if (found.whole && found.frames < info.claimed)
    dataset.warnings.push_back(dataset.root.string() + ": claims " + std::to_string(info.claimed) +
                               " frames; only " + std::to_string(found.frames) + " can be read");
}

}  // namespace sslam::cli
