// SPDX-License-Identifier: BSD-3-Clause
// Every kernel once, on the inputs of a frame, with all that it writes to made beforehand.
#pragma once

#include "sslam/geometry/nearest_rotation.hpp"
#include "sslam/manhattan/search.hpp"
#include "sslam/solver/two_view/find_relative_pose.hpp"
#include "sslam/solver/two_view/plane_motion.hpp"
#include "sslam/solver/two_view/translation.hpp"
#include "support/room_frame.hpp"

namespace sslam::testing {

template <Scalar S>
class KernelCalls {
 public:
  explicit KernelCalls(const RoomFrame<S>& room)
      : room_(room),
        R_10_(room.current.rotation * room.previous.rotation.inverse()),
        axis_of_(room.votes.size()),
        match_inliers_(room.matches.size()),
        point_inliers_(room.points.size()),
        line_inliers_(room.lines.size()) {
    // As if every first ray met one wall.
    for (const BearingMatch<S>& match : room.matches) {
      const Vec3<S> seen = R_10_ * match.ray0 + match.ray0.z() * Vec3<S>(S(0.1), S(-0.05), S(0.02));
      on_wall_.push_back({match.ray0, seen / seen.z(), match.sigma});
    }
  }

  // visit(name, call): call() does the work and says whether the kernel answered kOk.
  template <class Visit>
  void for_each(Visit visit) {
    visit("track_manhattan", [this] { return usable(track().status); });
    visit("find_manhattan",
          [this] { return usable(find_manhattan<S>(room_.normals(), room_.votes, {}, 1, axis_of_).status); });
    visit("frame_moments", [this] {
      return frame_moments<S>(room_.normals(), room_.current.rotation.matrix(), radians(S(5)))[0].mass > 0;
    });
    visit("nearest_rotation", [this] {
      SO3<S> out;
      return usable(nearest_rotation<S>(S(0.9) * R_10_.matrix(), out));
    });
    visit("translation_from_rotation", [this] { return usable(translate(R_10_).status); });
    visit("plane_motion", [this] {
      return usable(plane_motion<S>(on_wall_, R_10_, Vec3<S>::UnitZ(), {}, 1, match_inliers_).status);
    });
    visit("rotation_from_bearings",
          [this] { return rotation_from_bearings<S>(room_.matches, {}, 1, match_inliers_).inliers > 0; });
    visit("refine_relative_pose", [this] {
      SO3<S> R = R_10_;
      Vec3<S> t = room_.current.translation - R_10_ * room_.previous.translation;
      return usable(refine_relative_pose<S>(room_.matches, R, t, {}, match_inliers_).status);
    });
    visit("find_relative_pose", [this] {
      SO3<S> R;
      Vec3<S> t;
      return usable(find_relative_pose<S>(room_.matches, {}, 1, R, t, match_inliers_).status);
    });
    for_each_of_the_map(visit);
  }

 private:
  template <class Visit>
  void for_each_of_the_map(Visit& visit) {
    visit("triangulate_point", [this] {
      return usable(triangulate_point<S>(std::span<const PointView<S>>(room_.point_views)).status);
    });
    visit("triangulate_line", [this] { return usable(triangulate_line<S>(room_.line_views).status); });
    visit("refine_pose", [this] { return refine(near_pose(), nullptr); });
    visit("refine_translation", [this] {
      SE3<S> pose = near_pose();
      pose.rotation = room_.current.rotation;
      return usable(refine_translation<S>(room_.pinhole, room_.points, room_.lines, pose, {}, point_inliers_,
                                          line_inliers_)
                        .status);
    });
    visit("minimize", [] {
      Euclidean<S, 2> x;
      return usable(minimize(Bowl{}, x).status);
    });
    // As a pipeline strings them together: rotation from structure, translation, then the pose.
    visit("one frame", [this] {
      const ManhattanEstimate<S> seen = track();
      const SO3<S> R_10 = seen.cam_from_manhattan * room_.previous.rotation.inverse();
      const TranslationEstimate<S> moved = translate(R_10);
      const S step = (room_.current.translation - R_10_ * room_.previous.translation).norm();
      const SE3<S> start{seen.cam_from_manhattan, R_10 * room_.previous.translation + step * moved.t_10};
      const RotationPrior<S> prior{seen.cam_from_manhattan, seen.covariance.inverse()};
      return usable(seen.status) && usable(moved.status) && refine(start, &prior);
    });
  }

  // (x0 - 1)^2 + (x0 x1 - 2)^2
  struct Bowl {
    S operator()(const Euclidean<S, 2>& x, NormalEquations<S, 2>& equations) const noexcept {
      const S r0 = x.value[0] - 1, r1 = x.value[0] * x.value[1] - 2;
      equations.add({S(1), S(0)}, r0, S(1));
      equations.add({x.value[1], x.value[0]}, r1, S(1));
      return r0 * r0 + r1 * r1;
    }
  };

  [[nodiscard]] ManhattanEstimate<S> track() {
    const Vec3<S> off(radians(S(3)), radians(S(-2)), radians(S(2)));
    return track_manhattan<S>(room_.normals(), room_.votes, {room_.current.rotation.retract(off)}, {},
                              axis_of_);
  }
  [[nodiscard]] TranslationEstimate<S> translate(const SO3<S>& R_10) {
    TranslationOptions<S> options;
    options.rotation_sigma = radians(S(0.1));
    return translation_from_rotation<S>(room_.matches, R_10, options, 1, match_inliers_);
  }
  [[nodiscard]] SE3<S> near_pose() const {
    Vec6<S> off;
    off << S(0.01), S(-0.01), S(0.005), S(0.03), S(-0.02), S(0.04);
    return room_.current.retract(off);
  }
  [[nodiscard]] bool refine(SE3<S> pose, const RotationPrior<S>* prior) {
    return usable(refine_pose<S>(room_.pinhole, room_.points, room_.lines, pose, {}, point_inliers_,
                                 line_inliers_, prior)
                      .status);
  }

  const RoomFrame<S>& room_;
  SO3<S> R_10_;
  std::vector<BearingMatch<S>> on_wall_;
  std::vector<std::int8_t> axis_of_;
  std::vector<std::uint8_t> match_inliers_, point_inliers_, line_inliers_;
};

}  // namespace sslam::testing
