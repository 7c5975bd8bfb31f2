// SPDX-License-Identifier: BSD-3-Clause
// A frame as a person looks at it: the image with what the tracker saw in it, the normals, and the state
// below.
#pragma once

#include <opencv2/core.hpp>

#include "cli/results/frame_view.hpp"
#include "sslam/track/contract/result.hpp"

namespace sslam::cli {

// Of the overlay of an image: as wide, and higher by a banner; even, since video encoders want that.
[[nodiscard]] cv::Size overlay_size(int width, int height);

// 8 bit BGR. Features are yellow where they see the map, pale elsewhere; segments have the colour of their
// axis, and are thick where they see the map. Normals, where there are any, stand in the top right corner.
[[nodiscard]] cv::Mat draw_overlay(const FrameViewInput& input, const TrackedFrame<double>& frame,
                                   const TrackResult<double>& result);

}  // namespace sslam::cli
