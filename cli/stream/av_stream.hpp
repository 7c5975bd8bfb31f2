// SPDX-License-Identifier: BSD-3-Clause
// Streams by FFmpeg's libraries: what is in the network, and videos that come through a pipe.
#pragma once

#include <memory>
#include <string>

#include "cli/stream/byte_pipe.hpp"
#include "cli/stream/stream_reader.hpp"

namespace sslam::cli {

class AvStream : public StreamReader {
 public:
  // Throws Error when nobody answers, or nothing that is a video.
  AvStream(const StreamName& name, Patience& patience);
  // Of the pipe that is shown as `name`, whose first bytes have been read.
  AvStream(const std::string& name, BytePipe& pipe, std::vector<std::uint8_t> first, Patience& patience);
  ~AvStream() override;

  [[nodiscard]] bool read(StreamFrame& out) override;
  [[nodiscard]] StreamFlow flow() const override;
  [[nodiscard]] std::string trouble() const override;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace sslam::cli
