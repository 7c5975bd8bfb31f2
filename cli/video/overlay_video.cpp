// SPDX-License-Identifier: BSD-3-Clause
#include "cli/video/overlay_video.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "cli/video/frame_overlay.hpp"
#include "sslam/core/error.hpp"
#include "sslam/io/evaluation/statistics.hpp"

namespace sslam::cli {
namespace {

// With two decimals: MPEG-4 part 2 counts at most 65535 ticks a second.
double frames_per_second(const io::Dataset& dataset) {
  std::vector<double> gaps;
  for (std::size_t i = 1; i < dataset.frames.size(); ++i)
    gaps.push_back(dataset.frames[i].stamp - dataset.frames[i - 1].stamp);
  if (gaps.empty()) return io::kDefaultFrameRate;
  const double rate = 1 / (io::statistics_of(gaps).median * dataset.seconds_per_stamp);
  return std::round(std::clamp(rate, 1.0, 240.0) * 100) / 100;
}

const std::filesystem::path& checked(const std::filesystem::path& path, const io::Dataset& dataset) {
  std::error_code ignored;
  if (std::filesystem::equivalent(path, dataset.root, ignored))
    throw Error("--video " + path.string() + ": is the input; choose another name");
  return path;
}

}  // namespace

OverlayVideo::OverlayVideo(const std::filesystem::path& path, const io::Dataset& dataset,
                           const Camera<double>& camera)
    : camera_(camera),
      file_(checked(path, dataset), overlay_size(camera.width, camera.height), frames_per_second(dataset)) {}

void OverlayVideo::frame_tracked(const FrameEvent& event) {
  file_.write(draw_overlay(frame_view(event, rows_++, camera_), event.frame, event.report));
}

}  // namespace sslam::cli
