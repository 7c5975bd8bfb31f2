// SPDX-License-Identifier: BSD-3-Clause
// The rotation stage: where the Manhattan frame is seen, it gives each frame's rotation without drift.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "sslam/manhattan/rotation.hpp"
#include "sslam/manhattan/search.hpp"
#include "sslam/map/manhattan_axes.hpp"
#include "sslam/track/contract/tracked_frame.hpp"
#include "sslam/track/localise/manhattan_frames.hpp"

namespace sslam {

template <Scalar S>
struct RotationAnswer {
  int axes_seen = 0;
  bool trusted = false;  // all three degrees of freedom are known well enough to fix them
};

template <Scalar S>
class ManhattanRotation {
 public:
  SearchOptions<S> search;  // of a frame that is not known yet; its `rotation` options serve every later one
  ManhattanFrames<S> frames;
  std::uint64_t seed = 1;
  S squareness = radians(S(0.1));  // how far walls and edges stand from right angles: floor of every sigma
  S max_sigma = radians(S(1.5));   // largest standard deviation, about any axis, of a trusted rotation

  // Estimates the frame's rotation near the prediction and leaves it, with the axes of its lines, in the
  // frame. `mapped` says whether the world is already fixed: before, the first Manhattan frame becomes the
  // world.
  RotationAnswer<S> rotate(TrackedFrame<S>& frame, const SO3<S>& predicted_cam_from_world, bool mapped) {
    gather_votes(frame.frame);
    predicted_ = predicted_cam_from_world;
    frame.line_axes.assign(frame.frame.lines.size(), kNone);
    frame.manhattan.reset();
    std::optional<std::size_t> index = track(frame);
    if (!index && !usable(estimate_.status) && !degenerate()) index = look_around(frame, mapped);
    if (index) return answer(*index, frame);
    std::fill(frame.line_axes.begin(), frame.line_axes.end(), std::int8_t{kNone});
    return {usable(estimate_.status) ? estimate_.axes_seen : 0};
  }

  // One for each Manhattan frame.
  [[nodiscard]] const std::vector<SO3<S>>& world_from_manhattan() const noexcept {
    return frames.world_from_manhattan();
  }
  // The frame has no pose after all: what was predicted of its rotation says nothing of an unknown Manhattan
  // frame.
  void lose() noexcept { frames.see_nothing(); }
  // Goes on with the Manhattan frames of a map, or with none.
  void reset(const std::vector<SO3<S>>& world_from_manhattan) {
    frames.reset(world_from_manhattan);
    active_ = 0;
  }

 private:
  void gather_votes(const Frame<S>& frame) {
    votes_.clear();
    for (const LineFeature<S>& line : frame.lines)
      votes_.push_back(line_vote(line.segment, frame.pinhole, line.sigma));
    const auto& n = frame.normals;
    normals_ = {n.x.data(), n.y.data(), n.z.data(), n.weight.data(), n.size()};
    options_ = search;
    options_.rotation = search.rotation.with_plane_sigma(static_cast<S>(n.plane_sigma));
  }

  // Near a frame that is known: the one seen last, or else another.
  [[nodiscard]] std::optional<std::size_t> track(TrackedFrame<S>& frame) {
    estimate_ = {};
    const std::size_t count = frames.world_from_manhattan().size();
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t index = (active_ + i) % count;
      track(index, frame);
      if (degenerate()) return index;  // too little is seen to tell it from another
      if (usable(estimate_.status)) return name(index, frame);
    }
    return std::nullopt;
  }

  void track(std::size_t index, TrackedFrame<S>& frame) {
    const ManhattanPrior<S> prior{predicted_ * frames.world_from_manhattan()[index]};
    estimate_ = track_manhattan<S>(normals_, votes_, prior, options_.rotation, frame.line_axes);
  }

  // Nothing is seen near the frames that are known, or none is known.
  [[nodiscard]] std::optional<std::size_t> look_around(TrackedFrame<S>& frame, bool mapped) {
    estimate_ = find_manhattan<S>(normals_, votes_, options_, seed, frame.line_axes);
    if (!usable(estimate_.status) || estimate_.axes_seen < 2) {
      frames.see_nothing();
      return std::nullopt;
    }
    if (mapped || !frames.empty()) return name(std::nullopt, frame);
    frames.begin();
    return 0;
  }

  // Which frame the estimate shows. Unless it was found near that one, it is estimated anew by the names that
  // frame's axes have.
  [[nodiscard]] std::optional<std::size_t> name(std::optional<std::size_t> near, TrackedFrame<S>& frame) {
    const SO3<S> world_from_manhattan = predicted_.inverse() * estimate_.cam_from_manhattan;
    const std::optional<std::size_t> index = frames.which(world_from_manhattan);
    if (index) {
      if (index != near) track(*index, frame);
      return usable(estimate_.status) || degenerate() ? index : std::nullopt;
    }
    if (!frames.see_unknown(world_from_manhattan)) return std::nullopt;
    return frames.world_from_manhattan().size() - 1;
  }

  RotationAnswer<S> answer(std::size_t index, TrackedFrame<S>& frame) {
    active_ = index;
    frames.see(index, predicted_.inverse() * estimate_.cam_from_manhattan);
    for (std::int8_t& axis : frame.line_axes) axis = axis_number(frames.world_from_manhattan(), index, axis);
    RotationObservation<S> observation;
    observation.cam_from_world =
        estimate_.cam_from_manhattan * frames.world_from_manhattan()[index].inverse();
    observation.covariance = estimate_.covariance + squareness * squareness * Mat3<S>::Identity();
    frame.manhattan = observation;
    frame.manhattan_frame = index;
    const Eigen::SelfAdjointEigenSolver<Mat3<S>> eigen(observation.covariance, Eigen::EigenvaluesOnly);
    return {estimate_.axes_seen, std::sqrt(eigen.eigenvalues().z()) < max_sigma};
  }

  [[nodiscard]] bool degenerate() const noexcept { return estimate_.status == Status::kDegenerate; }

  // Of the frame in hand.
  SO3<S> predicted_;
  NormalView<float> normals_;
  std::vector<LineVote<S>> votes_;
  SearchOptions<S> options_;
  ManhattanEstimate<S> estimate_;

  std::size_t active_ = 0;  // the Manhattan frame that was seen last
};

// No Manhattan world: every frame takes the fallback.
template <Scalar S>
struct NoRotation {
  RotationAnswer<S> rotate(TrackedFrame<S>&, const SO3<S>&, bool) { return {}; }
  [[nodiscard]] std::vector<SO3<S>> world_from_manhattan() const { return {}; }
  void lose() noexcept {}
  void reset(const std::vector<SO3<S>>&) {}
};

}  // namespace sslam
