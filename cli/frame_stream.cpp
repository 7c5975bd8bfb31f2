// SPDX-License-Identifier: BSD-3-Clause
#include "cli/frame_stream.hpp"

#include <opencv2/imgcodecs.hpp>
#include <utility>

#include "cli/image_file.hpp"

namespace sslam::cli {

FrameStream::FrameStream(const io::Dataset& dataset, StreamSettings settings)
    : dataset_(dataset), settings_(std::move(settings)) {
  frontend_.camera = settings_.camera;
  frontend_.normals = std::move(settings_.normals);
  if (dataset_.layout == io::Layout::kVideo) video_.open(dataset_.root.string());
  producer_ = std::thread([this] { produce(); });
}

FrameStream::~FrameStream() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  changed_.notify_all();
  producer_.join();
}

bool FrameStream::next(ExtractedFrame& out) {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return !ready_.empty() || finished_; });
  if (ready_.empty()) {
    if (failure_) std::rethrow_exception(failure_);
    return false;
  }
  std::swap(out, ready_.front());
  spare_.push_back(std::move(ready_.front()));
  ready_.pop_front();
  changed_.notify_all();
  return true;
}

void FrameStream::produce() {
  try {
    for (const io::FrameEntry& entry : dataset_.frames) {
      ExtractedFrame frame;
      {
        std::unique_lock lock(mutex_);
        changed_.wait(lock, [&] { return ready_.size() < kAhead || stop_; });
        if (stop_) return;
        if (!spare_.empty()) {
          frame = std::move(spare_.back());
          spare_.pop_back();
        }
      }
      fill(entry, frame);
      const std::lock_guard lock(mutex_);
      ready_.push_back(std::move(frame));
      changed_.notify_all();
    }
  } catch (...) {
    failure_ = std::current_exception();
  }
  const std::lock_guard lock(mutex_);
  finished_ = true;
  changed_.notify_all();
}

void FrameStream::fill(const io::FrameEntry& entry, ExtractedFrame& out) {
  out.image = entry.image.filename().string();
  if (dataset_.layout == io::Layout::kVideo) out.image += " frame " + std::to_string(entry.index);
  out.warning.clear();
  ImageInput input;
  input.index = entry.index;
  input.stamp = entry.stamp;
  input.name = entry.image.stem().string();
  std::string why;
  input.image = decode(entry, why);
  if (!input.image.empty()) read_depth(entry, input, out);
  out.report = frontend_.process(input, out.frame);
  out.usable = out.report.image == ImageStatus::kOk;
  if (!out.usable) {
    if (why.empty()) why = entry.image.string() + ": " + name(out.report.image);
    out.warning = why + "; frame skipped";
    return;
  }
  if (!settings_.use_points) out.frame.points.clear();
  if (!settings_.use_lines) out.frame.lines.clear();
  if (out.report.normals != NormalStatus::kOk && out.warning.empty())
    out.warning = entry.image.string() + ": " + name(out.report.normals) + "; lines alone for this frame";
}

cv::Mat FrameStream::decode(const io::FrameEntry& entry, std::string& why) {
  if (dataset_.layout != io::Layout::kVideo) return load_image(entry.image, cv::IMREAD_COLOR, why);
  cv::Mat image;
  while (next_video_frame_ < entry.index && video_.grab()) ++next_video_frame_;
  if (next_video_frame_ == entry.index && video_.read(image)) ++next_video_frame_;
  return image;
}

void FrameStream::read_depth(const io::FrameEntry& entry, ImageInput& input, ExtractedFrame& out) const {
  if (entry.depth.empty() || !std::holds_alternative<DepthNormals>(frontend_.normals.source)) return;
  input.depth_factor = settings_.depth_factor;
  std::string why;
  input.depth = load_depth(entry.depth, dataset_.layout, why);
  if (input.depth.empty()) out.warning = why + "; lines alone for this frame";
}

}  // namespace sslam::cli
