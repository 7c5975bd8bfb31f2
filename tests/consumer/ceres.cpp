// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/ceres.hpp"

int main() {
  sslam::Map<double> map;
  sslam::Keyframe<double> keyframe;
  map.add_keyframe(keyframe);
  sslam::LocalBundleAdjustment adjustment;
  adjustment.optimise(map, 0);  // nothing to improve: the map stays as it is
  return map.keyframes.size() == 1 ? 0 : 1;
}
