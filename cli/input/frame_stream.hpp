// SPDX-License-Identifier: BSD-3-Clause
// Frames on their way from the disk to the tracker: a thread decodes and extracts ahead, the tracker takes in
// order.
#pragma once

#include <chrono>
#include <condition_variable>
#include <deque>
#include <exception>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "cli/input/frame_reader.hpp"
#include "cli/input/mask_source.hpp"
#include "cli/stream/live_source.hpp"
#include "cli/stream/recording.hpp"
#include "sslam/io/datasets/dataset.hpp"
#include "sslam/opencv/camera/wide_view.hpp"
#include "sslam/system/system.hpp"

namespace sslam::cli {

struct ExtractedFrame : Extraction {
  io::FrameEntry entry;
  std::string warning;  // not empty: something is wrong with this frame
};

struct FrameStreamOptions {
  double pace = 0;  // seconds a unit of the stamps, to deliver frames as a camera would; 0: at once
  MaskSource masks;
  const WideView* view =
      nullptr;                   // of a wide lens, to undistort its images; null: they are taken as they are
  LiveSource* source = nullptr;  // where frames come from, instead of the dataset's list
  Recording* recording = nullptr;  // keeps what comes
  std::size_t first = 0;           // position in the dataset of the first frame that is wanted
};

class FrameStream {
 public:
  // Dataset, system, source and recording outlive the stream. Frames of a source join the dataset when they
  // are taken.
  FrameStream(io::Dataset& dataset, System& system, FrameStreamOptions options);
  ~FrameStream();
  FrameStream(const FrameStream&) = delete;
  FrameStream& operator=(const FrameStream&) = delete;

  // The next frame in order; false at the end, or when Ctrl-C is pressed during the wait for it. The old
  // contents of `out` are recycled.
  [[nodiscard]] bool next(ExtractedFrame& out);

  // Of a frame that has been tracked, in one line. Empty: nothing to tell. A view without planes is no fault
  // of the input: the run's figures count it. What is wrong with a source as a whole is told once.
  [[nodiscard]] std::string fault_of_normals(const ExtractedFrame& frame);

  // Of a source, so far.
  [[nodiscard]] std::size_t dropped() const {
    return options_.source ? options_.source->figures().dropped : 0;
  }

  // No further frame is wanted. Waits for nothing.
  void stop();

 private:
  void produce();
  void produce_from_source();
  [[nodiscard]] bool deliver(SourceFrame& frame);
  [[nodiscard]] bool wait_until_due(std::unique_lock<std::mutex>& lock, const io::FrameEntry& entry);
  void fill(SourceFrame& frame, ExtractedFrame& out);
  void read(SourceFrame& frame);
  void read_depth(const io::FrameEntry& entry, ImageInput& input, ExtractedFrame& out);

  io::Dataset& dataset_;
  System& system_;
  FrameStreamOptions options_;
  FrameReader reader_;
  std::set<NormalStatus> told_;  // faults of the source of normals, for the tracker's thread

  using Clock = std::chrono::steady_clock;
  Clock::time_point start_ = Clock::now();
  std::optional<double> first_stamp_;

  std::size_t ahead_;  // frames extracted before they are asked for
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<ExtractedFrame> ready_;
  std::vector<ExtractedFrame> spare_;
  std::exception_ptr failure_;
  bool finished_ = false;
  bool stop_ = false;
  std::thread producer_;
};

}  // namespace sslam::cli
