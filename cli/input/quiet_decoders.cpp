// SPDX-License-Identifier: BSD-3-Clause
#include "cli/input/quiet_decoders.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <mutex>

#include "cli/shell/messages.hpp"

namespace sslam::cli {
namespace {

struct Redirection {
  std::mutex mutex;
  int users = 0;
  int kept = -1;  // where standard error led; negative: it was closed
};

Redirection& redirection() {
  static Redirection one;
  return one;
}

}  // namespace

QuietDecoders::QuietDecoders() {
  (void)message_stream();  // made while standard error still leads to the terminal
  Redirection& now = redirection();
  const std::lock_guard lock(now.mutex);
  if (now.users++ > 0) return;
  now.kept = fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
  const int nowhere = now.kept < 0 ? -1 : open("/dev/null", O_WRONLY | O_CLOEXEC);
  if (nowhere < 0) return;
  dup2(nowhere, STDERR_FILENO);
  close(nowhere);
}

QuietDecoders::~QuietDecoders() {
  Redirection& now = redirection();
  const std::lock_guard lock(now.mutex);
  if (--now.users > 0 || now.kept < 0) return;
  dup2(now.kept, STDERR_FILENO);
  close(now.kept);
  now.kept = -1;
}

}  // namespace sslam::cli
