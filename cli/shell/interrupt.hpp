// SPDX-License-Identifier: BSD-3-Clause
// Ctrl-C asks a run to stop after the frame in hand and to write what it has; a second one ends the process.
#pragma once

#include <csignal>

namespace sslam::cli {

class Interrupt {
 public:
  Interrupt() {
    asked_ = 0;
    previous_int_ = std::signal(SIGINT, handle);
    previous_term_ = std::signal(SIGTERM, handle);
  }
  ~Interrupt() {
    std::signal(SIGINT, previous_int_);
    std::signal(SIGTERM, previous_term_);
  }
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;

  [[nodiscard]] static bool asked() noexcept { return asked_ != 0; }

 private:
  static void handle(int signal) {
    asked_ = 1;
    std::signal(signal, SIG_DFL);
  }
  inline static volatile std::sig_atomic_t asked_ = 0;
  void (*previous_int_)(int) = SIG_DFL;
  void (*previous_term_)(int) = SIG_DFL;
};

}  // namespace sslam::cli
