// SPDX-License-Identifier: BSD-3-Clause
// Images through a pipe, one file after the other; anything else there is a video's container.
#pragma once

#include <memory>
#include <string>

#include "cli/stream/av_stream.hpp"
#include "cli/stream/byte_pipe.hpp"
#include "cli/stream/image_splitter.hpp"
#include "cli/stream/stream_reader.hpp"

namespace sslam::cli {

class PipeStream : public StreamReader {
 public:
  // Waits for the first bytes, which tell what comes. Throws Error when nothing of use does.
  PipeStream(const StreamName& name, Patience& patience);

  [[nodiscard]] bool read(StreamFrame& out) override;
  [[nodiscard]] StreamFlow flow() const override { return StreamFlow::kWaits; }

 private:
  BytePipe pipe_;
  ImageSplitter splitter_;
  std::unique_ptr<AvStream> video_;
};

}  // namespace sslam::cli
