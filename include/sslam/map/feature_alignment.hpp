// SPDX-License-Identifier: BSD-3-Clause
// Features that see one landmark, laid over each other. A corner detector places each by itself, and no two
// in the same way. Where their patches are compared, warped as the surface and the poses say, they agree
// twice as well.
#pragma once

#include <cmath>
#include <optional>
#include <span>

#include "sslam/core/parameter.hpp"
#include "sslam/image/patch_alignment.hpp"
#include "sslam/map/map.hpp"
#include "sslam/residual/point_reprojection.hpp"

namespace sslam {

struct FeatureAlignmentOptions {
  PatchAlignmentOptions patch;

  template <class Self, class Visit>
  static void parameters(Self& self, Visit&& visit) {
    visit("max_shift", self.patch.max_shift, Unit::kPixels, 0, 2,
          "by which a feature is moved, of its level; 0: features stay where they were detected");
    visit("min_correlation", self.patch.min_correlation, Unit::kNumber, 0, 1,
          "of the patches of two views, where a feature is moved");
  }
};
static_assert(Described<FeatureAlignmentOptions>);

template <Scalar S>
class FeatureAlignment {
 public:
  FeatureAlignmentOptions options;

  // Moves the frame's point features to where they show what their landmark's middle observation shows.
  // `seen`: their landmarks, kNone where there is none. Returns how many were moved; those whose patches are
  // not known, or not alike, stay.
  int align(const Map<S>& map, const SE3<S>& cam_from_world, std::span<const LandmarkId> seen,
            Frame<S>& frame) {
    if (frame.patches.empty() || !(options.patch.max_shift > 0)) return 0;
    patches_.options = options.patch;
    int moved = 0;
    for (std::size_t i = 0; i < seen.size(); ++i)
      if (seen[i] != kNone && move(map, map.points[map.index(seen[i])], cam_from_world, frame, i)) ++moved;
    return moved;
  }

  // The same for the keyframes of a map.
  int align(Map<S>& map) {
    int moved = 0;
    for (Keyframe<S>& keyframe : map.keyframes)
      if (keyframe.alive())
        moved += align(map, keyframe.cam_from_world, keyframe.point_landmarks.values(), keyframe.frame);
    return moved;
  }

 private:
  // Whether feature i of the frame was moved.
  bool move(const Map<S>& map, const PointLandmark<S>& landmark, const SE3<S>& cam_from_world,
            Frame<S>& frame, std::size_t i) {
    PointFeature<S>& feature = frame.points[i];
    FeaturePatch* patch = patch_of(frame, feature);
    if (patch == nullptr || landmark.observations.empty()) return false;
    const Observation& middle = middle_observation(map, landmark);
    const Keyframe<S>& keyframe = map.keyframes[map.index(middle.keyframe)];
    if (keyframe.made_of(frame)) return false;
    const PointFeature<S>& original = keyframe.frame.points[map.index(middle.feature)];
    const FeaturePatch* reference = patch_of(keyframe.frame, original);
    if (reference == nullptr) return false;
    const auto turned = pixels_over(map, landmark, keyframe, original, cam_from_world, frame);
    if (!turned) return false;
    const Mat2<float> current_from_reference = patch->spacing.inverse() * *turned * reference->spacing;
    const auto shift = patches_.align(*reference, *patch, current_from_reference);
    if (!shift) return false;
    patch->centre += *shift;
    feature.pixel += (patch->spacing * *shift).template cast<S>();
    return true;
  }

  // That which sees the landmark most nearly from the mean of all directions: what is compared differs least.
  [[nodiscard]] static const Observation& middle_observation(const Map<S>& map,
                                                             const PointLandmark<S>& landmark) noexcept {
    const auto nearness = [&](const Observation& o) {
      const SE3<S>& pose = map.keyframes[map.index(o.keyframe)].cam_from_world;
      const Vec3<S> to_camera = -(pose.rotation.inverse() * pose.translation) - landmark.position;
      return to_camera.dot(landmark.viewing_direction) / to_camera.norm();
    };
    const Observation* middle = &landmark.observations.front();
    S nearest = nearness(*middle);
    for (const Observation& o : landmark.observations)
      if (const S near = nearness(o); near > nearest) middle = &o, nearest = near;
    return *middle;
  }

  template <class AnyFrame>
  [[nodiscard]] static auto patch_of(AnyFrame& frame, const PointFeature<S>& feature) noexcept
      -> decltype(frame.patches.data()) {
    const auto i = static_cast<std::size_t>(feature.patch);
    return feature.patch != kNone && i < frame.patches.size() ? &frame.patches[i] : nullptr;
  }

  // How undistorted pixels of the keyframe go over into those of the frame, around the landmark: on its
  // plane, or on one that faces the keyframe. Nothing where it is seen from behind or along the surface.
  [[nodiscard]] static std::optional<Mat2<float>> pixels_over(
      const Map<S>& map, const PointLandmark<S>& landmark, const Keyframe<S>& keyframe,
      const PointFeature<S>& original, const SE3<S>& cam_from_world, const Frame<S>& frame) noexcept {
    const SE3<S> current_from_keyframe = cam_from_world * keyframe.cam_from_world.inverse();
    const Vec3<S> position = keyframe.cam_from_world * landmark.position;
    const Vec3<S> normal =
        landmark.plane == kNone
            ? position
            : Vec3<S>(keyframe.cam_from_world.rotation * map.planes[map.index(landmark.plane)].plane.normal);
    const S distance = normal.dot(position);
    constexpr S kGrazing = S(0.2);  // cosine
    if (!(std::abs(distance) > kGrazing * normal.norm() * position.norm())) return std::nullopt;
    Mat2<float> over;
    for (int axis = 0; axis < 2; ++axis) {
      const Vec2<S> step = 2 * original.sigma * Vec2<S>::Unit(axis);
      Vec2<S> ends[2];
      for (int side = 0; side < 2; ++side) {
        const Vec2<S> pixel = original.pixel + (side == 0 ? step : Vec2<S>(-step));
        const Vec3<S> ray = keyframe.frame.pinhole.unproject(pixel);
        const S reach = distance / normal.dot(ray);
        const Vec3<S> seen = current_from_keyframe * Vec3<S>(reach * ray);
        if (!(reach > 0) || !(seen.z() > kMinDepth<S>)) return std::nullopt;
        ends[side] = frame.pinhole.project(seen);
      }
      over.col(axis) = ((ends[0] - ends[1]) / (2 * step.norm())).template cast<float>();
    }
    constexpr float kMostShrunk = 0.4F, kMostGrown = 2.5F;  // areas
    const float area = over.determinant();
    if (!(area > kMostShrunk && area < kMostGrown)) return std::nullopt;
    return over;
  }

  PatchAlignment patches_;
};

}  // namespace sslam
