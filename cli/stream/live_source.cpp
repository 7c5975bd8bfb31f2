// SPDX-License-Identifier: BSD-3-Clause
#include "cli/stream/live_source.hpp"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <exception>
#include <mutex>
#include <opencv2/imgcodecs.hpp>
#include <thread>
#include <utility>

#include "cli/input/image_file.hpp"
#include "cli/shell/exit_code.hpp"
#include "cli/shell/interrupt.hpp"
#include "cli/shell/messages.hpp"
#include "cli/stream/stamp_clock.hpp"
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

// Of the thread and its source, so that the thread can outlive the source.
struct LiveSource::Shared {
  StreamName name;
  std::string shown;  // its name, for people
  StreamOptions options;

  mutable std::mutex mutex;  // for what follows
  std::condition_variable changed;
  std::deque<SourceFrame> waiting;
  StreamFlow flow = StreamFlow::kRuns;
  StreamFigures figures;
  std::exception_ptr failure;
  bool finished = false;
  bool stop = false;

  Shared(StreamName n, const StreamOptions& o) : name(std::move(n)), shown(shown_name(name)), options(o) {}

  // The thread's own.
  std::int64_t number = 0;

  void work();
  void run();
  [[nodiscard]] std::unique_ptr<StreamReader> come_back(Patience& patience);
  // False: no further frame is wanted.
  [[nodiscard]] bool offer(StreamFrame frame, StampClock& clock, bool drop);
  [[nodiscard]] bool stopping() const {
    const std::lock_guard lock(mutex);
    return stop;
  }
};

void LiveSource::Shared::work() {
  std::exception_ptr thrown;
  std::string why;
  try {
    run();
  } catch (const std::exception& error) {
    thrown = std::current_exception();
    why = error.what();
  }
  const std::lock_guard lock(mutex);
  if (number > 0)
    figures.end += why;  // what has come is worth its files
  else
    failure = thrown;
  finished = true;
  changed.notify_all();
}

void LiveSource::Shared::run() {
  Patience patience([this] { return stopping(); });
  const bool pipe = name.kind == StreamKind::kPipe;  // its sender may take all the time
  if (!pipe) patience.allow(kSilence);
  std::unique_ptr<StreamReader> reader = open_stream(name, options.size, patience);
  {
    const std::lock_guard lock(mutex);
    flow = reader->flow();
  }
  const bool drop = flow == StreamFlow::kRuns || (flow == StreamFlow::kWaits && options.live);
  StampClock clock(drop, options.frame_rate);
  for (;;) {
    StreamFrame frame;
    while (reader->read(frame))
      if (!offer(std::move(frame), clock, drop)) return;
    reader.reset();
    if (flow != StreamFlow::kRuns || stopping()) return;
    if (number == 0) throw Error(shown + ": gives no frame");
    reader = come_back(patience);
    if (!reader) return;
    clock.reconnect();
  }
}

std::unique_ptr<StreamReader> LiveSource::Shared::come_back(Patience& patience) {
  constexpr std::chrono::milliseconds kBetween{250};
  const auto last = Clock::now() +
                    std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(options.retry));
  if (options.retry > 0)
    print_warning(shown + ": lost after frame " + std::to_string(number - 1) + "; trying again for " +
                  seconds_text(options.retry));
  while (Clock::now() < last) {
    {
      std::unique_lock lock(mutex);
      if (changed.wait_for(lock, kBetween, [this] { return stop; })) return nullptr;
    }
    const double left = std::chrono::duration<double>(last - Clock::now()).count();
    if (left <= 0) break;
    try {
      patience.allow(left);
      std::unique_ptr<StreamReader> reader = open_stream(name, options.size, patience);
      patience.allow(std::min(kSilence, options.retry));
      const std::lock_guard lock(mutex);
      ++figures.lost;
      return reader;
    } catch (const Error&) {  // not yet
    }
  }
  const std::lock_guard lock(mutex);
  if (!stop)
    figures.end = shown + ": the stream broke off after frame " + std::to_string(number - 1) +
                  (options.retry > 0 ? ", and did not come back within " + seconds_text(options.retry) : "");
  return nullptr;
}

bool LiveSource::Shared::offer(StreamFrame frame, StampClock& clock, bool drop) {
  const std::size_t room = drop ? 1 : 2;
  const io::Slice& slice = options.slice;
  SourceFrame made;
  made.entry.index = number++;
  made.entry.stamp = clock.stamp(frame.time, Clock::now());
  made.entry.image = shown;
  if (slice.end >= 0 && made.entry.index >= slice.end) return false;
  if (made.entry.index < slice.start || (made.entry.index - slice.start) % slice.stride != 0) return true;
  made.image = std::move(frame.image);
  made.file = std::move(frame.file);
  std::unique_lock lock(mutex);
  if (drop) {
    while (waiting.size() >= room) {
      waiting.pop_front();
      ++figures.dropped;
    }
  } else {
    changed.wait(lock, [&] { return waiting.size() < room || stop; });
  }
  if (stop) return false;
  waiting.push_back(std::move(made));
  changed.notify_all();
  // No need to wait for the frame behind the last.
  return slice.end < 0 || number < slice.end;
}

