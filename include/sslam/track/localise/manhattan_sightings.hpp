// SPDX-License-Identifier: BSD-3-Clause
// Sightings of the Manhattan frames of a world: a building may have several, as where a wing stands at an
// angle. They are told apart by how they stand in the world, and known again when they come back into view.
// The map keeps them; what is remembered here is what the last images showed.
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "sslam/core/parameter.hpp"
#include "sslam/manhattan/nearest_frame.hpp"

namespace sslam {

template <Scalar S>
struct ManhattanSightingOptions {
  int confirmations = 3;          // sightings in a row that make one believed
  S agreement = radians(S(2));    // between them
  S told_apart = radians(S(10));  // least angle between two frames, whatever their axes are called
  std::size_t most = 8;           // that are remembered; 1: the first frame of the world is its only one

  template <class Self, class Visit>
  static void parameters(Self& self, Visit&& visit) {
    visit("frames", self.most, Unit::kCount, 1, 40,
          "Manhattan frames that are told apart; 1: the first is the only one");
    visit("told_apart", self.told_apart, Unit::kDegrees, 0, 55, "least angle between two Manhattan frames");
    visit("agreement", self.agreement, Unit::kDegrees, 0, 55,
          "between sightings of a Manhattan frame found late");
    visit("confirmations", self.confirmations, Unit::kCount, 1, 1000,
          "sightings in a row that make one believed");
  }
};
static_assert(Described<ManhattanSightingOptions<double>>);

template <Scalar S>
class ManhattanSightings {
 public:
  ManhattanSightingOptions<S> options;

  // Which of the known frames one is that stands in the world like this. It is the one that was seen last as
  // long as it has not jumped since: poses that turn, as in a map that is wrong, do not make it another.
  // After a jump it is the nearest, if that is near enough; otherwise it is an unknown one, unless the poses
  // had turned before.
  [[nodiscard]] std::optional<std::size_t> which(const std::vector<SO3<S>>& known,
                                                 const SO3<S>& world_from_manhattan) const {
    if (last_ && angle_between_frames(world_from_manhattan, last_->world_from_manhattan) < options.agreement)
      return last_->index;
    const S within = options.most > 1 ? options.told_apart : std::numeric_limits<S>::max();
    const std::optional<std::size_t> nearest = nearest_frame(known, world_from_manhattan, within);
    return nearest ? nearest : inconsistent_;
  }

  // One of those known is seen, which stands in the world as `known` says, like this.
  void see(std::size_t index, const SO3<S>& known, const SO3<S>& world_from_manhattan) {
    last_ = Sighting{index, world_from_manhattan};
    inconsistent_.reset();
    if (angle_between_frames(world_from_manhattan, known) > options.told_apart / 2) inconsistent_ = index;
    candidate_.reset();
  }

  void see_nothing() noexcept {
    last_.reset();
    candidate_.reset();
  }

  // A frame that is none of the `known`, so many. Once it has been met often enough in a row it is believed,
  // and the answer is how it stands in the world.
  [[nodiscard]] std::optional<SO3<S>> see_unknown(std::size_t known, const SO3<S>& world_from_manhattan) {
    last_.reset();
    if (known >= options.most) return std::nullopt;
    const SO3<S> named =
        candidate_ ? closest_naming(world_from_manhattan, *candidate_) : world_from_manhattan;
    if (!candidate_ || angle_between(named, *candidate_) >= options.agreement) {
      candidate_ = named;
      agreed_ = 1;
      return std::nullopt;
    }
    ++agreed_;
    const Vec3<S> off = (candidate_->inverse() * named).log();
    candidate_ = *candidate_ * SO3<S>::exp(off / static_cast<S>(agreed_));  // their mean
    if (agreed_ < options.confirmations) return std::nullopt;
    return std::exchange(candidate_, std::nullopt);
  }

  // The world is another one.
  void forget() noexcept {
    see_nothing();
    inconsistent_.reset();
  }

 private:
  struct Sighting {
    std::size_t index;
    SO3<S> world_from_manhattan;
  };

  std::optional<Sighting> last_;             // what the last image showed
  std::optional<std::size_t> inconsistent_;  // the frame that the poses had turned away from when it was seen
  std::optional<SO3<S>> candidate_;          // for another frame
  int agreed_ = 0;
};

}  // namespace sslam
