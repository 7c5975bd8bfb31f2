// SPDX-License-Identifier: BSD-3-Clause
// The rotation stage: where the Manhattan frame is seen, it gives each frame's rotation without drift.
#pragma once

#include <cmath>
#include <optional>
#include <vector>

#include "sslam/manhattan/rotation.hpp"
#include "sslam/manhattan/search.hpp"
#include "sslam/track/tracked_frame.hpp"

namespace sslam {

template <Scalar S>
struct RotationAnswer {
  int axes_seen = 0;
  bool trusted = false;  // all three degrees of freedom are known well enough to fix them
};

template <Scalar S>
class ManhattanRotation {
 public:
  SearchOptions<S> search;  // of the first frame; its `rotation` options serve every later one
  std::uint64_t seed = 1;
  S squareness = radians(S(0.5));  // how far walls and edges stand from right angles: floor of every sigma
  S max_sigma = radians(S(1.5));   // largest standard deviation, about any axis, of a trusted rotation
  int confirmations = 3;        // frames in a row that must agree before a late Manhattan frame is believed
  S agreement = radians(S(2));  // between them

  // Estimates the frame's rotation near the prediction and leaves it, with the axes of its lines, in the
  // frame. `mapped` says whether the world is already fixed: before, the first Manhattan frame becomes the
  // world.
  RotationAnswer<S> rotate(TrackedFrame<S>& frame, const SO3<S>& predicted_cam_from_world, bool mapped) {
    gather_votes(frame.frame);
    const auto& n = frame.frame.normals;
    const NormalView<float> normals{n.x.data(), n.y.data(), n.z.data(), n.weight.data(), n.size()};
    frame.line_axes.assign(frame.frame.lines.size(), kNone);
    SearchOptions<S> options = search;
    options.rotation = search.rotation.with_plane_sigma(static_cast<S>(n.plane_sigma));
    ManhattanEstimate<S> estimate;
    if (world_from_manhattan_) {
      const ManhattanPrior<S> prior{predicted_cam_from_world * *world_from_manhattan_};
      estimate = track_manhattan<S>(normals, votes_, prior, options.rotation, frame.line_axes);
    } else {
      estimate = find(normals, options, predicted_cam_from_world, mapped, frame);
    }
    const bool seen = usable(estimate.status) || estimate.status == Status::kDegenerate;
    if (!seen || !world_from_manhattan_) return {};
    return answer(estimate, frame);
  }

  [[nodiscard]] const std::optional<SO3<S>>& world_from_manhattan() const noexcept {
    return world_from_manhattan_;
  }
  // Goes on with the Manhattan frame of a map, or with none.
  void reset(const std::optional<SO3<S>>& world_from_manhattan) {
    world_from_manhattan_ = world_from_manhattan;
    candidate_.reset();
  }

 private:
  void gather_votes(const Frame<S>& frame) {
    votes_.clear();
    for (const LineFeature<S>& line : frame.lines)
      votes_.push_back(line_vote(line.segment, frame.pinhole, line.sigma));
  }

  ManhattanEstimate<S> find(const NormalView<float>& normals, const SearchOptions<S>& options,
                            const SO3<S>& predicted, bool mapped, TrackedFrame<S>& frame) {
    ManhattanEstimate<S> estimate = find_manhattan<S>(normals, votes_, options, seed, frame.line_axes);
    if (!usable(estimate.status) || estimate.axes_seen < 2) {
      candidate_.reset();
      return estimate;
    }
    if (!mapped) {
      world_from_manhattan_ = SO3<S>();
      return estimate;
    }
    const SO3<S> world_from_manhattan = predicted.inverse() * estimate.cam_from_manhattan;
    const SO3<S> named =
        candidate_ ? closest_naming(world_from_manhattan, *candidate_) : world_from_manhattan;
    if (candidate_ && angle_between(named, *candidate_) < agreement) {
      if (++agreed_ >= confirmations) world_from_manhattan_ = named;
    } else {
      candidate_ = named;
      agreed_ = 1;
    }
    return estimate;
  }

  RotationAnswer<S> answer(const ManhattanEstimate<S>& estimate, TrackedFrame<S>& frame) const {
    RotationObservation<S> observation;
    observation.cam_from_world = estimate.cam_from_manhattan * world_from_manhattan_->inverse();
    observation.covariance = estimate.covariance + squareness * squareness * Mat3<S>::Identity();
    frame.manhattan = observation;
    const Eigen::SelfAdjointEigenSolver<Mat3<S>> eigen(observation.covariance, Eigen::EigenvaluesOnly);
    return {estimate.axes_seen, std::sqrt(eigen.eigenvalues().z()) < max_sigma};
  }

  std::vector<LineVote<S>> votes_;
  std::optional<SO3<S>> world_from_manhattan_;
  std::optional<SO3<S>> candidate_;  // of a late Manhattan frame, world from Manhattan
  int agreed_ = 0;
};

// No Manhattan world: every frame takes the fallback.
template <Scalar S>
struct NoRotation {
  RotationAnswer<S> rotate(TrackedFrame<S>&, const SO3<S>&, bool) { return {}; }
  [[nodiscard]] std::optional<SO3<S>> world_from_manhattan() const noexcept { return std::nullopt; }
  void reset(const std::optional<SO3<S>>&) {}
};

}  // namespace sslam
