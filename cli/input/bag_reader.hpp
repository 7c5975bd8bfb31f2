// SPDX-License-Identifier: BSD-3-Clause
// The images of a bag's frames. A chunk is read once for the frames that lie in it.
#pragma once

#include <cstdint>
#include <memory>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "sslam/io/bags/bag_file.hpp"
#include "sslam/io/datasets/bag.hpp"

namespace sslam::cli {

class BagReader {
 public:
  // `stream` of `bag`; both outlive the reader.
  BagReader(const io::BagFrames& bag, const io::BagFrames::Stream& stream) : bag_(bag), stream_(stream) {}

  // BGR of 8 or 16 bit, as stored. `frame`: its name, for people; `expected`: a size that is let
  // in however large. Empty, with the reason in `why`, when it cannot be read.
  [[nodiscard]] cv::Mat image(std::int64_t index, const std::string& frame, cv::Size expected,
                              std::string& why);

  // Millimetres of 16 bit or metres as floats, with 0 for what was not measured. Empty as above.
  [[nodiscard]] cv::Mat depth(std::int64_t index, const std::string& frame, std::string& why);

 private:
  [[nodiscard]] std::string_view message(std::int64_t index);
  // Into bytes_; false where the chunk is damaged.
  [[nodiscard]] bool read_chunk(const io::ChunkPlace& chunk);
  [[nodiscard]] cv::Mat decode(const io::MessageFields& fields, const std::string& name, cv::Size expected,
                               std::string& why) const;
  [[nodiscard]] cv::Mat decode_depth(const io::MessageFields& fields, const std::string& name,
                                     std::string& why) const;
  template <class Decode>
  [[nodiscard]] cv::Mat read(std::int64_t index, const std::string& name, std::string& why, Decode decode);

  const io::BagFrames& bag_;
  const io::BagFrames::Stream& stream_;
  std::optional<std::uint16_t> open_;  // the number of the bag's file that is open
  std::optional<io::BagFile> file_;
  std::unique_ptr<io::BagDatabase> database_;
  std::string scratch_, bytes_;
  std::optional<std::uint32_t> held_;  // the chunk that bytes_ holds
};

// Fills in which frames there are, as list_video_frames does. Throws Error, in one line.
void list_bag_frames(io::Dataset& dataset, const io::BagTopics& topics = {});

}  // namespace sslam::cli
