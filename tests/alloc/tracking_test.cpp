// SPDX-License-Identifier: BSD-3-Clause
// What docs/architecture.md promises of tracking: once the map stops growing, a frame costs no allocation.
#include <vector>

#include "alloc/heap_watch.hpp"
#include "sslam/track/presets.hpp"
#include "support/catch.hpp"
#include "track/simulation.hpp"

using namespace sslam;
using namespace sslam::testing;

namespace {

constexpr std::size_t kFrames = 31;  // not a multiple of the three frames that a pipeline has in hand

// The map is given, and stays as it is.
struct NoInitialisation {
  Reason start(TrackedFrame<double>&, Map<double>&) { return Reason::kTooFewFeatures; }
  void reset() {}
};
struct NoMapping {
  void begin(Map<double>&, TrackedFrame<double>&, double) {}
  KeyframeId insert(Map<double>&, TrackedFrame<double>&, double) { return kNone; }
};

// As in the presets, but the map takes none of those that are chosen.
struct Choice : SharedFeatureKeyframes<double> {
  bool wasteful = false;  // asks for memory at each frame

  [[nodiscard]] bool choose(const Map<double>& map, KeyframeId reference, const TrackedFrame<double>& frame,
                            int inliers, double seconds_since, double median_depth) const {
    if (wasteful) escape(std::vector<int>(1).data());
    return SharedFeatureKeyframes::choose(map, reference, frame, inliers, seconds_since, median_depth);
  }
};

using Tracker =
    presets::With<presets::Structure<double>, slots::Initialisation<NoInitialisation>,
                  slots::Keyframes<Choice>, slots::Mapping<NoMapping>, slots::Loops<NoLoopClosing<double>>>;

[[nodiscard]] std::vector<SE3<double>> brisk_walk() {
  const std::vector<SE3<double>> slow = walk(4 * kFrames);
  std::vector<SE3<double>> path;
  for (std::size_t k = 0; k < slow.size(); k += 4) path.push_back(slow[k]);
  return path;
}

[[nodiscard]] MapSceneOptions small_room() {
  MapSceneOptions options;
  options.points = 500;
  options.lines = 100;
  return options;
}

// A walk through a simulated room whose map is known.
class Walk {
 public:
  Walk() : simulation_(brisk_walk(), small_room()) {
    for (std::size_t k = 0; k < kFrames; ++k) {
      frames_.push_back(simulation_.frame(k));
      add_normals(frames_.back());
    }
    tracker.resume(simulation_.true_map(5));
  }

  Tracker tracker;
  TrackResult<double> result;  // of the last frame

  [[nodiscard]] const Frame<double>& frame(std::size_t k) const { return frames_[k]; }
  // As through a network that knows no planes, in front of walls without an edge.
  [[nodiscard]] Frame<double> points_alone(std::size_t k) const {
    Frame<double> frame = frames_[k];
    frame.lines.clear();
    frame.normals.clear();
    return frame;
  }
  [[nodiscard]] Frame<double> dark() const {
    Frame<double> frame = points_alone(0);
    frame.points.clear();
    return frame;
  }

  // The frame is seen as the next one. Requests of memory meanwhile, without the one that doubles the
  // trajectory's room where it is full.
  std::size_t requests(const Frame<double>& frame) {
    in_hand_ = frame;
    in_hand_.stamp = stamp_ += 1.0 / 30;
    const auto& log = tracker.trajectory().entries();
    const std::size_t room = log.capacity();
    forbid_heap();
    result = tracker.track(in_hand_);
    const std::size_t all = allow_heap();
    return all - (log.capacity() != room ? 1 : 0);
  }

 private:
  // Some for each axis, as a floor and two walls in view give.
  void add_normals(Frame<double>& frame) const {
    const Mat3<double> R = simulation_.truth(static_cast<std::size_t>(frame.index)).rotation.matrix();
    for (int axis = 0; axis < 3; ++axis) {
      const Vec3<double> n = R(2, axis) > 0 ? Vec3<double>(-R.col(axis)) : Vec3<double>(R.col(axis));
      for (int i = 0; i < 100; ++i)
        frame.normals.push_back(static_cast<float>(n.x()), static_cast<float>(n.y()),
                                static_cast<float>(n.z()), 1);
    }
  }

  Simulation simulation_;
  std::vector<Frame<double>> frames_;
  Frame<double> in_hand_;
  double stamp_ = 0;
};

// Runs the frames from the last back to the first, and there again: requests, and frames in each state.
struct Lap {
  std::size_t requests = 0;
  int manhattan = 0, fallback = 0;

  template <class FrameOf>
  Lap(Walk& walk, FrameOf frame_of) {
    for (std::size_t k = kFrames - 1; k > 0; --k) add(walk, frame_of(k));
    for (std::size_t k = 0; k < kFrames; ++k) add(walk, frame_of(k));
  }

 private:
  void add(Walk& walk, const Frame<double>& frame) {
    requests += walk.requests(frame);
    manhattan += walk.result.state == State::kManhattan ? 1 : 0;
    fallback += walk.result.state == State::kFallback ? 1 : 0;
  }
};

// Requests while the camera is covered for some frames and found again.
std::size_t requests_of_a_loss(Walk& walk) {
  std::size_t requests = 0;
  for (int i = 0; i < 10; ++i) {
    requests += walk.requests(walk.dark());
    CHECK(walk.result.state == State::kLost);
  }
  requests += walk.requests(walk.frame(kFrames / 2));
  CHECK(walk.result.reason == Reason::kRelocalised);
  return requests;
}

}  // namespace

TEST_CASE("Once the map stops growing, a frame costs no allocation, however it is tracked") {
  Walk walk;
  const auto whole = [&](std::size_t k) -> const Frame<double>& { return walk.frame(k); };
  const auto points_alone = [&](std::size_t k) { return walk.points_alone(k); };
  // Each of the three frames in hand grows to the largest one, and so does each buffer.
  for (int i = 0; i < 3; ++i) (void)Lap(walk, whole);
  for (int i = 0; i < 3; ++i) (void)Lap(walk, points_alone);
  for (int i = 0; i < 3; ++i) (void)requests_of_a_loss(walk);

  const Lap structured(walk, whole);
  CHECK(structured.requests == 0);
  CHECK(structured.manhattan > 50);
  const Lap unstructured(walk, points_alone);
  CHECK(unstructured.requests == 0);
  CHECK(unstructured.fallback == 61);
  CHECK(requests_of_a_loss(walk) == 0);

  walk.tracker.keyframes.wasteful = true;
  const Lap wasteful(walk, whole);
  CHECK(wasteful.requests > 50);
}
