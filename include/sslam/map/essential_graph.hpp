// SPDX-License-Identifier: BSD-3-Clause
// The map as a graph of poses: keyframes, and the motions between those that share landmarks (Mur-Artal,
// Montiel, Tardos, ORB-SLAM, T-RO 2015, section VII-D).
#pragma once

#include <algorithm>
#include <vector>

#include "sslam/core/median.hpp"
#include "sslam/core/parameter.hpp"
#include "sslam/map/bundle_window.hpp"
#include "sslam/map/map.hpp"
#include "sslam/solver/bundle/pose_graph.hpp"

namespace sslam {

// How well a motion between two keyframes that share `shared` landmarks is known: each sigma holds for 50 of
// them and falls with the root of their number.
template <Scalar S>
struct EdgeSigmas {
  S rotation = radians(S(0.1));
  S translation = S(0.003);  // over the depth of what the keyframe sees
  S scale = S(0.01);         // of its logarithm

  [[nodiscard]] Vec<S, 7> inverse(std::int32_t shared, S depth) const {
    const S certainty = std::sqrt(static_cast<S>(std::max(shared, 1)) / 50);
    Vec<S, 7> out;
    out.template head<3>().setConstant(certainty / rotation);
    out.template segment<3>(3).setConstant(certainty / (translation * depth));
    out[6] = certainty / scale;
    return out;
  }

  template <class Self, class Visit>
  static void parameters(Self& self, Visit&& visit) {
    visit("rotation", self.rotation, Unit::kDegrees, 1e-6, 180,
          "of the rotation between two keyframes that share 50 landmarks");
    visit("translation", self.translation, Unit::kNumber, 1e-6, 10,
          "of the translation between them over the scene depth");
    visit("scale", self.scale, Unit::kNumber, 1e-6, 10, "of the logarithm of the scale between them");
  }
};
static_assert(Described<EdgeSigmas<double>>);

template <Scalar S>
struct EssentialGraphOptions {
  std::int32_t min_shared =
      30;  // landmarks that make an edge; each keyframe also has one to its best older neighbour
  EdgeSigmas<S> sigmas;
  S loop_certainty =
      10;  // of the motion across a loop, over that of an edge: each keyframe has edges to many others

  template <class Self, class Visit>
  static void parameters(Self& self, Visit&& visit) {
    visit("min_shared", self.min_shared, Unit::kCount, 1, 1e6, "landmarks that make an edge");
    visit("loop_certainty", self.loop_certainty, Unit::kNumber, 0.001, 1e6,
          "of the motion across a loop over that of an edge");
    visit_within("sigma.", self.sigmas, visit);
  }
};
static_assert(Described<EssentialGraphOptions<double>>);

template <Scalar S>
class EssentialGraph {
 public:
  EssentialGraphOptions<S> options;
  std::vector<KeyframeId> keyframes;  // one for each graph.nodes
  PoseGraph<S> graph;

  // Rotations that keyframes know from the Manhattan frame are tied to it. The first keyframe is held.
  void gather(const Map<S>& map, const BundleWindowOptions<S>& window);

  // The motion across a loop, by `shared` landmarks.
  void add_loop(const Map<S>& map, KeyframeId from, KeyframeId to, const Sim3<S>& to_from,
                std::int32_t shared);

 private:
  // To each older neighbour that shares enough, and to the one that shares most; without any, to the one
  // before.
  void add_edges(const Map<S>& map, std::size_t node) {
    const Keyframe<S>& kf = map.keyframes[map.index(keyframes[node])];
    const auto add = [&](KeyframeId from, std::int32_t shared) {
      const SE3<S> to_from = kf.cam_from_world * map.keyframes[map.index(from)].cam_from_world.inverse();
      add_edge(node_of_[map.index(from)], static_cast<std::int32_t>(node), similarity(to_from), shared);
    };
    bool hangs = false;
    for (const Neighbour& n : kf.neighbours) {  // most shared first
      if (n.keyframe > kf.id || (hangs && n.shared < options.min_shared)) continue;
      add(n.keyframe, n.shared);
      hangs = true;
    }
    if (!hangs) add(keyframes[node - 1], 1);
  }

  void add_edge(std::int32_t from, std::int32_t to, const Sim3<S>& to_from, std::int32_t shared) {
    graph.edges.push_back({from, to, to_from, options.sigmas.inverse(shared, depths_[Map<S>::index(to)])});
  }

  // Median depth of the points that a keyframe sees; 1 where it sees none.
  [[nodiscard]] S depth(const Map<S>& map, const Keyframe<S>& kf) {
    seen_.clear();
    for (const LandmarkId id : kf.point_landmarks)
      if (id != kNone) seen_.push_back((kf.cam_from_world * map.points[map.index(id)].position).z());
    return seen_.empty() ? S(1) : std::max(median<S>(seen_), S(1e-6));
  }

  std::vector<std::int32_t> node_of_;  // by keyframe
  std::vector<S> depths_;              // by node
  std::vector<S> seen_;                // scratch of depth()
};

template <Scalar S>
void EssentialGraph<S>::gather(const Map<S>& map, const BundleWindowOptions<S>& window) {
  keyframes.clear();
  depths_.clear();
  graph.clear();
  node_of_.assign(map.keyframes.size(), kNone);
  for (const Keyframe<S>& kf : map.keyframes) {
    if (!kf.alive()) continue;
    node_of_[map.index(kf.id)] = static_cast<std::int32_t>(keyframes.size());
    keyframes.push_back(kf.id);
    depths_.push_back(depth(map, kf));
    PoseGraphNode<S> node;
    node.cam_from_world = similarity(kf.cam_from_world);
    node.held = keyframes.size() == 1;
    if (window.manhattan && kf.manhattan) node.rotation = make_tie(*kf.manhattan, window.rotation_floor);
    graph.nodes.push_back(node);
  }
  for (std::size_t n = 1; n < keyframes.size(); ++n) add_edges(map, n);
}

template <Scalar S>
void EssentialGraph<S>::add_loop(const Map<S>& map, KeyframeId from, KeyframeId to, const Sim3<S>& to_from,
                                 std::int32_t shared) {
  add_edge(node_of_[map.index(from)], node_of_[map.index(to)], to_from, shared);
  graph.edges.back().inverse_sigma *= options.loop_certainty;
}

}  // namespace sslam
