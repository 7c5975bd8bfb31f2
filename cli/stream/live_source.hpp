// SPDX-License-Identifier: BSD-3-Clause
// A stream as a run sees it: a thread of its own holds the newest frame, comes back when the stream breaks,
// and never keeps the program from ending.
#pragma once

#include <cstdint>
#include <memory>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "cli/input/image_range.hpp"
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

class LiveSource {
 public:
  LiveSource(const StreamName& name, const StreamOptions& options);
  // Ends the thread; one that hangs in the system is left to itself.
  ~LiveSource();
  LiveSource(const LiveSource&) = delete;
  LiveSource& operator=(const LiveSource&) = delete;

  // Waits for the first image and answers with its size. Throws Error when there is none; Stop when
  // interrupted.
  [[nodiscard]] cv::Size wait_for_first();

  // What is left of a list of frames. Call it once the first frame is there.
  [[nodiscard]] io::Dataset dataset() const;
  // Whether frames come when they come: nobody need wait for their time. Then, too.
  [[nodiscard]] bool sets_the_pace() const;

  // The next frame; false at the end of the stream or after stop(). For one thread.
  [[nodiscard]] bool next(SourceFrame& out);
  void stop();

  [[nodiscard]] StreamFigures figures() const;

 private:
  struct Shared;
  [[nodiscard]] bool take(SourceFrame& out);
  void decode(SourceFrame& frame);

  std::shared_ptr<Shared> shared_;
  std::optional<SourceFrame> first_;
  std::optional<ImageRange> range_;
};

}  // namespace sslam::cli
