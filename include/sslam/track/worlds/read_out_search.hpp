// SPDX-License-Identifier: BSD-3-Clause
// The read-out time of a rolling shutter that a map's observations ask for. The features are straightened by
// a time that is tried and a part of the map is adjusted to them; the cost c(T) that is left has its minimum
// where its slope is zero. By the envelope theorem that slope is the partial derivative of the cost, with
// keyframes and landmarks held where the adjustment has put them.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

#include "sslam/core/parameter.hpp"
#include "sslam/map/bundle_window.hpp"
#include "sslam/solver/bundle/bundle_solver.hpp"

namespace sslam {

struct ReadOutSearchOptions {
  bool search = true;              // false: the read-out stays as it is told
  std::size_t max_keyframes = 60;  // the first ones of the map: more tell little that is new
  double first_step = 0.01;        // seconds: to the second time that is tried
  double longest = 0.1;            // seconds: what is longer is not believed
  double shortest = 0.003;         // seconds, below which all rows are taken to be read at once
  double min_gain = 0.01;          // of the cost: the same
  double min_sigmas = 5;           // over its standard deviation: the same

  template <class Self, class Visit>
  static void parameters(Self& self, Visit&& visit) {
    visit("search", self.search, Unit::kCount, 0, 1,
          "1: where no read-out is told, the map's observations are asked for it");
    visit("max_keyframes", self.max_keyframes, Unit::kCount, 2, 1e6, "that are asked, the first of the map");
    visit("longest", self.longest, Unit::kSeconds, 0, 0.2, "read-out that is believed");
    visit("shortest", self.shortest, Unit::kSeconds, 0, 0.2, "read-out that matters");
    visit("min_gain", self.min_gain, Unit::kShare, 0, 1,
          "of the cost of the observations, without which there is none");
    visit("min_sigmas", self.min_sigmas, Unit::kNumber, 0, 1000,
          "of a read-out over its standard deviation, below which there is none");
  }
};
static_assert(Described<ReadOutSearchOptions>);

struct ReadOutEstimate {
  double seconds = 0;
  double sigma = 0;  // standard deviation: 1 over the square root of the cost's curvature
  double gain = 0;   // what it saves of the cost that the time has from which the search began
};

template <Scalar S>
class ReadOutSearch {
 public:
  ReadOutSearchOptions options;

  // straighten(seconds) makes the features of the map's keyframes those of that read-out; which one they have
  // in the end is open. The map is not adjusted. Nothing: the observations leave the time open.
  template <class Straighten>
  [[nodiscard]] std::optional<ReadOutEstimate> find(const Map<S>& map, double start,
                                                    const BundleOptions<S>& solver, Straighten straighten) {
    solver_.options = solver;
    solver_.options.max_iterations = std::min(solver_.options.max_iterations, kIterations);
    const auto see = [&](double seconds) {
      straighten(seconds);
      window_.gather_first(map, options.max_keyframes);
    };
    see(start);
    graph_ = window_.graph;
    const Trial first = attempt(start, see);
    double curvature = 0;
    Trial before = first, last = attempt(start + options.first_step, see);
    for (int step = 0; step < kSteps; ++step) {
      curvature = (last.slope - before.slope) / (last.seconds - before.seconds);
      if (!(curvature > 0)) return std::nullopt;
      const double next = last.seconds - last.slope / curvature;
      if (!(std::abs(next) <= options.longest)) return std::nullopt;
      before = last;
      last = attempt(next, see);
      if (std::abs(last.seconds - before.seconds) < kResolution) break;
    }
    return ReadOutEstimate{last.seconds, 1 / std::sqrt(curvature), 1 - last.cost / first.cost};
  }

  // Of a search that began at 0: all rows are read at once, or nearly so.
  [[nodiscard]] bool negligible(const ReadOutEstimate& found) const noexcept {
    return found.seconds < options.shortest || found.gain < options.min_gain ||
           found.seconds < options.min_sigmas * found.sigma;
  }

 private:
  static constexpr int kSteps = 3;               // of the secant method
  static constexpr int kIterations = 10;         // of one adjustment: it begins where the last one ended
  static constexpr double kResolution = 0.0005;  // seconds

  struct Trial {
    double seconds, cost, slope;  // slope: of the cost, per second
  };

  template <class See>
  Trial attempt(double seconds, See& see) {
    constexpr double kStep = 0.001;  // seconds, of the difference quotient
    const auto cost_at = [&](double t) {
      observe(t, see);
      return solver_.cost(graph_);
    };
    observe(seconds, see);
    const double cost = solver_.solve(graph_).final_cost;
    return {seconds, cost, (cost_at(seconds + kStep) - cost_at(seconds - kStep)) / (2 * kStep)};
  }

  // Keyframes and landmarks of the graph stay; they see what a shutter of that read-out lets them see.
  template <class See>
  void observe(double seconds, See& see) {
    see(seconds);
    graph_.point_edges = window_.graph.point_edges;
    graph_.line_edges = window_.graph.line_edges;
  }

  BundleWindow<S> window_;
  BundleGraph<S> graph_;
  BundleSolver<S> solver_;
};

}  // namespace sslam
