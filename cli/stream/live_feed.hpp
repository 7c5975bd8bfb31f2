// SPDX-License-Identifier: BSD-3-Clause
// The thread that reads a stream, and the frames that it has ready: it holds the newest, and comes back when
// the stream breaks.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <exception>
#include <memory>
#include <mutex>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "cli/stream/patience.hpp"
#include "cli/stream/stamp_clock.hpp"
#include "cli/stream/stream_reader.hpp"
#include "sslam/io/datasets/dataset.hpp"

namespace sslam::cli {

struct StreamOptions {
  bool live = false;       // frames of a pipe are dropped, too, when they come too fast
  double retry = 10;       // seconds that a lost stream is tried again for
  double frame_rate = 30;  // frames a second, of a pipe that waits and does not say
  io::Slice slice;
  cv::Size size;  // to ask a camera for; empty: whatever it gives
};

// One frame that is to be tracked.
struct SourceFrame {
  io::FrameEntry entry;            // its number in the stream, its stamp in seconds since the first frame
  cv::Mat image;                   // 8 bit BGR; empty: cannot be decoded
  std::vector<std::uint8_t> file;  // what came, where that is an image's file
  std::string why;                 // there is no image
};

struct StreamFigures {
  std::size_t dropped = 0;  // frames that came while the tracker was busy
  std::size_t lost = 0;     // times that the stream broke and came back
  std::string end;          // why it ended before anybody asked; empty: it was at its end
};

class LiveFeed {
 public:
  LiveFeed(StreamName name, const StreamOptions& options);

  // Reads until the stream ends or stop(): what the thread does.
  void work();

  [[nodiscard]] const std::string& shown() const noexcept { return shown_; }  // its name, for people
  [[nodiscard]] StreamFlow flow() const;                                      // once the first frame is there
  [[nodiscard]] StreamFigures figures() const;

  // True: a frame is there, or none will come.
  [[nodiscard]] bool wait_for_frame(std::chrono::milliseconds longest);
  // The next frame, not yet decoded; false at the end of the stream or after stop(). Throws what ended a
  // stream that gave no frame.
  [[nodiscard]] bool take(SourceFrame& out);
  void stop();
  void wait_for_end(std::chrono::milliseconds longest);

 private:
  void run();
  [[nodiscard]] std::unique_ptr<StreamReader> come_back(Patience& patience, const std::string& why);
  // False: no further frame is wanted.
  [[nodiscard]] bool offer(StreamFrame frame, StampClock& clock, bool drop);
  [[nodiscard]] bool stopping() const;

  StreamName name_;
  std::string shown_;
  StreamOptions options_;
  std::int64_t number_ = 0;  // of the next frame; the thread's own

  mutable std::mutex mutex_;  // for what follows
  std::condition_variable changed_;
  std::deque<SourceFrame> waiting_;
  StreamFlow flow_ = StreamFlow::kRuns;
  StreamFigures figures_;
  std::exception_ptr failure_;
  bool finished_ = false;
  bool stop_ = false;
};

}  // namespace sslam::cli
