// SPDX-License-Identifier: BSD-3-Clause
// Libraries that decode images tell standard error of every flaw. What counts is said once, by us.
#pragma once

namespace sslam::cli {

// As long as one lives, in any thread, standard error leads nowhere; our own messages have a way of their own
// (message_stream).
class QuietDecoders {
 public:
  QuietDecoders();
  ~QuietDecoders();
  QuietDecoders(const QuietDecoders&) = delete;
  QuietDecoders& operator=(const QuietDecoders&) = delete;
};

}  // namespace sslam::cli
