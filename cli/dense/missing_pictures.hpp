// SPDX-License-Identifier: BSD-3-Clause
// Images of keyframes that became keyframes after their frame had passed: the first one of a map, and those
// that the final pass makes.
#pragma once

#include "cli/dense/keyframe_pictures.hpp"
#include "cli/input/mask_source.hpp"
#include "sslam/io/datasets/dataset.hpp"
#include "sslam/map/map.hpp"
#include "sslam/opencv/camera/wide_view.hpp"

namespace sslam::cli {

// Where the images of a run come from, and what is done to them before they are tracked.
struct PictureSource {
  const io::Dataset& dataset;  // files: a stream cannot be read again
  const MaskSource& masks;
  const WideView* view = nullptr;  // of a wide lens; null: the images are taken as they are
  Camera<double> given, working;   // of the images, and of the size that is worked on
};

// Reads the images of the map's keyframes from `first` on that have none; those that cannot be read are left
// out. Normals are not found again.
void read_missing_pictures(const Map<double>& map, std::size_t first, const PictureSource& source,
                           KeyframePictures& pictures);

}  // namespace sslam::cli
