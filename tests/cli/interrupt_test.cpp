// SPDX-License-Identifier: BSD-3-Clause
#include "cli/shell/interrupt.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include "support/catch.hpp"

namespace interrupt_test {

using sslam::cli::HeldSignals;
using sslam::cli::Interrupt;

namespace {

// The signal that ends a process that does this; 0: none.
template <class Action>
int ending_signal(Action action) {
  const pid_t child = fork();
  if (child == 0) {
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) std::signal(signal, SIG_DFL);
    action();
    _exit(0);
  }
  int status = 0;
  waitpid(child, &status, 0);
  return WIFSIGNALED(status) ? WTERMSIG(status) : 0;
}

void expect(bool holds) {
  if (!holds) std::raise(SIGKILL);
}

}  // namespace

TEST_CASE("each signal that asks for the end is heard, and a second one ends the process") {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    CHECK(ending_signal([&] {
            const Interrupt interrupt;
            expect(!Interrupt::asked());
            std::raise(signal);
            expect(Interrupt::asked());
          }) == 0);
    CHECK(ending_signal([&] {
            const Interrupt interrupt;
            std::raise(signal == SIGINT ? SIGTERM : SIGINT);
            std::raise(signal);
          }) == signal);
  }
}

TEST_CASE("who ignores SIGHUP goes on ignoring it") {
  CHECK(ending_signal([] {
          std::signal(SIGHUP, SIG_IGN);
          const Interrupt interrupt;
          std::raise(SIGHUP);
          std::raise(SIGHUP);
          expect(!Interrupt::asked());
        }) == 0);
}

TEST_CASE("held signals take effect later") {
  CHECK(ending_signal([] {
          const Interrupt interrupt;
          {
            const HeldSignals held;
            std::raise(SIGTERM);
            std::raise(SIGTERM);
            expect(!Interrupt::asked());
          }
          expect(Interrupt::asked());
        }) == 0);
  CHECK(ending_signal([] {
          const HeldSignals held;
          std::raise(SIGTERM);
        }) == SIGTERM);
}

}  // namespace interrupt_test
