// SPDX-License-Identifier: BSD-3-Clause
// The tracker behind a System: a pipeline, chosen once by its preset. One virtual call per frame.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "sslam/core/parameter_table.hpp"
#include "sslam/map/map.hpp"
#include "sslam/track/contract/normal_need.hpp"
#include "sslam/track/contract/result.hpp"
#include "sslam/track/contract/stage_timer.hpp"
#include "sslam/track/contract/tracked_frame.hpp"
#include "sslam/track/worlds/world.hpp"

namespace sslam {

// Maps that were left and never joined with the map that is kept, and the frames that were tracked in them.
struct MapsApart {
  std::size_t maps = 0, frames = 0;
};

class Engine {
 public:
  virtual ~Engine() = default;

  // Whether, and why, a frame needs normals. Called before the frame is tracked, while it has none.
  [[nodiscard]] virtual NormalNeed normal_need(const Frame<double>& frame) = 0;
  virtual TrackResult<double> track(Frame<double>& frame) = 0;  // swaps the frame's buffers for others
  virtual bool finish() = 0;                                    // true if that closed a loop
  virtual void resume(Map<double> map) = 0;
  // Its worlds, the one with the camera first. Another engine of the same kind can continue with their maps
  // and logs.
  [[nodiscard]] virtual std::vector<const World<double>*> worlds() const = 0;
  [[nodiscard]] virtual int last_number() const = 0;  // number of the newest world
  virtual void go_on(std::vector<World<double>> known, int begun_last) = 0;
  virtual void localise_only(bool on) = 0;
  virtual void keep_frames(bool on) = 0;  // keeps frames so that finish() can track them again

  [[nodiscard]] virtual const Map<double>& map() const = 0;
  [[nodiscard]] virtual const TrajectoryLog<double>& trajectory() const = 0;
  [[nodiscard]] virtual const TrackedFrame<double>& last_frame() const = 0;
  [[nodiscard]] virtual int world() const = 0;
  [[nodiscard]] virtual MapsApart apart() const = 0;
  [[nodiscard]] virtual int keyframes_not_made() const = 0;
  [[nodiscard]] virtual double read_out() const = 0;    // seconds; 0: all rows at once, or not known
  [[nodiscard]] virtual float tracking_ms() const = 0;  // of the last frame, up to now
  [[nodiscard]] virtual const std::array<float, kStageCount>& stage_ms() const = 0;

  virtual void seed(std::uint64_t seed) = 0;
  virtual void create_points(bool on) = 0;                // false: no new points after the first map
  virtual void collect(ParameterTable& table) const = 0;  // adds the pipeline's parameters
  virtual void write(const ParameterTable& table) = 0;    // applies the values that were set
};

}  // namespace sslam
