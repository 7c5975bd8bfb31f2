// SPDX-License-Identifier: BSD-3-Clause
#include "cli/results/keyframe_images.hpp"

#include <cstdint>
#include <cstdio>
#include <map>
#include <optional>

#include "cli/input/frame_reader.hpp"
#include "sslam/io/files/files.hpp"
#include "sslam/io/files/text.hpp"

namespace sslam::cli {
namespace {

struct NamedFrame {
  double stamp = 0;
  std::string image;
};

// Whether the run's dataset was a bag.
bool is_of_bag(const RunFolder& run) {
  const auto settings = run.metrics.find("settings");
  if (settings == run.metrics.end() || !settings->is_object()) return false;
  const auto topic = settings->find("topic");
  return topic != settings->end() && topic->is_string() && !topic->get<std::string>().empty();
}

// Of what FrameReader::label gives.
std::string image_name(const std::string& label, std::int64_t index, bool of_bag) {
  const std::string tail = " frame " + std::to_string(index);
  if (!label.ends_with(tail)) return label;
  const std::string file = label.substr(0, label.size() - tail.size());
  return of_bag || !io::is_image_name(file) ? video_frame_stem(file, index) + ".png" : label;
}

std::map<std::int64_t, NamedFrame> named_frames(const io::CsvTable& frames, bool of_bag) {
  std::map<std::int64_t, NamedFrame> named;
  const std::size_t index = frames.column("index"), stamp = frames.column("stamp"),
                    image = frames.column("image"), none = frames.columns.size();
  if (index == none || stamp == none || image == none) return named;
  for (std::size_t row = 0; row < frames.rows(); ++row) {
    const auto number = io::parse_number<std::int64_t>(frames.cell(row, index));
    const auto time = io::parse_number<double>(frames.cell(row, stamp));
    if (number && time)
      named[*number] = {*time, image_name(std::string(frames.cell(row, image)), *number, of_bag)};
  }
  return named;
}

}  // namespace

KeyframeImages keyframe_images(const RunFolder& run) {
  const auto named = named_frames(run.frames, is_of_bag(run));
  KeyframeImages images;
  std::size_t strangers = 0, blanks = 0;
  for (const auto& keyframe : run.map.keyframes) {
    const auto found = named.find(keyframe.frame.index);
    // Keyframes of an earlier run have numbers of their own.
    const bool known = found != named.end() && found->second.stamp == keyframe.frame.stamp;
    char number[40];
    std::snprintf(number, sizeof number, "keyframe_%06d.png", static_cast<int>(keyframe.id));
    images.names.push_back(known ? found->second.image : number);
    images.known.push_back(known);
    if (!keyframe.alive()) continue;
    strangers += known ? 0U : 1U;
    blanks += images.names.back().find(' ') != std::string::npos ? 1U : 0U;
  }
  if (strangers > 0)
    images.warnings.push_back(std::to_string(strangers) +
                              " keyframes are in no row of frames.csv (an earlier run's?): they are called "
                              "keyframe_NUMBER.png");
  if (blanks > 0)
    images.warnings.push_back(std::to_string(blanks) +
                              " names of images contain a blank, where COLMAP truncates them");
  return images;
}

}  // namespace sslam::cli
