// SPDX-License-Identifier: BSD-3-Clause
// Checks settings by themselves, without the presets.
#pragma once

#include <cmath>

#include "sslam/system/settings.hpp"

namespace sslam {

// Throws SettingsError. The system itself checks the preset and the parameters.
inline void check_settings(const Settings& settings) {
  const Camera<double>& camera = settings.camera;
  const auto& k = camera.pinhole;
  if (camera.width <= 0 || camera.height <= 0)
    throw SettingsError("camera", "the width and height of its images are missing");
  const bool finite =
      std::isfinite(k.fx) && std::isfinite(k.fy) && std::isfinite(k.cx) && std::isfinite(k.cy);
  if (!finite || !(k.fx > 0) || !(k.fy > 0))
    throw SettingsError("camera", "fx and fy must be positive and finite, cx and cy finite");
  if (settings.longest_side < 0) throw SettingsError("longest_side", "a number of pixels, or 0 for any size");
  if (settings.normals.from_depth() && !(settings.depth_factor > 0 && std::isfinite(settings.depth_factor)))
    throw SettingsError("depth_factor", "normals from depth need the value of one metre, above 0");
}

}  // namespace sslam
