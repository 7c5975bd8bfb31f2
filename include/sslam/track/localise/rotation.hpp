// SPDX-License-Identifier: BSD-3-Clause
// The rotation stage: where the Manhattan frame is seen, it gives each frame's rotation without drift.
#pragma once

#include <optional>
#include <vector>

#include "sslam/core/parameter.hpp"
#include "sslam/geometry/spread.hpp"
#include "sslam/manhattan/rotation.hpp"
#include "sslam/manhattan/search.hpp"
#include "sslam/track/contract/concepts.hpp"
#include "sslam/track/localise/manhattan_sightings.hpp"

namespace sslam {

template <Scalar S>
struct RotationOptions {
  SearchOptions<S> search;  // of a frame that is not known yet; its `rotation` options serve every later one
  // How far the axes that a frame shows are off, all walls and edges together: floor of every sigma. One
  // alone is off by more (squareness.hpp).
  S squareness = radians(S(0.1));
  S max_sigma = radians(S(1.5));  // largest standard deviation, about any axis, of a trusted rotation

  template <class Self, class Visit>
  static void parameters(Self& self, Visit&& visit) {
    visit("squareness", self.squareness, Unit::kDegrees, 0, 45,
          "how far the axes that a frame shows are off, all walls and edges together");
    visit("max_sigma", self.max_sigma, Unit::kDegrees, 0, 180,
          "largest standard deviation of a rotation that is trusted");
    visit_within("", self.search.rotation, visit);
    visit_within("search.", self.search, visit);
  }
};
static_assert(Described<RotationOptions<double>>);

template <Scalar S>
class ManhattanRotation {
 public:
  RotationOptions<S> options;
  ManhattanSightings<S> sightings;
  std::uint64_t seed = 1;

  // The rotation near the prediction. Which Manhattan frames there are, the caller says and keeps.
  RotationAnswer<S> rotate(const Frame<S>& frame, const SO3<S>& predicted_cam_from_world,
                           const KnownAxes<S>& known);

  // The frame has no pose after all: what was predicted of its rotation says nothing of an unknown Manhattan
  // frame.
  void lose() noexcept { sightings.see_nothing(); }
  // The world is another one.
  void forget() noexcept {
    sightings.forget();
    active_ = 0;
  }

 private:
  void gather_votes(const Frame<S>& frame) {
    votes_.clear();
    for (const LineFeature<S>& line : frame.lines)
      votes_.push_back(line_vote(line.segment, frame.pinhole, line.sigma));
    const auto& n = frame.normals;
    normals_ = {n.x.data(), n.y.data(), n.z.data(), n.weight.data(), n.size()};
    search_ = options.search;
    search_.rotation = search_.rotation.with_plane_sigma(static_cast<S>(n.plane_sigma));
  }

  // Near a frame that is known: the one seen last, or else another.
  [[nodiscard]] std::optional<std::size_t> track(const std::vector<SO3<S>>& known) {
    estimate_ = {};
    for (std::size_t i = 0; i < known.size(); ++i) {
      const std::size_t index = (active_ + i) % known.size();
      track(known[index]);
      if (degenerate()) return index;  // too little is seen to tell it from another
      if (usable(estimate_.status)) return name(index, known);
    }
    return std::nullopt;
  }

  void track(const SO3<S>& world_from_manhattan) {
    const ManhattanPrior<S> prior{predicted_ * world_from_manhattan};
    estimate_ = track_manhattan<S>(normals_, votes_, prior, search_.rotation, line_axes_);
  }

  // Nothing is seen near the frames that are known, or none is known.
  [[nodiscard]] std::optional<std::size_t> look_around(const KnownAxes<S>& known) {
    estimate_ = find_manhattan<S>(normals_, votes_, search_, seed, line_axes_);
    if (!usable(estimate_.status) || estimate_.axes_seen < 2) {
      sightings.see_nothing();
      return std::nullopt;
    }
    if (known.world_fixed || !known.world_from_manhattan.empty())
      return name(std::nullopt, known.world_from_manhattan);
    discovered_ = SO3<S>();  // this frame becomes the axes of the world
    return 0;
  }

