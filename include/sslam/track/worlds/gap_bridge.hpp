// SPDX-License-Identifier: BSD-3-Clause
// Bridges short gaps of a trajectory: frames that the map does not hold, as in a turn towards a wall that no
// keyframe has seen from two places. How the camera turns is measured from frame to frame, by the features
// that both show; where it is, is taken from the ends of the gap.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "sslam/core/parameter.hpp"
#include "sslam/track/matching/frame_turn.hpp"
#include "sslam/track/worlds/trajectory_log.hpp"

namespace sslam {

template <Scalar S>
struct GapBridgeOptions {
  double longest = 1.2;         // seconds between the poses at both ends; 0: no gap is bridged
  S max_error = radians(S(5));  // between the turns that were measured and the pose at the far end

  template <class Self, class Visit>
  static void parameters(Self& self, Visit&& visit) {
    visit("longest", self.longest, Unit::kSeconds, 0, 60,
          "between two poses, for the frames between them to be bridged; 0: none is");
    visit("max_error", self.max_error, Unit::kDegrees, 0, 180,
          "between the turns measured across a gap and the pose at its far end");
  }
};
static_assert(Described<GapBridgeOptions<double>>);

template <Scalar S>
class GapBridge {
 public:
  GapBridgeOptions<S> options;

  template <class Self, class Visit>
  static void parameters(Self& self, Visit&& visit) {
    visit_within("", self.options, visit);
  }

  // Every gap among `frames`, in their order, that has a pose at both ends; the log is sorted.
  void run(std::span<const Frame<S>> frames, const Map<S>& map, TrajectoryLog<S>& log) {
    std::optional<std::size_t> begin;  // the last frame with a pose of its own
    for (std::size_t i = 0; i < frames.size(); ++i) {
      const TrajectoryEntry<S>* end = log.find(frames[i].index);
      if (end == nullptr) continue;
      if (begin && *begin + 1 < i) {
        const TrajectoryEntry<S> known = *log.find(frames[*begin].index);
        const auto& poses = between(frames.subspan(*begin, i - *begin + 1),
                                    TrajectoryLog<S>::pose(map, known), TrajectoryLog<S>::pose(map, *end));
        for (std::size_t k = 0; k < poses.size(); ++k) {
          const Frame<S>& frame = frames[*begin + 1 + k];
          log.set(map, frame.index, frame.stamp, known.reference, poses[k], true);
        }
      }
      begin = i;
    }
  }

  // cam_from_world of the frames between the first and the last of `frames`, of which the poses are known.
  // Empty where the gap is too long, a turn cannot be measured, or the turns do not lead to the far end.
  // R_k = exp(k/n e) R_k,k-1 ... R_1,0 R_0 with e = Log(R_n (R_n,n-1 ... R_0)^-1): what the turns get wrong
  // is shared evenly. The camera's centre moves straight and at one speed.
  [[nodiscard]] const std::vector<SE3<S>>& between(std::span<const Frame<S>> frames, const SE3<S>& first,
                                                   const SE3<S>& last) {
    poses_.clear();
    const double seconds = frames.back().stamp - frames.front().stamp;
    if (frames.size() < 3 || !(seconds > 0 && seconds <= options.longest)) return poses_;
    SO3<S> rotation = first.rotation;
    for (std::size_t k = 1; k < frames.size(); ++k) {
      const std::optional<SO3<S>> turn = turn_.between(frames[k - 1], frames[k]);
      if (!turn) return nothing();
      rotation = *turn * rotation;
      if (k + 1 < frames.size()) poses_.push_back({rotation, Vec3<S>::Zero()});
    }
    const Vec3<S> error = (last.rotation * rotation.inverse()).log();
    if (!(error.norm() <= options.max_error)) return nothing();
    const Vec3<S> from = first.inverse().translation, to = last.inverse().translation;
    for (std::size_t k = 0; k < poses_.size(); ++k) {
      SE3<S>& pose = poses_[k];
      const S turned = static_cast<S>(k + 1) / static_cast<S>(frames.size() - 1);
      const S moved = static_cast<S>((frames[k + 1].stamp - frames.front().stamp) / seconds);
      pose.rotation = SO3<S>::exp(turned * error) * pose.rotation;
      pose.translation = -(pose.rotation * (from + moved * (to - from)));
    }
    return poses_;
  }

 private:
  const std::vector<SE3<S>>& nothing() noexcept {
    poses_.clear();
    return poses_;
  }

  FrameTurn<S> turn_;
  std::vector<SE3<S>> poses_;
};

}  // namespace sslam
