// SPDX-License-Identifier: BSD-3-Clause
// A stream as a run sees it: images in order, read by a thread that never keeps the program from ending.
#pragma once

#include <memory>
#include <opencv2/core.hpp>
#include <optional>

#include "cli/input/image_range.hpp"
#include "cli/stream/live_feed.hpp"
#include "sslam/io/datasets/dataset.hpp"

namespace sslam::cli {

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
  [[nodiscard]] bool take(SourceFrame& out);
  void decode(SourceFrame& frame);

  std::shared_ptr<LiveFeed> feed_;  // of the thread, too, which may outlive the source
  std::optional<SourceFrame> first_;
  std::optional<ImageRange> range_;
};

}  // namespace sslam::cli
