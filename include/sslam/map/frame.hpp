// SPDX-License-Identifier: BSD-3-Clause
// What the front end hands to the tracker for one image: undistorted point and line features and surface
// normals.
#pragma once

#include <cstdint>
#include <vector>

#include "sslam/core/descriptor.hpp"
#include "sslam/geometry/camera.hpp"
#include "sslam/geometry/line2.hpp"
#include "sslam/image/feature_patch.hpp"
#include "sslam/image/normal_field.hpp"

namespace sslam {

template <Scalar S>
struct PointFeature {
  Vec2<S> pixel;            // undistorted
  S sigma = 1;              // standard deviation of each coordinate, pixels
  S angle = 0;              // dominant gradient direction, radians
  std::uint8_t octave = 0;  // level of the image pyramid
  std::int32_t patch = -1;  // its place in the frame's patches; -1: none is kept
  Descriptor descriptor;
};

template <Scalar S>
struct LineFeature {
  Segment2<S>
      segment;  // undistorted; the brighter side lies to the same hand along start -> end in every view
  S sigma = 1;  // standard deviation of an endpoint across the segment, pixels
  std::uint8_t octave = 0;  // level of the image pyramid
  Descriptor descriptor;
};

// Vectors keep their capacity from frame to frame, so a reused Frame stops allocating after the first few
// images.
template <Scalar S>
struct Frame {
  std::int64_t index = -1;  // position in the dataset
  double stamp = 0;         // seconds
  Pinhole<S> pinhole;       // of the undistorted image
  int width = 0;
  int height = 0;
  std::vector<PointFeature<S>> points;
  std::vector<LineFeature<S>> lines;
  NormalField normals;
  std::vector<FeaturePatch> patches;  // of some points or of all, in any order
};

}  // namespace sslam
