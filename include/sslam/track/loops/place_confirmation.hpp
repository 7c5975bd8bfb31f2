// SPDX-License-Identifier: BSD-3-Clause
// When two maps may be joined, or a loop be closed that moves the map. A building has many windows of one
// kind: one thing that looks the same is not yet a place. A second one is, if it stands where the first one
// says.
#pragma once

#include <optional>
#include <vector>

#include "sslam/core/parameter.hpp"
#include "sslam/map/map.hpp"
#include "sslam/map/map_deformation.hpp"
#include "sslam/residual/line_reprojection.hpp"
#include "sslam/track/contract/loop.hpp"
#include "sslam/track/contract/place_match.hpp"
#include "sslam/track/loops/loop_evidence.hpp"

namespace sslam {

template <Scalar S>
struct PlaceConfirmationOptions {
  int min_new = 10;      // landmarks beside what the first place match showed
  S apart = S(0.1);      // from that, in the image, over its width
  S min_share = S(0.6);  // of them, that stand where the first place match says
  S reach = 15;          // pixels between that and where they are seen

  template <class Self, class Visit>
  static void parameters(Self& self, Visit&& visit) {
    visit("min_new", self.min_new, Unit::kCount, 1, 10000,
          "landmarks of a second sighting of a place, beside those of the first");
    visit("apart", self.apart, Unit::kShare, 0, 1, "of the image's width, between both");
    visit("min_share", self.min_share, Unit::kShare, 0, 1,
          "of them, that stand where the first sighting says");
    visit("reach", self.reach, Unit::kPixels, 0, 1000, "between that and where they are seen");
  }
};
static_assert(Described<PlaceConfirmationOptions<double>>);

template <Scalar S>
class PlaceConfirmation {
 public:
  PlaceConfirmationOptions<S> options;

  // Whether a place match and an earlier one bear each other out. `first` becomes the newer one where they
  // contradict each other.
  [[nodiscard]] bool confirmed(const Keyframe<S>& keyframe, const Map<S>& there, const Loop<S>& loop,
                               std::optional<PlaceMatch<S>>& first) const;

 private:
  struct Tally {
    int fresh = 0, near = 0;
  };

  [[nodiscard]] static Vec3<S> place(const PointLandmark<S>& point) { return point.position; }
  [[nodiscard]] static Vec3<S> place(const LineLandmark<S>& line) { return (line.start + line.end) / 2; }

  [[nodiscard]] Tally compare(const Keyframe<S>& keyframe, const Map<S>& there, const Loop<S>& loop,
                              const PlaceMatch<S>& first) const {
    const SE3<S> expected = carried(first.there_from_here, keyframe.cam_from_world);
    const Frame<S>& frame = keyframe.frame;
    const auto known =
        box_around<S>(first.places, frame, expected, options.apart * static_cast<S>(frame.width));
    Tally tally;
    const auto count = [&](const auto& seen, const auto& landmarks, auto is_near) {
      for (std::size_t i = 0; i < seen.size(); ++i) {
        if (seen[i] == kNone) continue;
        const auto& landmark = landmarks[there.index(seen[i])];
        const Vec3<S> in_camera = expected * place(landmark);
        const bool visible = in_camera.z() > 0;
        if (visible && known.contains(frame.pinhole.project(in_camera))) continue;
        ++tally.fresh;
        tally.near += visible && is_near(landmark, i);
      }
    };
    count(loop.point_landmarks, there.points, [&](const PointLandmark<S>& point, std::size_t i) {
      return (frame.pinhole.project(expected * point.position) - frame.points[i].pixel).norm() <
             options.reach;
    });
    count(loop.line_landmarks, there.lines, [&](const LineLandmark<S>& landmark, std::size_t i) {
      LineReprojection<S> line;
      return line_reprojection(frame.pinhole, expected, landmark.line, frame.lines[i].segment, line) &&
             line.error.cwiseAbs().maxCoeff() < options.reach;
    });
    return tally;
  }
};

template <Scalar S>
bool PlaceConfirmation<S>::confirmed(const Keyframe<S>& keyframe, const Map<S>& there, const Loop<S>& loop,
                                     std::optional<PlaceMatch<S>>& first) const {
  if (first) {
    const Tally tally = compare(keyframe, there, loop, *first);
    if (static_cast<S>(tally.near) >= options.min_share * static_cast<S>(tally.fresh))
      return tally.fresh >= options.min_new;
  }
  first = PlaceMatch<S>{loop.there_from_here(keyframe.cam_from_world), {}};
  for (const LandmarkId id : loop.point_landmarks)
    if (id != kNone) first->places.push_back(place(there.points[there.index(id)]));
  for (const LandmarkId id : loop.line_landmarks)
    if (id != kNone) first->places.push_back(place(there.lines[there.index(id)]));
  return false;
}

}  // namespace sslam
