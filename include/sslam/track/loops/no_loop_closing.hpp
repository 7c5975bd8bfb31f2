// SPDX-License-Identifier: BSD-3-Clause
// No loop closing: every place is new, and the map stays as tracking made it.
#pragma once

#include <optional>
#include <vector>

#include "sslam/track/contract/concepts.hpp"

namespace sslam {

template <Scalar S>
struct NoPlaces {
  [[nodiscard]] std::optional<Loop<S>> find(const Map<S>&, KeyframeId, const Map<S>&) { return std::nullopt; }
  [[nodiscard]] bool confirmed(const Keyframe<S>&, const Map<S>&, const Loop<S>&,
                               std::optional<PlaceMatch<S>>&) const {
    return false;
  }
};
static_assert(PlaceFinder<NoPlaces<double>, double>);

template <Scalar S>
struct NoLoopClosing {
  LoopAnswer<S> close(Map<S>&, KeyframeId) { return {}; }
  [[nodiscard]] std::vector<KeyframeId> missed(const Map<S>&) { return {}; }
  LoopAnswer<S> close_on_trial(Map<S>&, KeyframeId, TrialEvidence) { return {}; }
  MapJoint<S> merge(Map<S>&, Map<S>, KeyframeId, const Loop<S>&) { return {}; }
  [[nodiscard]] NoPlaces<S> finder() const { return {}; }
  void forget() noexcept {}
};
static_assert(LoopStage<NoLoopClosing<double>, double>);

}  // namespace sslam
