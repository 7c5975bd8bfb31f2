// SPDX-License-Identifier: BSD-3-Clause
// The map on trial: what speaks against it is a loss of track while it is young, and poses inconsistent to
// the Manhattan frame. A first Manhattan frame is on trial with the map that was begun by it.
#pragma once

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "sslam/core/parameter.hpp"
#include "sslam/map/map.hpp"
#include "sslam/track/contract/tracked_frame.hpp"
#include "sslam/track/worlds/drift_watch.hpp"

namespace sslam {

template <Scalar S>
struct MapTrialOptions {
  int young_map = 5;           // keyframes: a map lost while it has fewer is given up and started anew
  double give_up_after = 0.5;  // seconds of frames in a row that speak against it until that happens
  double leave_after = 1;      // the same for an older map, until it is left for a new one
  int telling_features = 50;   // points plus lines that make a lost frame speak against the map
  S max_turn = radians(S(5));  // between a pose and what the Manhattan frame says of its rotation, and
  S max_sigmas = 4;            // the same in standard deviations: beyond both they contradict each other

  template <class Self, class Visit>
  static void parameters(Self& self, Visit&& visit) {
    visit("young_map", self.young_map, Unit::kCount, 0, 1000000,
          "keyframes: a map that is lost with fewer is given up and begun anew");
    visit("give_up_after", self.give_up_after, Unit::kSeconds, 0, 3600,
          "of frames in a row that speak against a young map, until it is given up");
    visit("leave_after", self.leave_after, Unit::kSeconds, 0, 86400,
          "of frames in a row that show enough and have no pose, until a new map is begun");
    visit("telling_features", self.telling_features, Unit::kCount, 0, 1000000,
          "points plus lines that make a lost frame speak against the map");
    visit("max_turn", self.max_turn, Unit::kDegrees, 0, 180,
          "between a pose and what the Manhattan frame says of its rotation");
    visit("max_sigmas", self.max_sigmas, Unit::kNumber, 0, 1000,
          "the same in standard deviations: beyond both they contradict each other");
  }
};
static_assert(Described<MapTrialOptions<double>>);

template <Scalar S>
class MapTrial {
 public:
  MapTrialOptions<S> options;
  DriftWatch<S> drift;

  // With those of the drift.
  template <class Self, class Visit>
  static void parameters(Self& self, Visit&& visit) {
    visit_within("", self.options, visit);
    visit_within("drift.", self.drift.options, visit);
  }

  [[nodiscard]] bool young(const Map<S>& map) const noexcept {
    return static_cast<int>(map.keyframes.size()) < options.young_map;
  }
  [[nodiscard]] bool lost() const noexcept { return lost_; }

  // The place in a map that was not made here is yet to be found; however young, that map is not given up.
  void begin_in_given_map() noexcept { lost_ = given_ = true; }
  // One more frame is lost, so many seconds after the one before it. A covered lens says nothing about the
  // map; an image that shows enough and does not fit does.
  void add_lost(const Frame<S>& frame, double seconds) noexcept {
    lost_ = true;
    if (static_cast<int>(frame.points.size() + frame.lines.size()) >= options.telling_features)
      unfit_ += seconds;
  }
  void end_loss() noexcept {
    lost_ = false;
    unfit_ = 0;
  }

  // A frame has a pose that so many points and lines hold, so many seconds after the frame before it; `held`:
  // within the error that its Manhattan rotation claims. A first map whose depths are wrong, as two views of
  // a flat scene can leave it, turns the camera as it moves; the Manhattan frame does not turn along. A wrong
  // Manhattan frame gives a first map a wrong turn between its two views, and the poses that follow are held
  // by neither.
  void weigh(const TrackedFrame<S>& frame, bool held, int held_by, double seconds) {
    const bool against = contradicts(frame);
    drift.weigh(frame, against, held_by, seconds);
    if (!frame.manhattan) return;
    inconsistent_ = against ? inconsistent_ + seconds : 0;
    square_ += against ? 0 : seconds;
    (held ? held_ : loose_) += seconds;
  }
  // A pose after a drift is believed where the Manhattan frame bears it out.
  [[nodiscard]] bool believes(const TrackedFrame<S>& frame) const {
    return !drift.drifted() || (drift.tells(frame) && !contradicts(frame));
  }
  [[nodiscard]] bool contradicts(const TrackedFrame<S>& frame) const {
    if (!frame.manhattan) return false;
    const SO3<S> off = frame.manhattan->cam_from_world * frame.cam_from_world.rotation.inverse();
    const Vec3<S> turn = off.log();
    return turn.norm() > options.max_turn &&
           turn.dot(frame.manhattan->covariance.llt().solve(turn)) > options.max_sigmas * options.max_sigmas;
  }

  // A young map that a loss speaks against, or one of whose frames most are not held by the Manhattan frame;
  // or a map with more frames inconsistent to it, in a row, than it has ever had square to it.
  [[nodiscard]] bool refutes(const Map<S>& map) const noexcept {
    return !given_ && (lost_young(map) || (young(map) && stands_loose()) || stands_inconsistent());
  }
  // Whether that may still come to pass soon. Where no Manhattan frame is seen, nothing can be inconsistent
  // to it.
  [[nodiscard]] bool undecided(const Map<S>& map) const noexcept {
    const bool weighed = square_ + inconsistent_ > 0;
    return !given_ && (young(map) || (weighed && !reaches(square_, options.give_up_after)));
  }

  // An older map in which the camera has been lost for long. One that was given is never left: its world is
  // where poses are wanted.
  [[nodiscard]] bool leaves() const noexcept { return !given_ && reaches(unfit_, options.leave_after); }

  // Another map begins. Where one after the other is inconsistent, the world is not as square as it looks:
  // each of them is given twice the time.
  void begin_again() noexcept {
    if (stands_inconsistent() || stands_loose()) ++given_up_;
    end_loss();
    drift.begin_again();
    inconsistent_ = square_ = held_ = loose_ = 0;
  }

 private:
  [[nodiscard]] bool lost_young(const Map<S>& map) const noexcept {
    return reaches(unfit_, options.give_up_after) && young(map);
  }
  [[nodiscard]] bool stands_inconsistent() const noexcept {
    return reaches(inconsistent_, std::max(patience(), square_));
  }
  [[nodiscard]] bool stands_loose() const noexcept {
    return reaches(loose_, std::max(patience(), 2 * held_));
  }
  [[nodiscard]] double patience() const noexcept {
    return std::ldexp(options.give_up_after, std::min(given_up_, 16));
  }
  // Stamps are exact to a millisecond at best.
  [[nodiscard]] static bool reaches(double seconds, double limit) noexcept { return seconds >= limit - 1e-3; }

  // All in seconds of frames, each with the time since the one before it.
  double unfit_ = 0;         // lost ones in a row that showed enough to be recognised
  double inconsistent_ = 0;  // tracked ones in a row that contradict the Manhattan frame
  double square_ = 0;        // tracked ones of this map that agree with it
  double held_ = 0;          // tracked ones of this map within the error that their Manhattan rotation claims
  double loose_ = 0;         // those beyond it
  int given_up_ = 0;         // maps, for being inconsistent
  bool lost_ = false;
  bool given_ = false;
};

}  // namespace sslam
