// SPDX-License-Identifier: BSD-3-Clause
#include "cli/stream/live_source.hpp"

#include <chrono>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <thread>
#include <utility>

#include "cli/input/image_file.hpp"
#include "cli/shell/exit_code.hpp"
#include "cli/shell/interrupt.hpp"
#include "cli/shell/messages.hpp"
#include "cli/stream/patience.hpp"
#include "sslam/core/error.hpp"

namespace sslam::cli {

LiveSource::LiveSource(const StreamName& name, const StreamOptions& options)
    : feed_(std::make_shared<LiveFeed>(name, options)) {
  std::thread([feed = feed_] { feed->work(); }).detach();
}

LiveSource::~LiveSource() {
  stop();
  // A look-up of a name, or a driver that sleeps: they hold nothing but their own.
  constexpr std::chrono::milliseconds kLongest{500};
  feed_->wait_for_end(kLongest);
}

cv::Size LiveSource::wait_for_first() {
  constexpr std::chrono::seconds kSoon{1};
  const auto begin = std::chrono::steady_clock::now();
  bool told = false;
  SourceFrame frame;
  std::string why;
  for (;;) {
    while (!feed_->wait_for_frame(Patience::kLook)) {
      if (Interrupt::asked()) {
        print_warning(feed_->shown() + ": interrupted before the first frame; nothing was written");
        throw Stop{ExitCode::kInterrupted};
      }
      if (told || std::chrono::steady_clock::now() - begin < kSoon) continue;
      told = true;
      print_note(feed_->shown() + ": waiting for the first frame");
    }
    if (!take(frame)) {
      if (!why.empty()) throw Error(why + "; no other image arrived");
      throw Error(feed_->shown() + ": ended before the first image");
    }
    if (!frame.image.empty()) break;
    if (why.empty()) why = frame.why;
  }
  const cv::Size size = frame.image.size();
  if (range_)
    print_note(feed_->shown() + ": 16 bit images: values from " + range_->text() +
               ", found in the first frame, are scaled to 8 bit");
  first_ = std::move(frame);
  return size;
}

io::Dataset LiveSource::dataset() const {
  io::Dataset dataset;
  dataset.layout = io::Layout::kStream;
  dataset.root = feed_->shown();
  return dataset;
}

bool LiveSource::sets_the_pace() const {
  return feed_->flow() != StreamFlow::kFile;
}

bool LiveSource::next(SourceFrame& out) {
  if (!first_) return take(out);
  out = std::move(*first_);
  first_.reset();
  return true;
}

bool LiveSource::take(SourceFrame& out) {
  if (!feed_->take(out)) return false;
  decode(out);
  return true;
}

void LiveSource::decode(SourceFrame& frame) {
  const std::string label = feed_->shown() + " frame " + std::to_string(frame.entry.index);
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
  feed_->stop();
}

StreamFigures LiveSource::figures() const {
  return feed_->figures();
}

}  // namespace sslam::cli
