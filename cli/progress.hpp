// SPDX-License-Identifier: BSD-3-Clause
// Progress of a run on standard error: a bar on a terminal, a plain line now and then elsewhere.
#pragma once

#include <chrono>
#include <cstddef>
#include <string>

#include "cli/frame_record.hpp"

namespace sslam::cli {

enum class Verbosity { kQuiet, kNormal };

class Progress {
 public:
  Progress(std::size_t total, Verbosity verbosity);

  void show(const FrameRecord& frame);
  void show(const std::string& detail);  // what stands behind the count and the rate
  void finish();                         // leaves the last line standing

 private:
  using Clock = std::chrono::steady_clock;
  void print(const std::string& detail) const;

  std::size_t total_;
  std::size_t done_ = 0;
  bool quiet_;
  bool terminal_;
  bool open_line_ = false;
  Clock::time_point start_ = Clock::now();
  Clock::time_point shown_{};
};

}  // namespace sslam::cli
