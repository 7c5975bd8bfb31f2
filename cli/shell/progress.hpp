// SPDX-License-Identifier: BSD-3-Clause
// Progress on standard error: a bar on a terminal, a plain line now and then elsewhere, or a JSON object for
// each step. Threads may share one.
#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <mutex>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "sslam/system/frame_report.hpp"

namespace sslam::cli {

enum class Verbosity {
  kQuiet,    // nothing
  kNormal,   // the bar, or a line now and then
  kVerbose,  // also a line for each change of state, loss and keyframe
  kJson,     // a JSON object a line, for programs; docs/automation.md says which
};

class Progress {
 public:
  // total: steps to come; 0: not known. task: what is in progress, such as "run".
  Progress(std::size_t total, Verbosity verbosity, std::string task);

  void begin_at(std::size_t done) noexcept { begun_ = done_ = done; }  // steps of an earlier process

  void show(const FrameReport& frame);
  void show(const std::string& detail);  // what stands behind the count and the rate
  // An event for programs that watch over the task, from time to time; health() is asked when it is told.
  void tell_now_and_then(const std::function<nlohmann::ordered_json()>& health);
  void tell(const nlohmann::ordered_json& health);  // the same, now
  void finish();                                    // leaves the last line standing

 private:
  using Clock = std::chrono::steady_clock;
  void tell_event(const FrameReport& frame);
  void renew_line(const std::string& detail);
  void print_line(const std::string& detail);
  void clear_line();
  [[nodiscard]] double seconds() const;

  std::size_t total_;
  std::size_t begun_ = 0, done_ = 0;
  Verbosity verbosity_;
  std::string task_;
  bool terminal_;
  bool open_line_ = false;
  std::optional<State> last_state_;
  Clock::time_point start_ = Clock::now();
  Clock::time_point shown_{};
  Clock::time_point told_ = start_;  // of its health
  std::mutex mutex_;
};

}  // namespace sslam::cli
