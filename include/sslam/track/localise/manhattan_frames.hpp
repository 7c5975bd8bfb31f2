// SPDX-License-Identifier: BSD-3-Clause
// The Manhattan frames of a world: a building may have several, as where a wing stands at an angle. They are
// told apart by how they stand in the world, remembered, and known again when they come back into view.
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

#include "sslam/manhattan/nearest_frame.hpp"

namespace sslam {

template <Scalar S>
class ManhattanFrames {
 public:
  int confirmations = 3;          // sightings in a row that make one believed
  S agreement = radians(S(2));    // between them
  S told_apart = radians(S(10));  // least angle between two frames, whatever their axes are called
  std::size_t most = 8;           // that are remembered; 1: the first frame of the world is its only one

  [[nodiscard]] bool empty() const noexcept { return known_.empty(); }
  [[nodiscard]] const std::vector<SO3<S>>& world_from_manhattan() const noexcept { return known_; }

  // Goes on with the frames of a map, or with none.
  void reset(const std::vector<SO3<S>>& world_from_manhattan) {
    known_ = world_from_manhattan;
    see_nothing();
    inconsistent_.reset();
  }

  // The world is not fixed yet: this frame becomes its axes.
  void begin() { reset({SO3<S>()}); }

  // Which of the frames one is that stands in the world like this. It is the one that was seen last as long
  // as it has not jumped since: poses that turn, as in a map that is wrong, do not make it another. After a
  // jump it is the nearest, if that is near enough; otherwise it is an unknown one, unless the poses had
  // turned before.
  [[nodiscard]] std::optional<std::size_t> which(const SO3<S>& world_from_manhattan) const {
    if (last_ && angle_between_frames(world_from_manhattan, last_->world_from_manhattan) < agreement)
      return last_->index;
    const S within = most > 1 ? told_apart : std::numeric_limits<S>::max();
    const std::optional<std::size_t> nearest = nearest_frame(known_, world_from_manhattan, within);
    return nearest ? nearest : inconsistent_;
  }

  void see(std::size_t index, const SO3<S>& world_from_manhattan) {
    last_ = Sighting{index, world_from_manhattan};
    inconsistent_.reset();
    if (angle_between_frames(world_from_manhattan, known_[index]) > told_apart / 2) inconsistent_ = index;
    candidate_.reset();
  }

  void see_nothing() noexcept {
    last_.reset();
    candidate_.reset();
  }

  // A frame that is none of those known. It becomes one, and true is answered, once it has been met often
  // enough in a row.
  bool see_unknown(const SO3<S>& world_from_manhattan) {
    last_.reset();
    if (known_.size() >= most) return false;
    const SO3<S> named =
        candidate_ ? closest_naming(world_from_manhattan, *candidate_) : world_from_manhattan;
    if (!candidate_ || angle_between(named, *candidate_) >= agreement) {
      candidate_ = named;
      agreed_ = 1;
      return false;
    }
    ++agreed_;
    const Vec3<S> off = (candidate_->inverse() * named).log();
    candidate_ = *candidate_ * SO3<S>::exp(off / static_cast<S>(agreed_));  // their mean
    if (agreed_ < confirmations) return false;
    known_.push_back(*candidate_);
    candidate_.reset();
    return true;
  }

 private:
  struct Sighting {
    std::size_t index;
    SO3<S> world_from_manhattan;
  };

  std::vector<SO3<S>> known_;
  std::optional<Sighting> last_;             // what the last image showed
  std::optional<std::size_t> inconsistent_;  // the frame that the poses had turned away from when it was seen
  std::optional<SO3<S>> candidate_;          // for another frame
  int agreed_ = 0;
};

}  // namespace sslam
