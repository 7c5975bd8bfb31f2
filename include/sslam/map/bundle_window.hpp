// SPDX-License-Identifier: BSD-3-Clause
// The part of the map that one bundle adjustment sees: free keyframes, held ones, and the landmarks between
// them.
#pragma once

#include <algorithm>
#include <optional>
#include <span>
#include <vector>

#include "sslam/core/parameter.hpp"
#include "sslam/map/keyframe_votes.hpp"
#include "sslam/map/map.hpp"
#include "sslam/map/plane_ties.hpp"
#include "sslam/solver/bundle/scale_tie.hpp"
#include "sslam/solver/least_squares/positive_inverse.hpp"

namespace sslam {

template <Scalar S>
struct BundleWindowOptions {
  std::size_t max_free = 7;   // keyframes that move: the newest and its closest neighbours
  std::size_t max_held = 15;  // keyframes around them that see the same landmarks and stay where they are
  bool planes = true;         // tie points and lines to their planes
  bool manhattan = true;      // tie keyframe rotations and line directions to the Manhattan axes
  // Standard deviation that no Manhattan rotation falls below; it comes on top of the squareness that the
  // rotation's covariance has in it already.
  S rotation_floor = radians(S(0.2));

  template <class Self, class Visit>
  static void parameters(Self& self, Visit&& visit) {
    visit("max_free", self.max_free, Unit::kCount, 1, 1e6, "keyframes that move");
    visit("max_held", self.max_held, Unit::kCount, 0, 1e6, "keyframes around them that stay where they are");
    visit("planes", self.planes, Unit::kCount, 0, 1, "1: points and lines are tied to their planes");
    visit("manhattan", self.manhattan, Unit::kCount, 0, 1,
          "1: rotations and lines are tied to the Manhattan axes");
    visit("rotation_floor", self.rotation_floor, Unit::kDegrees, 0, 45,
          "standard deviation that no Manhattan rotation falls below");
  }
};
static_assert(Described<BundleWindowOptions<double>>);

// The Manhattan rotation of a keyframe as a tie, no more certain than `floor` about any axis; none where its
// covariance is of no use.
template <Scalar S>
[[nodiscard]] std::optional<RotationTie<S>> make_tie(const RotationObservation<S>& seen, S floor) {
  Mat3<S> root;
  if (!seen.covariance.allFinite() ||
      !inverse_root<S, 3>(seen.covariance + floor * floor * Mat3<S>::Identity(), root))
    return std::nullopt;
  return RotationTie<S>{seen.cam_from_world, root};
}

// Keeps its buffers: gathering stops allocating once the window stops growing.
template <Scalar S>
class BundleWindow {
 public:
  std::vector<KeyframeId> keyframes;  // one for each graph.views, free ones first
  std::vector<LandmarkId> points;     // one for each graph.points
  std::vector<LandmarkId> lines;      // one for each graph.lines
  PlaneTies<S> ties;
  std::size_t free_count = 0;
  BundleGraph<S> graph;

  // A keyframe and its most covisible neighbours move, those around them are held.
  void gather_local(const Map<S>& map, KeyframeId centre, const BundleWindowOptions<S>& options) {
    take_with_neighbours(map.keyframes[map.index(centre)], options.max_free, keyframes);
    build(map, options);
  }

  // The first `most` keyframes of the map and nothing around them, by their observations alone.
  void gather_first(const Map<S>& map, std::size_t most) {
    BundleWindowOptions<S> options;
    options.max_held = 0;
    options.planes = options.manhattan = false;
    keyframes.clear();
    for (const Keyframe<S>& kf : map.keyframes)
      if (kf.alive() && keyframes.size() < most) keyframes.push_back(kf.id);
    build(map, options);
  }

  // Every keyframe moves.
  void gather_all(const Map<S>& map, const BundleWindowOptions<S>& options) {
    keyframes.clear();
    for (const Keyframe<S>& kf : map.keyframes)
      if (kf.alive()) keyframes.push_back(kf.id);
    build(map, options);
  }

 private:
  void build(const Map<S>& map, const BundleWindowOptions<S>& options) {
    free_count = keyframes.size();
    view_of_.resize(map.keyframes.size(), kNone);
    for (std::size_t v = 0; v < free_count; ++v)
      view_of_[map.index(keyframes[v])] = static_cast<std::int32_t>(v);
    collect(map, map.points, &Keyframe<S>::point_landmarks, points);
    collect(map, map.lines, &Keyframe<S>::line_landmarks, lines);
    hold_others(map, options.max_held);
    graph.clear();
    for (std::size_t v = 0; v < keyframes.size(); ++v)
      add_view(map.keyframes[map.index(keyframes[v])], v, options);
    add_points(map);
    add_lines(map, options);
    for (const KeyframeId k : keyframes) view_of_[map.index(k)] = kNone;
    if (options.planes) ties.add(map, points, lines, options.manhattan, graph);
    fix_gauge();
  }

