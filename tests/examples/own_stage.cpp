// SPDX-License-Identifier: BSD-3-Clause
// Your own stages in the pipeline: the rotation comes from a gyroscope instead of the Manhattan frame, and
// the map from a survey instead of the first frames. What is not needed is left out by null models.
#include <cmath>
#include <cstdio>
#include <vector>

#include "sslam/track/presets.hpp"

namespace {

using namespace sslam;

struct Gyroscope {
  SO3<double> cam_from_world;  // the latest reading
  double sigma = radians(0.1);

  RotationAnswer<double> rotate(const Frame<double>&, const SO3<double>&, const KnownAxes<double>&) const {
    const Mat3<double> covariance = Mat3<double>::Identity() * sigma * sigma;
    return {.seen = {{.rotation = {cam_from_world, covariance}, .certain = true}}};
  }
  void lose() {}
  void forget() {}
};
static_assert(RotationStage<Gyroscope, double>);

// The first frame, whose pose is known, sees every marker of the survey in the survey's order.
struct Survey {
  std::vector<Vec3<double>> markers;

  Reason start(TrackedFrame<double>& frame, Map<double>& map) const {
    if (frame.frame.points.size() != markers.size()) return Reason::kTooFewFeatures;
    for (std::size_t i = 0; i < markers.size(); ++i) frame.point_landmarks[i] = map.add_point(markers[i], 0);
    map.add_keyframe(frame.to_keyframe());
    return Reason::kFine;
  }
  void reset() {}
};
static_assert(InitialisationStage<Survey, double>);

// The surveyed map stays as it is.
struct FixedMap {
  void begin(Map<double>&, TrackedFrame<double>&, double) {}
  KeyframeId insert(Map<double>&, TrackedFrame<double>&, double) { return kNone; }
};
static_assert(MappingStage<FixedMap, double>);

// Tracking from frame to frame, with the stages above in place of its own.
using Localiser = presets::With<presets::Odometry<double>, slots::Rotation<Gyroscope>,
                                slots::Initialisation<Survey>, slots::Fallback<NoFallback<double>>,
                                slots::Keyframes<NoKeyframes<double>>, slots::Mapping<FixedMap>>;

std::vector<Vec3<double>> make_markers() {
  std::vector<Vec3<double>> markers;
  for (int row = -2; row <= 2; ++row)
    for (int column = -3; column <= 3; ++column)
      markers.emplace_back(0.4 * column, 0.4 * row, 3 + 0.2 * ((row + column) % 2));
  return markers;
}

// What a detector of the markers would hand over.
Frame<double> see(const std::vector<Vec3<double>>& markers, const SE3<double>& cam_from_world, int index) {
  Frame<double> frame;
  frame.index = index;
  frame.stamp = index / 30.0;
  frame.pinhole = {400, 400, 320, 240};
  frame.width = 640;
  frame.height = 480;
  for (std::size_t i = 0; i < markers.size(); ++i) {
    PointFeature<double> point;
    point.pixel = frame.pinhole.project(cam_from_world * markers[i]);
    Random bits(i);
    for (auto& word : point.descriptor.words) word = bits.next();
    frame.points.push_back(point);
  }
  return frame;
}

}  // namespace

int main() {
  Localiser pipeline;
  pipeline.initialisation.markers = make_markers();
  pipeline.evidence.options.first_factor =
      1;  // this rotation is as exact as it says, from the first frame on
  double worst = 0;
  int tracked = 0;
  for (int k = 0; k < 20; ++k) {
    const Vec3<double> centre(0.02 * k, 0.1 * std::sin(0.2 * k), 0.01 * k);
    const SO3<double> turned = SO3<double>::exp({0, 0.01 * k, 0.005 * k});
    pipeline.rotation.cam_from_world = turned;
    Frame<double> frame = see(pipeline.initialisation.markers, {turned, -(turned * centre)}, k);
    const TrackResult<double> result = pipeline.track(frame);
    if (result.state != State::kManhattan) continue;  // the decoupled way: rotation first, then translation
    ++tracked;
    worst = std::max(worst, (result.cam_from_world.inverse().translation - centre).norm());
  }
  std::printf("%d of 20 frames, off by %.1e m at most\n", tracked, worst);
  return tracked == 20 && worst < 1e-6 ? 0 : 1;
}
