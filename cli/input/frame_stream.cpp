// SPDX-License-Identifier: BSD-3-Clause
#include "cli/input/frame_stream.hpp"

#include <algorithm>
#include <utility>

#include "cli/shell/interrupt.hpp"

namespace sslam::cli {

FrameStream::FrameStream(const io::Dataset& dataset, System& system, double pace, MaskSource masks)
    : dataset_(dataset),
      system_(system),
      pace_(pace),
      reader_(dataset, {system.settings().camera.width, system.settings().camera.height}),
      masks_(std::move(masks)) {
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
  return true;
}

void FrameStream::produce() {
  try {
    for (const io::FrameEntry& entry : dataset_.frames) {
      ExtractedFrame frame;
      {
        std::unique_lock lock(mutex_);
        changed_.wait(lock, [&] { return ready_.size() < kAhead || stop_; });
        if (stop_ || !wait_until_due(lock, entry)) return;
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

// A frame that finds no room comes late: none is dropped. False: the stream is to stop.
bool FrameStream::wait_until_due(std::unique_lock<std::mutex>& lock, const io::FrameEntry& entry) {
  if (pace_ == 0) return true;
  constexpr double kLongest = 1e9;  // 30 years: the clock's own unit cannot count all stamps
  const double since = std::min((entry.stamp - dataset_.frames.front().stamp) * pace_, kLongest);
  const auto due = start_ + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(since));
  return !changed_.wait_until(lock, due, [&] { return stop_; });
}

void FrameStream::fill(const io::FrameEntry& entry, ExtractedFrame& out) {
  out.label = reader_.label(entry);
  out.warning.clear();
  ImageInput input;
  input.index = entry.index;
  input.stamp = entry.stamp;
  input.name = reader_.stem(entry);
  std::string why;
  input.image = reader_.read(entry, why);
  if (!input.image.empty()) {
    read_depth(entry, input, out);
    std::string maskless;
    input.mask = masks_.of(input.name, maskless);
    if (!maskless.empty()) out.warning = maskless + "; all of the frame is used";
  }
  system_.extract(input, out);
  if (!out.usable()) {
    if (why.empty()) why = entry.image + ": " + name(out.report.image);
    out.warning = why + "; frame skipped";
    return;
  }
  if (out.warning.empty()) out.warning = normals_warning(entry, out.report.normals);
}

// Empty: nothing to tell. A view without planes is no fault of the input: the run's figures count it. What is
// wrong with a source as a whole is told once, and counted in the figures, too.
std::string FrameStream::normals_warning(const io::FrameEntry& entry, NormalStatus status) {
  if (status == NormalStatus::kOk || status == NormalStatus::kNoEvidence) return {};
  const bool whole = status == NormalStatus::kFacesAway || status == NormalStatus::kOutOfRange ||
                     status == NormalStatus::kTooSmall;
  if (whole && !told_.insert(status).second) return {};
  return entry.image + ": " + name(status) + "; lines alone for this frame" +
         (whole ? ", and for others like it, which metrics.json counts" : "");
}

void FrameStream::read_depth(const io::FrameEntry& entry, ImageInput& input, ExtractedFrame& out) const {
  if (entry.depth.empty() || !system_.reads_depth()) return;
  input.depth_factor = system_.settings().depth_factor;
  std::string why;
  input.depth = load_depth(entry.depth, dataset_.layout, why);
  if (input.depth.empty()) out.warning = why + "; lines alone for this frame";
}

}  // namespace sslam::cli
