// SPDX-License-Identifier: BSD-3-Clause
#include "cli/input/frame_reader.hpp"

#include <algorithm>
#include <cstdio>
#include <opencv2/imgcodecs.hpp>
#include <vector>

#include "cli/input/image_file.hpp"
#include "cli/input/size_text.hpp"

namespace sslam::cli {

std::string video_frame_stem(const std::filesystem::path& video, std::int64_t index) {
  char number[32];
  std::snprintf(number, sizeof number, "_%06lld", static_cast<long long>(index));
  return video.stem().string() + number;
}

ImageTurn turn_for_camera(cv::Size stored, ImageTurn turn, cv::Size camera, bool video) {
  if (turn == kUpright || camera.empty()) return turn;
  const cv::Size upright = turned_size(stored, turn);
  if (stored == camera && upright == camera) return video ? turn : kUpright;
  return upright == camera ? turn : kUpright;
}

FrameReader::FrameReader(const io::Dataset& dataset, cv::Size camera) : dataset_(dataset), camera_(camera) {
  if (dataset_.layout == io::Layout::kVideo) video_ = std::make_unique<VideoReader>(dataset_.root);
  if (!dataset_.bag) return;
  images_.emplace(*dataset_.bag, dataset_.bag->images);
  depths_.emplace(*dataset_.bag, dataset_.bag->depth);
}

cv::Mat FrameReader::read(const io::FrameEntry& entry, std::string& why) {
  cv::Mat image = is_video() ? read_video(entry, why) : read_still(entry, why);
  if (image.empty() || camera_.empty() || image.size() == camera_) return image;
  why = wrong_size(entry.image, image.size(), camera_);
  return {};
}

cv::Mat FrameReader::read_depth(const io::FrameEntry& entry, std::string& why) {
  cv::Mat depth = depths_ ? depths_->depth(entry.index, label(entry), why)
                          : load_depth(entry.depth, dataset_.layout, why);
  if (depth.empty() || depth.type() == CV_16UC1 || depth.type() == CV_32FC1) return depth;
  why = entry.depth + ": is no depth image, with " + std::to_string(depth.channels()) + " channels of " +
        std::to_string(8 * depth.elemSize1()) + " bit; expected one of 16 bit, or of floats in metres";
  return {};
}

// As stored, of 8 or 16 bit; `turn`: what is to be done with it.
cv::Mat FrameReader::load(const io::FrameEntry& entry, ImageTurn& turn, std::string& why) {
  turn = kUpright;
  if (images_) return images_->image(entry.index, label(entry), camera_, why);
  std::vector<std::uint8_t> bytes;
  ImageHeader header;
  if (!open_image(entry.image, bytes, header, why, camera_)) return {};
  turn = turn_for_camera(header.size, header.turn, camera_, false);
  const cv::Size size = turned_size(header.size, turn);
  if (!camera_.empty() && !size.empty() && size != camera_) {  // not worth decoding
    why = wrong_size(entry.image, size, camera_);
    return {};
  }
  return decode_image(entry.image, bytes, header, cv::IMREAD_COLOR | cv::IMREAD_ANYDEPTH, why);
}

cv::Mat FrameReader::read_still(const io::FrameEntry& entry, std::string& why) {
  ImageTurn turn = kUpright;
  cv::Mat image = load(entry, turn, why);
  if (image.empty()) return {};
  if (image.depth() == CV_16U) {
    find_range(image);
    image = range_->apply(image);
  } else if (image.depth() != CV_8U) {
    why = entry.image + ": has pixels of neither 8 nor 16 bit";
    return {};
  }
  return turned_image(image, turn);
}

// The first frames of the dataset decide, whichever is read first, so that each has the same pixels in every
// run.
void FrameReader::find_range(const cv::Mat& read) {
  constexpr std::size_t kFrames = 8;
  if (range_) return;
  range_.emplace();
  for (std::size_t i = 0; i < std::min(kFrames, dataset_.frames.size()); ++i) {
    ImageTurn turn = kUpright;
    std::string ignored;
    const cv::Mat image = load(dataset_.frames[i], turn, ignored);
    if (image.depth() == CV_16U) range_->add(image);
  }
  if (range_->empty()) range_->add(read);
  range_->settle();
}

// Frames are found by their time where the video has times: a damaged one is missed, and the next keeps its
// own.
cv::Mat FrameReader::read_video(const io::FrameEntry& entry, std::string& why) {
  constexpr double kSameTime = 1e-6;
  for (;;) {
    if (!decoded_) {
      decoded_ = video_->advance();
      ++frame_;
    }
    if (!decoded_) break;
    double later = static_cast<double>(frame_ - entry.index);  // than the entry
    if (dataset_.video_start) {
      const std::optional<double> time = video_->time();
      later = time ? *time - *dataset_.video_start - entry.stamp : -1;
    }
    if (later > kSameTime) break;
    decoded_ = false;
    if (later < -kSameTime) continue;
    const cv::Mat stored = video_->image();
    if (stored.empty()) break;
    const ImageTurn turn = turn_for_camera(stored.size(), video_->info().turn, camera_, true);
    return turned_image(stored, turn);
  }
  why = label(entry) + ": cannot decode this frame";
  return {};
}

std::string FrameReader::label(const io::FrameEntry& entry) const {
  if (dataset_.layout == io::Layout::kStream) return entry.image + " frame " + std::to_string(entry.index);
  const std::string file = std::filesystem::path(entry.image).filename().string();
  return are_counted() ? file + " frame " + std::to_string(entry.index) : file;
}

std::string FrameReader::stem(const io::FrameEntry& entry) const {
  if (dataset_.layout == io::Layout::kStream) return video_frame_stem("stream", entry.index);
  return are_counted() ? video_frame_stem(entry.image, entry.index)
                       : std::filesystem::path(entry.image).stem().string();
}

}  // namespace sslam::cli
