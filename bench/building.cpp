// SPDX-License-Identifier: BSD-3-Clause
// What a building costs: a house of many rooms is walked through as features alone, and the run is told in
// tenths of its frames, so that what grows with the map stands out.
//   building [--rooms N] [--frames N] [--texture rich|mixed|poor] [--seed N] [--fps N] [--pitch METRES]
//            [--live] [--adjust] [--map FILE]
// Times are processor time of the thread at work, in milliseconds; docs/benchmarks.md says how to read them.
#include <ctime>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "sslam/io/evaluation/evaluation.hpp"
#include "sslam/io/maps/map_file.hpp"
#include "sslam/live/mapping_thread.hpp"
#include "sslam/synth/house.hpp"
#include "sslam/system/compiled_stages.hpp"
#include "support/feature_camera.hpp"

namespace {

using namespace sslam;

double seconds_of_thread() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}
double seconds_of_process() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

// Of /proc/self/status, MB.
double memory(const char* name) {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.rfind(name, 0) == 0) return std::strtod(line.c_str() + std::strlen(name) + 1, nullptr) / 1024;
  return 0;
}

// Milliseconds of each keyframe, by what they were spent on.
struct KeyframeCost {
  double mapping = 0, planes = 0, adjustment = 0, loops = 0;
  bool closed = false;
};
std::vector<KeyframeCost> keyframe_costs;

template <class Work>
auto timed(double KeyframeCost::*part, Work work) {
  const double start = seconds_of_thread();
  auto answer = work();
  if (!keyframe_costs.empty()) keyframe_costs.back().*part += 1e3 * (seconds_of_thread() - start);
  return answer;
}

struct TimedPlanes : ManhattanPlanes<double> {
  void find(Map<double>& map, KeyframeId id, double median_depth) {
    timed(&KeyframeCost::planes, [&] { return ManhattanPlanes::find(map, id, median_depth), 0; });
  }
};
struct TimedAdjustment : MapAdjustment<double, BundleSolver<double>> {
  BundleSummary optimise(Map<double>& map, KeyframeId id) {
    return timed(&KeyframeCost::adjustment, [&] { return MapAdjustment::optimise(map, id); });
  }
};
struct TimedMapping : KeyframeMapping<double, TimedAdjustment, TimedPlanes> {
  KeyframeId insert(Map<double>& map, TrackedFrame<double>& frame, double median_depth) {
    keyframe_costs.emplace_back();
    return timed(&KeyframeCost::mapping, [&] { return KeyframeMapping::insert(map, frame, median_depth); });
  }
};
struct TimedLoops : LoopClosing<double> {
  LoopAnswer<double> close(Map<double>& map, KeyframeId id) {
    const LoopAnswer<double> answer =
        timed(&KeyframeCost::loops, [&] { return LoopClosing::close(map, id); });
    keyframe_costs.back().closed = answer.closed;
    return answer;
  }
};

using Deterministic =
    presets::With<presets::Structure<double>, slots::Mapping<TimedMapping>, slots::Loops<TimedLoops>>;
using Live =
    presets::With<Deterministic, slots::Upkeep<live::ThreadedUpkeep<double, TimedMapping, TimedLoops>>>;

struct Arguments {
  synth::HouseOptions house;
  int frames = 0;  // 0: a lap and a twentieth
  double fps = 30, pitch = testing::FeatureCameraOptions{}.pitch;
  bool live = false, adjust = false;
  std::string map;
};

struct FrameCost {
  double track = 0;  // milliseconds
  bool keyframe = false, posed = false;
};

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0;
  const auto at =
      values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

struct Counts {
  std::size_t keyframes = 0, landmarks = 0, planes = 0;
  double resident = 0;
};

