// SPDX-License-Identifier: BSD-3-Clause
// No final pass: poses and map stay as tracking and mapping left them.
#pragma once

#include "sslam/track/contract/concepts.hpp"
#include "sslam/track/worlds/trajectory_log.hpp"

namespace sslam {

template <Scalar S>
struct NoFinalPass {
  [[nodiscard]] double read_out() const noexcept { return 0; }
  void keep(const TrackedFrame<S>&) noexcept {}
  [[nodiscard]] bool full() const noexcept { return true; }
  template <class Stages>
  void run(Map<S>&, Stages&, TrajectoryLog<S>&) noexcept {}
};
static_assert(FinalStage<NoFinalPass<double>, double>);

}  // namespace sslam
