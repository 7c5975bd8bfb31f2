// SPDX-License-Identifier: BSD-3-Clause
// One connection to a stream: frames one after the other, until it breaks or is to stop.
#pragma once

#include <cstdint>
#include <memory>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "cli/stream/patience.hpp"
#include "cli/stream/stream_name.hpp"

namespace sslam::cli {

struct StreamFrame {
  std::vector<std::uint8_t> file;  // the image as the file that it would be; empty: `image` has its pixels
  cv::Mat image;                   // 8 bit BGR
  std::optional<double> time;      // when it was taken, seconds on the stream's clock; empty: not known
};

// What becomes of a sender whose frames nobody takes.
enum class StreamFlow {
  kRuns,   // a camera: it goes on, and frames are lost
  kWaits,  // a pipe: it waits
  kFile,   // a video that lies elsewhere: it has an end, and all the time in the world
};

class StreamReader {
 public:
  StreamReader() = default;
  virtual ~StreamReader() = default;
  StreamReader(const StreamReader&) = delete;
  StreamReader& operator=(const StreamReader&) = delete;

  // Waits for the next frame. False: the connection has ended or broken, or patience is over.
  [[nodiscard]] virtual bool read(StreamFrame& out) = 0;
  [[nodiscard]] virtual StreamFlow flow() const = 0;
  // Why read() has given no frame, such as "the connection was lost"; empty: not known, or its end.
  [[nodiscard]] virtual std::string trouble() const { return {}; }
};

// size: of the images to ask a camera for; empty: as it likes. Throws Error when there is nothing to connect
// to. The patience must outlive the reader.
[[nodiscard]] std::unique_ptr<StreamReader> open_stream(const StreamName& name, cv::Size size,
                                                        Patience& patience);

}  // namespace sslam::cli
