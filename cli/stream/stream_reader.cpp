// SPDX-License-Identifier: BSD-3-Clause
#include "cli/stream/stream_reader.hpp"

#include "cli/stream/av_stream.hpp"
#include "cli/stream/device_stream.hpp"
#include "cli/stream/pipe_stream.hpp"

namespace sslam::cli {

std::unique_ptr<StreamReader> open_stream(const StreamName& name, cv::Size size, Patience& patience) {
  switch (name.kind) {
    case StreamKind::kDevice:
      return std::make_unique<DeviceStream>(name.text, size, patience);
    case StreamKind::kUrl:
      return std::make_unique<AvStream>(name, patience);
    case StreamKind::kPipe:
      break;
  }
  return std::make_unique<PipeStream>(name, patience);
}

}  // namespace sslam::cli
