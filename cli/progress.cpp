// SPDX-License-Identifier: BSD-3-Clause
#include "cli/progress.hpp"

#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace sslam::cli {

Progress::Progress(std::size_t total, Verbosity verbosity)
    : total_(total), quiet_(verbosity == Verbosity::kQuiet), terminal_(isatty(STDERR_FILENO) != 0) {}

void Progress::show(const FrameRecord& frame) {
  char detail[160];
  std::snprintf(detail, sizeof detail, "%-12s %3d points %3d lines  %s", name(frame.result.state),
                frame.result.point_inliers, frame.result.line_inliers, name(frame.result.reason));
  show(std::string(detail));
}

void Progress::show(const std::string& detail) {
  ++done_;
  if (quiet_) return;
  const auto now = Clock::now();
  const auto interval = terminal_ ? std::chrono::milliseconds(100) : std::chrono::milliseconds(5000);
  if (now - shown_ < interval && done_ != total_) return;
  shown_ = now;
  print(detail);
  open_line_ = terminal_;
}

void Progress::print(const std::string& detail) const {
  const double seconds = std::chrono::duration<double>(Clock::now() - start_).count();
  const double rate = seconds > 0 ? static_cast<double>(done_) / seconds : 0;
  constexpr std::size_t kWidth = 24;
  const std::size_t filled = total_ > 0 ? std::min(kWidth, done_ * kWidth / total_) : kWidth;
  const std::string bar = std::string(filled, '#') + std::string(kWidth - filled, '.');
  std::fprintf(stderr, "%s%zu/%zu [%s] %5.1f frames/s  %s%s", terminal_ ? "\r" : "", done_, total_,
               bar.c_str(), rate, detail.c_str(), terminal_ ? "\033[K" : "\n");
  std::fflush(stderr);
}

void Progress::finish() {
  if (open_line_) std::fputc('\n', stderr);
  open_line_ = false;
}

}  // namespace sslam::cli