  // Which frame the estimate shows. Unless it was found near that one, it is estimated anew by the names that
  // frame's axes have.
  [[nodiscard]] std::optional<std::size_t> name(std::optional<std::size_t> near,
                                                const std::vector<SO3<S>>& known) {
    const SO3<S> world_from_manhattan = predicted_.inverse() * estimate_.cam_from_manhattan;
    const std::optional<std::size_t> index = sightings.which(known, world_from_manhattan);
    if (index) {
      if (index != near) track(known[*index]);
      return usable(estimate_.status) || degenerate() ? index : std::nullopt;
    }
    discovered_ = sightings.see_unknown(known.size(), world_from_manhattan);
    if (!discovered_) return std::nullopt;
    return known.size();
  }

  RotationAnswer<S> answer(std::size_t index, const std::vector<SO3<S>>& known) {
    active_ = index;
    const SO3<S>& world_from_manhattan = discovered_ ? *discovered_ : known[index];
    sightings.see(index, world_from_manhattan, predicted_.inverse() * estimate_.cam_from_manhattan);
    RotationObservation<S> rotation;
    rotation.cam_from_world = estimate_.cam_from_manhattan * world_from_manhattan.inverse();
    rotation.covariance =
        estimate_.covariance + options.squareness * options.squareness * Mat3<S>::Identity();
    const bool certain = largest_sigma<S>(rotation.covariance) < options.max_sigma;
    return {{{rotation, certain, index}}, estimate_.axes_seen, line_axes_, discovered_, normal_axes()};
  }

  [[nodiscard]] NormalAxes<S> normal_axes() const {
    NormalAxes<S> seen;
    for (int k = 0; k < 3; ++k) {
      const AxisSupport<S>& axis = estimate_.axes[static_cast<std::size_t>(k)];
      if (!axis.by_normals) continue;
      Vec3<S> direction = Vec3<S>::Unit(k);
      direction[(k + 1) % 3] = axis.mode[0];
      direction[(k + 2) % 3] = axis.mode[1];
      seen[static_cast<std::size_t>(k)] = (estimate_.cam_from_manhattan * direction).normalized();
    }
    return seen;
  }

  [[nodiscard]] bool degenerate() const noexcept { return estimate_.status == Status::kDegenerate; }

  // Of the frame in hand.
  SO3<S> predicted_;
  NormalView<float> normals_;
  std::vector<LineVote<S>> votes_;
  SearchOptions<S> search_;
  ManhattanEstimate<S> estimate_;
  std::vector<std::int8_t> line_axes_;
  std::optional<SO3<S>> discovered_;

  std::size_t active_ = 0;  // the Manhattan frame that was seen last
};

template <Scalar S>
RotationAnswer<S> ManhattanRotation<S>::rotate(const Frame<S>& frame, const SO3<S>& predicted_cam_from_world,
                                               const KnownAxes<S>& known) {
  gather_votes(frame);
  predicted_ = predicted_cam_from_world;
  line_axes_.assign(frame.lines.size(), kNone);
  discovered_.reset();
  std::optional<std::size_t> index = track(known.world_from_manhattan);
  if (!index && !usable(estimate_.status) && !degenerate()) index = look_around(known);
  if (index) return answer(*index, known.world_from_manhattan);
  RotationAnswer<S> nothing;
  if (usable(estimate_.status)) nothing.axes_seen = estimate_.axes_seen;
  return nothing;
}
static_assert(RotationStage<ManhattanRotation<double>, double>);

// No Manhattan world: every frame takes the fallback.
template <Scalar S>
struct NoRotation {
  RotationAnswer<S> rotate(const Frame<S>&, const SO3<S>&, const KnownAxes<S>&) { return {}; }
  void lose() noexcept {}
  void forget() noexcept {}
};
static_assert(RotationStage<NoRotation<double>, double>);

}  // namespace sslam
