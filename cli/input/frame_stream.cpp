// SPDX-License-Identifier: BSD-3-Clause
#include "cli/input/frame_stream.hpp"

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "cli/input/masked_image.hpp"
#include "cli/input/size_text.hpp"
#include "cli/shell/interrupt.hpp"

namespace sslam::cli {

FrameStream::FrameStream(io::Dataset& dataset, System& system, FrameStreamOptions options)
    : dataset_(dataset),
      system_(system),
      options_(std::move(options)),
      reader_(dataset, {system.settings().camera.width, system.settings().camera.height}),
      ahead_(options_.source != nullptr ? 1 : 3) {  // what waits is old when it is tracked
  producer_ = std::thread([this] { produce(); });
}

FrameStream::~FrameStream() {
  stop();
  producer_.join();
}

void FrameStream::stop() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  changed_.notify_all();
  if (options_.source != nullptr) options_.source->stop();
}

bool FrameStream::next(ExtractedFrame& out) {
  std::unique_lock lock(mutex_);
  // A signal handler may not notify: it is asked often enough that nobody notices.
  constexpr std::chrono::milliseconds kLook{50};
  while (!changed_.wait_for(lock, kLook, [&] { return !ready_.empty() || finished_; }))
    if (Interrupt::asked()) return false;
  if (ready_.empty()) {
    if (failure_) std::rethrow_exception(failure_);
    return false;
  }
  std::swap(out, ready_.front());
  spare_.push_back(std::move(ready_.front()));
  ready_.pop_front();
  changed_.notify_all();
  if (options_.source != nullptr) dataset_.frames.push_back(out.entry);
  return true;
}

void FrameStream::produce() {
  try {
    if (options_.source != nullptr) {
      produce_from_source();
    } else {
      for (std::size_t i = options_.first; i < dataset_.frames.size(); ++i) {
        SourceFrame frame;
        frame.entry = dataset_.frames[i];
        if (!deliver(frame)) break;
      }
    }
  } catch (...) {
    failure_ = std::current_exception();
  }
  const std::lock_guard lock(mutex_);
  finished_ = true;
  changed_.notify_all();
}

// The newest frame is taken when there is room for it, not before.
void FrameStream::produce_from_source() {
  const auto has_room = [this] {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return ready_.size() < ahead_ || stop_; });
    return !stop_;
  };
  SourceFrame frame;
  while (has_room() && options_.source->next(frame) && deliver(frame)) frame = {};
}

// False: the stream is to stop.
bool FrameStream::deliver(SourceFrame& frame) {
  ExtractedFrame extracted;
  {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return ready_.size() < ahead_ || stop_; });
    if (stop_ || !wait_until_due(lock, frame.entry)) return false;
    if (!spare_.empty()) {
      extracted = std::move(spare_.back());
      spare_.pop_back();
    }
  }
  fill(frame, extracted);
  const std::lock_guard lock(mutex_);
  ready_.push_back(std::move(extracted));
  changed_.notify_all();
  return true;
}

// A frame that finds no room comes late: none is dropped. False: the stream is to stop.
bool FrameStream::wait_until_due(std::unique_lock<std::mutex>& lock, const io::FrameEntry& entry) {
  if (options_.pace == 0) return true;
  if (!first_stamp_) first_stamp_ = entry.stamp;
  constexpr double kLongest = 1e9;  // 30 years: the clock's own unit cannot count all stamps
  const double since = std::min((entry.stamp - *first_stamp_) * options_.pace, kLongest);
  const auto due = start_ + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(since));
  return !changed_.wait_until(lock, due, [&] { return stop_; });
}

// A source's frame has been decoded already.
void FrameStream::read(SourceFrame& frame) {
  if (options_.source == nullptr) {
    frame.image = reader_.read(frame.entry, frame.why);
    return;
  }
  const Camera<double>& camera = system_.settings().camera;
  const cv::Size expected(camera.width, camera.height);
  if (frame.image.empty() || frame.image.size() == expected) return;
  frame.why = wrong_size(reader_.label(frame.entry), frame.image.size(), expected);
  frame.image.release();
}

void FrameStream::fill(SourceFrame& frame, ExtractedFrame& out) {
  const io::FrameEntry& entry = frame.entry;
  out.entry = entry;
  out.label = reader_.label(entry);
  out.warning.clear();
  ImageInput input;
  input.index = entry.index;
  input.stamp = entry.stamp;
  input.name = reader_.stem(entry);
  read(frame);
  input.image = frame.image;
  if (!input.image.empty()) {
    read_depth(entry, input, out);
    std::string maskless;
    mask_and_straighten(options_.masks, options_.view, input, maskless);  // depth of wide lenses is refused
    if (!maskless.empty()) out.warning = maskless + "; all of the frame is used";
    if (options_.recording != nullptr)
      options_.recording->add(entry.stamp * dataset_.seconds_per_stamp, frame, out.warning);
  }
  system_.extract(input, out);
  if (!out.usable()) {
    if (frame.why.empty()) frame.why = entry.image + ": " + name(out.report.image);
    out.warning = frame.why + "; frame skipped";
  }
}

std::string FrameStream::fault_of_normals(const ExtractedFrame& frame) {
  const NormalStatus status = frame.report.normals;
  if (!frame.warning.empty() || status == NormalStatus::kOk || status == NormalStatus::kNoEvidence) return {};
  const bool whole = status == NormalStatus::kFacesAway || status == NormalStatus::kOutOfRange ||
                     status == NormalStatus::kTooSmall;
  if (whole && !told_.insert(status).second) return {};
  return frame.entry.image + ": " + name(status) + "; lines alone for this frame" +
         (whole ? ", and for others like it, which metrics.json counts" : "");
}

void FrameStream::read_depth(const io::FrameEntry& entry, ImageInput& input, ExtractedFrame& out) {
  if (entry.depth.empty() || !system_.reads_depth()) return;
  input.depth_factor = system_.settings().depth_factor;
  std::string why;
  input.depth = reader_.read_depth(entry, why);
  // ScanNet's depth has fewer pixels, and another ratio of its sides by half a percent.
  if (dataset_.layout == io::Layout::kScanNet && !input.depth.empty())
    cv::resize(input.depth, input.depth, input.image.size(), 0, 0, cv::INTER_NEAREST);
  if (input.depth.empty()) out.warning = why + "; lines alone for this frame";
}

}  // namespace sslam::cli