LiveSource::LiveSource(const StreamName& name, const StreamOptions& options)
    : shared_(std::make_shared<Shared>(name, options)) {
  std::thread([shared = shared_] { shared->work(); }).detach();
}

LiveSource::~LiveSource() {
  stop();
  // A look-up of a name, or a driver that sleeps: they hold nothing but their own.
  constexpr std::chrono::milliseconds kLongest{500};
  std::unique_lock lock(shared_->mutex);
  shared_->changed.wait_for(lock, kLongest, [this] { return shared_->finished; });
}

cv::Size LiveSource::wait_for_first() {
  constexpr std::chrono::seconds kSoon{1};
  const auto begin = Clock::now();
  bool told = false;
  SourceFrame frame;
  std::string why;
  for (;;) {
    {
      std::unique_lock lock(shared_->mutex);
      const auto there = [this] { return !shared_->waiting.empty() || shared_->finished; };
      while (!shared_->changed.wait_for(lock, Patience::kLook, there)) {
        if (Interrupt::asked()) {
          print_warning(shared_->shown + ": interrupted before the first frame; nothing was written");
          throw Stop{ExitCode::kInterrupted};
        }
        if (told || Clock::now() - begin < kSoon) continue;
        told = true;
        print_note(shared_->shown + ": waiting for the first frame");
      }
    }
    if (!take(frame)) {
      if (!why.empty()) throw Error(why + "; no other image came");
      throw Error(shared_->shown + ": ended before the first image");
    }
    if (!frame.image.empty()) break;
    if (why.empty()) why = frame.why;
  }
  const cv::Size size = frame.image.size();
  if (range_)
    print_note(shared_->shown + ": 16 bit images: values from " + range_->text() +
               ", found in the first frame, become black to white");
  first_ = std::move(frame);
  return size;
}

io::Dataset LiveSource::dataset() const {
  io::Dataset dataset;
  dataset.layout = io::Layout::kStream;
  dataset.root = shared_->shown;
  return dataset;
}

bool LiveSource::sets_the_pace() const {
  const std::lock_guard lock(shared_->mutex);
  return shared_->flow != StreamFlow::kFile;
}

bool LiveSource::next(SourceFrame& out) {
  if (!first_) return take(out);
  out = std::move(*first_);
  first_.reset();
  return true;
}

bool LiveSource::take(SourceFrame& out) {
  {
    Shared& s = *shared_;
    std::unique_lock lock(s.mutex);
    s.changed.wait(lock, [&] { return !s.waiting.empty() || s.finished || s.stop; });
    if (s.stop) return false;
    if (s.waiting.empty()) {
      if (s.failure) std::rethrow_exception(s.failure);
      return false;
    }
    out = std::move(s.waiting.front());
    s.waiting.pop_front();
    s.changed.notify_all();
  }
  decode(out);
  return true;
}

void LiveSource::decode(SourceFrame& frame) {
  const std::string label = shared_->shown + " frame " + std::to_string(frame.entry.index);
  if (!frame.file.empty()) {
    const ImageHeader header = read_image_header(frame.file);
    const bool plain = header.turn == kUpright;
    if (is_too_large(header, {})) {
      frame.why = label + ": claims more pixels than any camera has";
    } else if (!header.complete) {
      frame.why = label + ": truncated image";
    } else {
      frame.image =
          decode_image(label, frame.file, header, cv::IMREAD_COLOR | cv::IMREAD_ANYDEPTH, frame.why);
    }
    // Who reads a file that asks to be turned may turn it.
    if (!plain) frame.file.clear();
  }
  if (frame.image.depth() == CV_16U) {
    if (!range_) {
      range_.emplace();
      range_->add(frame.image);
      range_->settle();
    }
    frame.image = range_->apply(frame.image);
    frame.file.clear();  // its range would be found anew
  } else if (frame.image.depth() != CV_8U) {
    frame.why = label + ": has pixels of neither 8 nor 16 bit";
    frame.image.release();
  }
  if (frame.image.empty() && frame.why.empty()) frame.why = label + ": cannot decode this frame";
}

void LiveSource::stop() {
  const std::lock_guard lock(shared_->mutex);
  shared_->stop = true;
  shared_->changed.notify_all();
}

StreamFigures LiveSource::figures() const {
  const std::lock_guard lock(shared_->mutex);
  return shared_->figures;
}

}  // namespace sslam::cli
