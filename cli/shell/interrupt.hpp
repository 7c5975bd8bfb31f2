// SPDX-License-Identifier: BSD-3-Clause
// The signals that ask a program to end (Ctrl-C, kill, a closed terminal): the first one asks a run to stop
// after the frame in hand and to write what it has; a second one ends the process.
#pragma once

#include <array>
#include <csignal>
#include <cstddef>
#include <optional>

namespace sslam::cli {

// Has these signals handled while it lives. Who ignores SIGHUP (nohup) goes on ignoring it.
class EndingSignals {
 public:
  using Handler = void (*)(int);

  explicit EndingSignals(Handler handler) {
    for (std::size_t i = 0; i < kSignals.size(); ++i) {
      previous_[i] = std::signal(kSignals[i], handler);
      if (kSignals[i] == SIGHUP && previous_[i] == SIG_IGN) std::signal(SIGHUP, SIG_IGN);
    }
  }
  ~EndingSignals() {
    for (std::size_t i = 0; i < kSignals.size(); ++i) std::signal(kSignals[i], previous_[i]);
  }
  EndingSignals(const EndingSignals&) = delete;
  EndingSignals& operator=(const EndingSignals&) = delete;

 private:
  static constexpr std::array<int, 3> kSignals{SIGINT, SIGTERM, SIGHUP};
  std::array<Handler, kSignals.size()> previous_{};
};

class Interrupt {
 public:
  Interrupt() : signals_(start()) {}

  [[nodiscard]] static bool asked() noexcept { return asked_ != 0; }

 private:
  static EndingSignals::Handler start() noexcept {
    asked_ = 0;
    return handle;
  }
  static void handle(int signal) {
    if (asked_ != 0) {
      std::signal(signal, SIG_DFL);
      std::raise(signal);  // takes effect when this handler returns
    }
    asked_ = 1;
  }
  inline static volatile std::sig_atomic_t asked_ = 0;
  EndingSignals signals_;
};

// While it lives, these signals wait; the last one takes effect when it goes. For moments, not for work.
class HeldSignals {
 public:
  HeldSignals() : signals_(std::in_place, start()) {}
  ~HeldSignals() {
    signals_.reset();
    if (held_ != 0) std::raise(held_);
  }
  HeldSignals(const HeldSignals&) = delete;
  HeldSignals& operator=(const HeldSignals&) = delete;

 private:
  static EndingSignals::Handler start() noexcept {
    held_ = 0;
    return [](int signal) { held_ = signal; };
  }
  inline static volatile std::sig_atomic_t held_ = 0;
  std::optional<EndingSignals> signals_;
};

}  // namespace sslam::cli
