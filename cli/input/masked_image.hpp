// SPDX-License-Identifier: BSD-3-Clause
// What is done to an image between its file and the tracker.
#pragma once

#include <string>

#include "cli/input/mask_source.hpp"
#include "sslam/opencv/camera/wide_view.hpp"
#include "sslam/opencv/image_input.hpp"

namespace sslam::cli {

// Gives the image its mask, by its name, and takes both as the pinhole of a wide lens sees them; `view` null:
// as they are. `why`: the reason where a mask was expected, and there is none.
inline void mask_and_straighten(const MaskSource& masks, const WideView* view, ImageInput& input,
                                std::string& why) {
  input.mask = masks.of(input.name, why);
  if (view == nullptr) return;
  input.image = view->of(input.image);
  input.mask = view->mask(input.mask);
}

}  // namespace sslam::cli