template <class P>
Counts counts_of(const P& pipeline) {
  const Map<double>& map = pipeline.map();
  const auto alive = [](const auto& list) {
    return static_cast<std::size_t>(
        std::count_if(list.begin(), list.end(), [](const auto& l) { return l.alive; }));
  };
  const auto keyframes = std::count_if(map.keyframes.begin(), map.keyframes.end(),
                                       [](const Keyframe<double>& k) { return k.alive(); });
  return {static_cast<std::size_t>(keyframes), alive(map.points) + alive(map.lines), alive(map.planes),
          memory("VmRSS")};
}

constexpr int kParts = 10;

void print_part(int part, const std::vector<FrameCost>& frames, std::size_t first_keyframe,
                const Counts& counts) {
  std::vector<double> track, mapping, planes, adjustment, rest, loops;
  double closing = 0;
  for (const FrameCost& frame : frames)
    if (!frame.keyframe && frame.posed) track.push_back(frame.track);
  for (std::size_t k = first_keyframe; k < keyframe_costs.size(); ++k) {
    const KeyframeCost& cost = keyframe_costs[k];
    mapping.push_back(cost.mapping);
    planes.push_back(cost.planes);
    adjustment.push_back(cost.adjustment);
    rest.push_back(cost.mapping - cost.planes - cost.adjustment);
    if (cost.closed)
      closing += cost.loops;
    else
      loops.push_back(cost.loops);
  }
  std::printf(
      "| %d | %zu | %zu | %zu | %.2f, %.2f | %zu | %.1f | %.1f | %.1f | %.1f | %.2f | %.0f | %.0f |\n",
      part + 1, counts.keyframes, counts.landmarks, counts.planes, quantile(track, 0.5),
      quantile(track, 0.95), mapping.size(), quantile(mapping, 0.5), quantile(adjustment, 0.5),
      quantile(planes, 0.5), quantile(rest, 0.5), quantile(loops, 0.5), closing, counts.resident);
  std::fflush(stdout);
}

template <class P>
void print_error(const P& pipeline, const io::Trajectory& truth, int frames) {
  io::Trajectory estimate;
  for (const auto& entry : pipeline.trajectory().entries())
    estimate.push_back({entry.stamp, pipeline.trajectory().pose(pipeline.map(), entry).inverse()});
  std::sort(estimate.begin(), estimate.end(), [](const auto& a, const auto& b) { return a.stamp < b.stamp; });
  io::EvaluationOptions options;
  options.deltas.clear();
  const io::Evaluation result = io::evaluate(truth, estimate, options);
  const double path = io::path_length(truth);
  std::printf("path %.1f m, tracked %.2f %%, ATE %.4f m, %.4f %% of the path\n", path,
              100.0 * static_cast<double>(estimate.size()) / frames, result.position.rmse,
              100 * result.position.rmse / path);
}