  // Landmarks seen by free keyframes, in the order of their ids.
  template <class Landmarks, class Seen>
  void collect(const Map<S>& map, const Landmarks& landmarks, Seen seen, std::vector<LandmarkId>& out) {
    marks_.resize(std::max(marks_.size(), landmarks.size()), 0);
    out.clear();
    for (const KeyframeId k : keyframes)
      for (const LandmarkId id : map.keyframes[map.index(k)].*seen) {
        if (id == kNone || !landmarks[map.index(id)].alive || marks_[map.index(id)] != 0) continue;
        marks_[map.index(id)] = 1;
        out.push_back(id);
      }
    for (const LandmarkId id : out) marks_[map.index(id)] = 0;
    std::sort(out.begin(), out.end());
  }

  // Appends the keyframes that share most with the window; ties go to the newer one.
  void hold_others(const Map<S>& map, std::size_t max_held) {
    votes_.begin(map.keyframes.size());
    for (const LandmarkId id : points) vote(map.points[map.index(id)].observations);
    for (const LandmarkId id : lines) vote(map.lines[map.index(id)].observations);
    const std::span<const KeyframeId> others = votes_.ranked(VoteTies::kNewerFirst);
    for (const KeyframeId k : others.first(std::min(others.size(), max_held))) {
      view_of_[map.index(k)] = static_cast<std::int32_t>(keyframes.size());
      keyframes.push_back(k);
    }
  }

  void vote(const std::vector<Observation>& observations) {
    for (const Observation& o : observations)
      if (view_of_[Map<S>::index(o.keyframe)] == kNone) votes_.add(o.keyframe);
  }

  void add_view(const Keyframe<S>& kf, std::size_t view, const BundleWindowOptions<S>& options) {
    BundleView<S> out{kf.cam_from_world, kf.frame.pinhole, Hold::kNothing, std::nullopt};
    if (view >= free_count) out.hold = Hold::kPose;
    if (view < free_count && options.manhattan && kf.manhattan)
      out.rotation = make_tie(*kf.manhattan, options.rotation_floor);
    graph.views.push_back(out);
  }

  // An edge for each observation from the window, as make(frame, feature, view) gives it. False, and no edge,
  // where there are fewer than two.
  template <class Edge, class Make>
  [[nodiscard]] bool add_edges(const Map<S>& map, const LandmarkCommon& landmark, std::vector<Edge>& edges,
                               Make make) {
    const auto first = edges.size();
    for (const Observation& o : landmark.observations) {
      const std::int32_t view = view_of_[map.index(o.keyframe)];
      if (view == kNone) continue;
      edges.push_back(make(map.keyframes[map.index(o.keyframe)].frame, map.index(o.feature), view));
    }
    if (edges.size() - first >= 2) return true;
    edges.resize(first);
    return false;
  }

  void add_points(const Map<S>& map) {
    const auto edge = [](const Frame<S>& frame, std::size_t feature, std::int32_t view) {
      const PointFeature<S>& f = frame.points[feature];
      return PointEdge<S>{f.pixel, 1 / f.sigma, view};
    };
    std::erase_if(points, [&](LandmarkId id) {
      const PointLandmark<S>& landmark = map.points[map.index(id)];
      const auto first = graph.point_edges.size();
      if (!add_edges(map, landmark, graph.point_edges, edge)) return true;
      graph.points.push_back({landmark.position, to_int(first), to_int(graph.point_edges.size()), kNoPlane});
      return false;
    });
  }

  void add_lines(const Map<S>& map, const BundleWindowOptions<S>& options) {
    const auto edge = [](const Frame<S>& frame, std::size_t feature, std::int32_t view) {
      const LineFeature<S>& f = frame.lines[feature];
      return LineEdge<S>{f.segment, 1 / f.sigma, view};
    };
    std::erase_if(lines, [&](LandmarkId id) {
      const LineLandmark<S>& landmark = map.lines[map.index(id)];
      const auto first = graph.line_edges.size();
      if (!add_edges(map, landmark, graph.line_edges, edge)) return true;
      graph.lines.emplace_back();
      graph.lines.back().line = landmark.line;
      graph.lines.back().first_edge = to_int(first);
      graph.lines.back().last_edge = to_int(graph.line_edges.size());
      if (options.manhattan && landmark.axis != kNone) graph.lines.back().axis = map.axis(landmark.axis);
      return false;
    });
  }

  // Seven degrees of freedom are open when nothing is held. The map's first keyframe, or else the oldest
  // here, keeps its place, and its rotation too unless a Manhattan frame says what that is. When nothing else
  // is held, scale is tied to the distance of the farthest view from it.
  void fix_gauge() {
    const auto end = keyframes.begin() + static_cast<std::ptrdiff_t>(free_count);
    const auto oldest = std::min_element(keyframes.begin(), end);
    const std::size_t held = keyframes.size() - free_count;
    if (held > 0 && *oldest != 0) {
      if (held == 1) tie_scale(graph, free_count);
      return;
    }
    const auto anchor = static_cast<std::size_t>(oldest - keyframes.begin());
    graph.views[anchor].hold = graph.views[anchor].rotation ? Hold::kCentre : Hold::kPose;
    if (held == 0) tie_scale(graph, anchor);
  }

  [[nodiscard]] static std::int32_t to_int(std::size_t i) noexcept { return static_cast<std::int32_t>(i); }

  // Between two windows these say nothing: only what a window touched is put back.
  std::vector<std::int32_t> view_of_;  // by keyframe: its view, or kNone
  std::vector<std::uint8_t> marks_;    // by landmark
  KeyframeVotes votes_;                // observations of the window's landmarks
};

}  // namespace sslam
