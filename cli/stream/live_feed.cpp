// SPDX-License-Identifier: BSD-3-Clause
#include "cli/stream/live_feed.hpp"

#include <algorithm>
#include <cstdio>
#include <utility>

#include "cli/shell/messages.hpp"
#include "sslam/core/error.hpp"

namespace sslam::cli {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double kSilence = 10;  // seconds without a frame after which a stream in the network is lost

std::string seconds_text(double seconds) {
  char text[32];
  std::snprintf(text, sizeof text, "%g s", seconds);
  return text;
}

}  // namespace

LiveFeed::LiveFeed(StreamName name, const StreamOptions& options)
    : name_(std::move(name)), shown_(shown_name(name_)), options_(options) {}

void LiveFeed::work() {
  std::exception_ptr thrown;
  std::string why;
  try {
    run();
  } catch (const std::exception& error) {
    thrown = std::current_exception();
    why = error.what();
  }
  const std::lock_guard lock(mutex_);
  if (number_ > 0)
    figures_.end += why;  // what has come is worth its files
  else
    failure_ = thrown;
  finished_ = true;
  changed_.notify_all();
}

void LiveFeed::run() {
  Patience patience([this] { return stopping(); });
  const bool pipe = name_.kind == StreamKind::kPipe;  // its sender may take all the time
  if (!pipe) patience.allow(kSilence);
  std::unique_ptr<StreamReader> reader = open_stream(name_, options_.size, patience);
  {
    const std::lock_guard lock(mutex_);
    flow_ = reader->flow();
  }
  const bool drop = flow_ == StreamFlow::kRuns || (flow_ == StreamFlow::kWaits && options_.live);
  StampClock clock(drop, options_.frame_rate);
  for (;;) {
    StreamFrame frame;
    while (reader->read(frame))
      if (!offer(std::move(frame), clock, drop)) return;
    const std::string trouble = reader->trouble();
    const std::string why = trouble.empty() ? "" : " (" + trouble + ")";
    reader.reset();
    if (stopping()) return;
    if (number_ == 0 && flow_ != StreamFlow::kWaits) throw Error(shown_ + ": gives no frame" + why);
    if (flow_ == StreamFlow::kFile && !trouble.empty()) {
      const std::lock_guard lock(mutex_);
      figures_.end = shown_ + ": the video broke off after frame " + std::to_string(number_ - 1) + why +
                     "; the rest is missing";
    }
    if (flow_ != StreamFlow::kRuns) return;
    reader = come_back(patience, why);
    if (!reader) return;
    clock.reconnect();
  }
}

std::unique_ptr<StreamReader> LiveFeed::come_back(Patience& patience, const std::string& why) {
  constexpr std::chrono::milliseconds kBetween{250};
  const auto last = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                       std::chrono::duration<double>(options_.retry));
  if (options_.retry > 0)
    print_warning(shown_ + ": lost after frame " + std::to_string(number_ - 1) + why + "; trying again for " +
                  seconds_text(options_.retry));
  while (Clock::now() < last) {
    {
      std::unique_lock lock(mutex_);
      if (changed_.wait_for(lock, kBetween, [this] { return stop_; })) return nullptr;
    }
    const double left = std::chrono::duration<double>(last - Clock::now()).count();
    if (left <= 0) break;
    try {
      patience.allow(left);
      std::unique_ptr<StreamReader> reader = open_stream(name_, options_.size, patience);
      patience.allow(std::min(kSilence, options_.retry));
      const std::lock_guard lock(mutex_);
      ++figures_.lost;
      return reader;
    } catch (const Error&) {  // not yet
    }
  }
  const std::lock_guard lock(mutex_);
  if (!stop_)
    figures_.end =
        shown_ + ": the stream broke off after frame " + std::to_string(number_ - 1) + why +
        (options_.retry > 0 ? ", and did not come back within " + seconds_text(options_.retry) : "");
  return nullptr;
}

bool LiveFeed::offer(StreamFrame frame, StampClock& clock, bool drop) {
  const std::size_t room = drop ? 1 : 2;
  const io::Slice& slice = options_.slice;
  SourceFrame made;
  made.entry.index = number_++;
  made.entry.stamp = clock.stamp(frame.time, Clock::now());
  made.entry.image = shown_;
  if (slice.end >= 0 && made.entry.index >= slice.end) return false;
  if (made.entry.index < slice.start || (made.entry.index - slice.start) % slice.stride != 0) return true;
  made.image = std::move(frame.image);
  made.file = std::move(frame.file);
  std::unique_lock lock(mutex_);
  if (drop) {
    while (waiting_.size() >= room) {
      waiting_.pop_front();
      ++figures_.dropped;
    }
  } else {
    changed_.wait(lock, [&] { return waiting_.size() < room || stop_; });
  }
  if (stop_) return false;
  waiting_.push_back(std::move(made));
  changed_.notify_all();
  // No need to wait for the frame behind the last.
  return slice.end < 0 || number_ < slice.end;
}

bool LiveFeed::stopping() const {
  const std::lock_guard lock(mutex_);
  return stop_;
}

StreamFlow LiveFeed::flow() const {
  const std::lock_guard lock(mutex_);
  return flow_;
}

StreamFigures LiveFeed::figures() const {
  const std::lock_guard lock(mutex_);
  return figures_;
}

bool LiveFeed::wait_for_frame(std::chrono::milliseconds longest) {
  std::unique_lock lock(mutex_);
  return changed_.wait_for(lock, longest, [this] { return !waiting_.empty() || finished_; });
}

bool LiveFeed::take(SourceFrame& out) {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return !waiting_.empty() || finished_ || stop_; });
  if (stop_) return false;
  if (waiting_.empty()) {
    if (failure_) std::rethrow_exception(failure_);
    return false;
  }
  out = std::move(waiting_.front());
  waiting_.pop_front();
  changed_.notify_all();
  return true;
}

void LiveFeed::stop() {
  const std::lock_guard lock(mutex_);
  stop_ = true;
  changed_.notify_all();
}

void LiveFeed::wait_for_end(std::chrono::milliseconds longest) {
  std::unique_lock lock(mutex_);
  changed_.wait_for(lock, longest, [this] { return finished_; });
}

}  // namespace sslam::cli
