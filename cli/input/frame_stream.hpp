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
#include "sslam/io/datasets/dataset.hpp"
#include "sslam/system/system.hpp"

namespace sslam::cli {

struct ExtractedFrame : Extraction {
  std::string warning;  // not empty: something is wrong with this frame
};

class FrameStream {
 public:
  // `pace`: seconds a unit of the stamps, to deliver frames as a camera would; 0: at once. The dataset and
  // the system outlive the stream.
  FrameStream(const io::Dataset& dataset, System& system, double pace, MaskSource masks = {});
  ~FrameStream();
  FrameStream(const FrameStream&) = delete;
  FrameStream& operator=(const FrameStream&) = delete;

  [[nodiscard]] std::size_t size() const noexcept { return dataset_.frames.size(); }

  // The next frame in order; false at the end, or when Ctrl-C is pressed during the wait for it. The old
  // contents of `out` are recycled.
  [[nodiscard]] bool next(ExtractedFrame& out);

 private:
  void produce();
  [[nodiscard]] bool wait_until_due(std::unique_lock<std::mutex>& lock, const io::FrameEntry& entry);
  void fill(const io::FrameEntry& entry, ExtractedFrame& out);
  [[nodiscard]] std::string normals_warning(const io::FrameEntry& entry, NormalStatus status);
  void read_depth(const io::FrameEntry& entry, ImageInput& input, ExtractedFrame& out) const;

  const io::Dataset& dataset_;
  System& system_;
  double pace_;
  FrameReader reader_;
  MaskSource masks_;
  std::set<NormalStatus> told_;  // faults of the source of normals

  using Clock = std::chrono::steady_clock;
  Clock::time_point start_ = Clock::now();

  static constexpr std::size_t kAhead = 3;  // frames extracted before they are asked for
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
