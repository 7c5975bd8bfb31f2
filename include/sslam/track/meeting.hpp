// SPDX-License-Identifier: BSD-3-Clause
// When two maps may be joined, or a loop be closed that moves the map. A building has many windows of one
// kind: one thing that looks the same is not yet a place. A second one is, if it stands where the first one
// says.
#pragma once

#include <optional>
#include <unordered_set>
#include <vector>

#include "sslam/map/map.hpp"
#include "sslam/map/map_deformation.hpp"
#include "sslam/residual/line_reprojection.hpp"
#include "sslam/track/loop.hpp"

namespace sslam {

// A keyframe of one map, here, was found in another, there; or elsewhere in the same one.
template <Scalar S>
struct Meeting {
  Sim3<S> there_from_here;
  std::unordered_set<LandmarkId> points, lines;  // of there, that it saw
};

template <Scalar S>
class MeetingCheck {
 public:
  int min_new = 10;      // landmarks that the first meeting did not show
  S min_share = S(0.6);  // of them, that stand where the first meeting says
  S reach = 30;          // pixels between that and where they are seen

  // Whether a meeting and an earlier one bear each other out. `first` becomes the newer one where they
  // contradict each other.
  [[nodiscard]] bool confirmed(const Keyframe<S>& keyframe, const Map<S>& there, const Loop<S>& loop,
                               std::optional<Meeting<S>>& first) const {
    if (first) {
      const Tally tally = compare(keyframe, there, loop, *first);
      if (static_cast<S>(tally.near) >= min_share * static_cast<S>(tally.fresh))
        return tally.fresh >= min_new;
    }
    first = Meeting<S>{loop.there_from_here(keyframe.cam_from_world), seen(loop.point_landmarks),
                       seen(loop.line_landmarks)};
    return false;
  }

 private:
  struct Tally {
    int fresh = 0, near = 0;
  };

  [[nodiscard]] Tally compare(const Keyframe<S>& keyframe, const Map<S>& there, const Loop<S>& loop,
                              const Meeting<S>& first) const {
    const SE3<S> expected = carried(first.there_from_here, keyframe.cam_from_world);
    const Frame<S>& frame = keyframe.frame;
    Tally tally;
    const auto count = [&](const auto& landmarks, const auto& known, auto is_near) {
      for (std::size_t i = 0; i < landmarks.size(); ++i) {
        if (landmarks[i] == kNone || known.contains(landmarks[i])) continue;
        ++tally.fresh;
        tally.near += is_near(Map<S>::index(landmarks[i]), i);
      }
    };
    count(loop.point_landmarks, first.points, [&](std::size_t id, std::size_t i) {
      const Vec3<S> in_camera = expected * there.points[id].position;
      return in_camera.z() > 0 && (frame.pinhole.project(in_camera) - frame.points[i].pixel).norm() < reach;
    });
    count(loop.line_landmarks, first.lines, [&](std::size_t id, std::size_t i) {
      LineReprojection<S> line;
      return line_reprojection(frame.pinhole, expected, there.lines[id].line, frame.lines[i].segment, line) &&
             line.error.cwiseAbs().maxCoeff() < reach;
    });
    return tally;
  }

  [[nodiscard]] static std::unordered_set<LandmarkId> seen(const std::vector<LandmarkId>& landmarks) {
    std::unordered_set<LandmarkId> ids(landmarks.begin(), landmarks.end());
    ids.erase(kNone);
    return ids;
  }
};

}  // namespace sslam