template <class P>
int walk(const Arguments& arguments) {
  const double building = seconds_of_process();
  const synth::House house = synth::build_house(arguments.house);
  testing::FeatureCameraOptions eyes;
  eyes.pitch = arguments.pitch;
  testing::FeatureCamera camera(house.scene, eyes);
  const double lap = house.path.lap_seconds() * arguments.fps;
  const int frames = arguments.frames > 0 ? arguments.frames : static_cast<int>(1.05 * lap);
  std::printf("%d rooms, %.0f frames a lap, %zu faces, built in %.1f s, %.0f MB\n", arguments.house.rooms,
              lap, house.scene.faces.size(), seconds_of_process() - building, memory("VmRSS"));
  std::puts(
      "| tenth | keyframes | landmarks | planes | frame: median, p95 | new keyframes | mapping | adjustment "
      "| planes | "
      "rest | loop search | closing, sum | MB |\n|---|---|---|---|---|---|---|---|---|---|---|---|---|");
  const auto pipeline = std::make_unique<P>();
  keyframe_costs.reserve(static_cast<std::size_t>(frames));  // a mapping thread may be at it
  Frame<double> frame;
  io::Trajectory truth;
  std::vector<FrameCost> costs;
  std::size_t first_keyframe = 0, points = 0, lines = 0;
  int joins = 0, loops = 0, lost = 0;
  double seeing = 0, tracking = 0;
  for (int i = 0; i < frames; ++i) {
    const double stamp = i / arguments.fps, start = seconds_of_thread();
    truth.push_back({stamp, house.path.world_from_cam(stamp)});
    camera.take(truth.back().world_from_cam.inverse(), i, stamp, frame);
    points += frame.points.size();
    lines += frame.lines.size();
    // A camera that gives mapping the time it needs: this walk is faster than any.
    if constexpr (requires { pipeline->upkeep.channel; })
      while (pipeline->upkeep.channel.running() && !pipeline->upkeep.channel.room())
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    const double seen = seconds_of_thread();
    const TrackResult<double> result = pipeline->track(frame);
    const double end = seconds_of_thread();
    seeing += seen - start;
    tracking += end - seen;
    costs.push_back({1e3 * (end - seen), result.keyframe, result.has_pose()});
    joins += result.maps_joined;
    loops += result.loop_closed;
    lost += result.state == State::kLost;
    if (std::int64_t{kParts} * (i + 1) / frames == std::int64_t{kParts} * i / frames) continue;
    print_part(kParts * i / frames, costs, first_keyframe, counts_of(*pipeline));
    costs.clear();
    first_keyframe = keyframe_costs.size();
  }
  loops += pipeline->finish();
  std::printf("a frame: %.0f points, %.0f lines, %.2f ms for its features, %.2f ms in the pipeline\n",
              static_cast<double>(points) / frames, static_cast<double>(lines) / frames,
              1e3 * seeing / frames, 1e3 * tracking / frames);
  std::printf(
      "worlds %zu of %d begun, joined %d, loops closed %d, frames lost %d; %.0f s of processor time, %.0f MB "
      "at most\n",
      pipeline->worlds().size(), pipeline->last_number() + 1, joins, loops, lost, seconds_of_process(),
      memory("VmHWM"));
  print_error(*pipeline, truth, frames);
  if (!arguments.map.empty()) {
    io::save_map(arguments.map, pipeline->map());
    std::printf("map file: %.1f MB\n", static_cast<double>(std::filesystem::file_size(arguments.map)) / 1e6);
  }
  if (arguments.adjust) {
    Map<double> map = pipeline->map();
    const double start = seconds_of_thread();
    const BundleSummary summary = LoopClosing<double>().adjustment.optimise_all(map);
    std::printf("all adjusted: %.1f s, %s\n", seconds_of_thread() - start,
                improved(summary) ? "improved" : "as it was");
  }
  return 0;
}

int usage(const char* what) {
  std::fprintf(stderr, "building: %s\n", what);
  return 2;
}

}  // namespace

int main(int argc, char** argv) {
  Arguments arguments;
  arguments.house.lit = false;
  for (int i = 1; i < argc; ++i) {
    const std::string option = argv[i];
    if (option == "--live" || option == "--adjust") {
      (option == "--live" ? arguments.live : arguments.adjust) = true;
      continue;
    }
    if (++i == argc) return usage((option + " needs a value").c_str());
    const std::string value = argv[i];
    if (option == "--rooms")
      arguments.house.rooms = std::clamp(std::atoi(value.c_str()), 1, synth::kMostRooms);
    else if (option == "--frames")
      arguments.frames = std::max(kParts, std::atoi(value.c_str()));
    else if (option == "--fps")
      arguments.fps = std::max(1.0, std::atof(value.c_str()));
    else if (option == "--pitch")
      arguments.pitch = std::clamp(std::atof(value.c_str()), 0.02, 5.0);
    else if (option == "--seed")
      arguments.house.seed = std::strtoull(value.c_str(), nullptr, 10);
    else if (option == "--map")
      arguments.map = value;
    else if (option == "--texture")
      arguments.house.richness = value == "poor"    ? synth::Richness::kPoor
                                 : value == "mixed" ? synth::Richness::kMixed
                                                    : synth::Richness::kRich;
    else
      return usage((option + " is no option").c_str());
  }
  return arguments.live ? walk<Live>(arguments) : walk<Deterministic>(arguments);
}
