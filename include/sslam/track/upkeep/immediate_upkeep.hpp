// SPDX-License-Identifier: BSD-3-Clause
// Upkeep: when and where mapping and loop closing happen. Here: at once, between two frames, so that the same
// frames give the same bits.
#pragma once

#include "sslam/track/contract/concepts.hpp"
#include "sslam/track/loops/no_loop_closing.hpp"
#include "sslam/track/mapping/mapping.hpp"

namespace sslam {

template <Scalar S>
struct ImmediateUpkeep {
  template <class Mapping, class Loops>
  KeyframeId insert(Map<S>& map, TrackedFrame<S>& frame, KeyframeId, S median_depth, Mapping& mapping,
                    Loops&) {
    return mapping.insert(map, frame, median_depth);
  }
  template <class Loops>
  LoopAnswer<S> close(Map<S>& map, KeyframeId id, Loops& loops) {
    return loops.close(map, id);
  }
  const MapChange<S>* renew(Map<S>&) { return nullptr; }
  const MapChange<S>* finish(Map<S>&) { return nullptr; }
  void forget() {}
};
static_assert(UpkeepStage<ImmediateUpkeep<double>, double, KeyframeMapping<double>, NoLoopClosing<double>>);

}  // namespace sslam
