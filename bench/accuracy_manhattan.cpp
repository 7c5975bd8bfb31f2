// SPDX-License-Identifier: BSD-3-Clause
// Accuracy of the Manhattan rotation alone, before any refinement, on a sequence with ground truth:
//   accuracy_manhattan FOLDER [both|lines|normals] [--model ONNX] [--camera NAME] [--csv FILE] [--find]
// FOLDER is a dataset with images and, for normals without --model, depth; or it holds stored normals in
// normals/N.png with an ICL-NUIM ground truth. --find searches the whole of SO(3) in every frame instead of
// tracking from the last one.
#include <chrono>
#include <cstdio>
#include <exception>
#include <fstream>
#include <map>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "rotation_offsets.hpp"
#include "sslam/io/datasets/known_cameras.hpp"
#include "sslam/io/datasets/open_dataset.hpp"
#include "sslam/io/trajectories/read_trajectory.hpp"
#include "sslam/manhattan/search.hpp"
#include "sslam/opencv/image_frontend.hpp"
#include "sslam/opencv/normals/depth_normals.hpp"
#include "sslam/opencv/normals/file_normals.hpp"
#include "sslam/opencv/normals/onnx_normals.hpp"

namespace {

using namespace sslam;

struct Settings {
  std::filesystem::path folder;
  bool lines = true;
  bool normals = true;
  bool find = false;
  std::string model;  // of a network's normals; empty: normals from depth
  std::string csv;
  std::string camera;  // of the built-in calibrations; empty: by dataset
};

// What one frame brings to the kernel.
struct Votes {
  double stamp = 0;
  SO3<double> cam_from_world;  // truth
  NormalField normals;
  std::vector<LineVote<float>> lines;
};

struct FrameResult {
  double stamp = 0;
  bench::RotationPair pair;
  ManhattanEstimate<float> estimate;
  double seconds = 0;
};

// The pose predicted for the next frame is the last one, this much less certain.
constexpr float kTurnPerFrameDeg = 3;

class Runner {
 public:
  explicit Runner(bool find) : find_(find) {}

  void frame(const Votes& votes) {
    const NormalView<float> normals{votes.normals.x.data(), votes.normals.y.data(),
                                    votes.normals.z.data(), votes.normals.weight.data(),
                                    votes.normals.size(),   1};
    const std::span<const LineVote<float>> lines(votes.lines);
    SearchOptions<float> options;
    options.rotation = options.rotation.with_plane_sigma(votes.normals.plane_sigma);
    FrameResult result;
    result.stamp = votes.stamp;
    const auto start = std::chrono::steady_clock::now();
    if (find_ || !started_)
      result.estimate = find_manhattan<float>(normals, lines, options, 1);
    else
      result.estimate = track_manhattan<float>(normals, lines, prior_, options.rotation);
    result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    ++attempts_;
    if (!started_ && !usable(result.estimate.status)) return;
    if (find_) {
      // Each frame names its axes afresh; the truth tells how they were named in the first.
      if (!started_)
        manhattan_ = result.estimate.cam_from_manhattan.cast<double>().inverse() * votes.cam_from_world;
      const SO3<double> expected = votes.cam_from_world * manhattan_.inverse();
      result.estimate.cam_from_manhattan =
          closest_naming(result.estimate.cam_from_manhattan, expected.cast<float>());
      if (!usable(result.estimate.status)) return;
    }
    started_ = true;
    prior_.cam_from_manhattan = result.estimate.cam_from_manhattan;
    const float turn = radians(kTurnPerFrameDeg);
    prior_.covariance = result.estimate.covariance + turn * turn * Mat3<float>::Identity();
    result.pair = {result.estimate.cam_from_manhattan.cast<double>(), votes.cam_from_world};
    results_.push_back(result);
  }

  [[nodiscard]] const std::vector<FrameResult>& results() const { return results_; }
  [[nodiscard]] int attempts() const { return attempts_; }

 private:
  bool find_;
  bool started_ = false;
  int attempts_ = 0;
  SO3<double> manhattan_;  // manhattan_from_world
  ManhattanPrior<float> prior_;
  std::vector<FrameResult> results_;
};

// normals/N.png with a trajectory of ICL-NUIM, whose stamps are N.
void run_stored_normals(const Settings& settings, Runner& runner) {
  io::Warnings warnings;
  io::Trajectory truth = io::read_trajectory(io::find_icl_nuim_truth(settings.folder), warnings);
  io::mirror_y(truth);
  const Camera<double> camera = io::find_known_camera("icl_nuim")->camera;
  FileNormals source;
  source.options.folder = settings.folder / "normals";
  for (const io::StampedPose& pose : truth) {
    ImageInput input;
    input.stamp = pose.stamp;
    input.name = std::to_string(static_cast<long>(pose.stamp));
    Votes votes;
    if (source.fill(input, camera, votes.normals) != NormalStatus::kOk) continue;
    votes.stamp = pose.stamp;
    votes.cam_from_world = pose.world_from_cam.rotation.inverse();
    runner.frame(votes);
  }
}

template <NormalSource Source>
void run_dataset(const Settings& settings, Source source, Runner& runner) {
  const io::Dataset dataset = io::open_dataset(settings.folder);
  const auto known =
      settings.camera.empty() ? io::known_camera_for(dataset) : io::find_known_camera(settings.camera);
  if (!known)
    throw Error(settings.folder.string() +
                ": no built-in calibration; name one with --camera: " + io::known_camera_names());
  ImageFrontend<> frontend;
  frontend.camera = known->camera;
  Frame<double> frame;
  for (const io::FrameEntry& entry : dataset.frames) {
    const SE3<double>* const world_from_cam = dataset.world_from_cam(entry);
    if (world_from_cam == nullptr) continue;
    ImageInput input;
    input.image = cv::imread(entry.image, cv::IMREAD_COLOR);
    if (!entry.depth.empty()) input.depth = cv::imread(entry.depth, cv::IMREAD_UNCHANGED);
    input.depth_factor = known->depth_factor;
    if (frontend.process(input, frame).image != ImageStatus::kOk) continue;
    Votes votes;
    votes.stamp = entry.stamp;
    votes.cam_from_world = world_from_cam->rotation.inverse();
    if (settings.normals && source.fill(input, frontend.camera, votes.normals) != NormalStatus::kOk)
      votes.normals.clear();
    if (settings.lines) {
      for (const LineFeature<double>& line : frame.lines) {
        const LineVote<double> vote = line_vote(line.segment, frame.pinhole, line.sigma);
        votes.lines.push_back(
            {vote.plane_normal.cast<float>(), static_cast<float>(vote.sigma), vote.ray.cast<float>()});
      }
    }
    runner.frame(votes);
  }
}

double quantile(std::vector<double> values, double q) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  return values[std::min(values.size() - 1,
                         static_cast<std::size_t>(q * static_cast<double>(values.size())))];
}

void print_errors(const char* title, const std::vector<double>& errors) {
  std::printf("  %-32s median %.3f  p90 %.3f  p95 %.3f  max %.3f deg\n", title,
              degrees(quantile(errors, 0.5)), degrees(quantile(errors, 0.9)), degrees(quantile(errors, 0.95)),
              degrees(quantile(errors, 1)));
}

void report(const Settings& settings, const Runner& runner) {
  const std::vector<FrameResult>& results = runner.results();
  std::vector<bench::RotationPair> pairs, sure;
  std::vector<double> times;
  std::map<std::string, int> states;
  std::map<int, int> seen;
  for (const FrameResult& result : results) {
    pairs.push_back(result.pair);
    if (usable(result.estimate.status)) sure.push_back(result.pair);
    times.push_back(result.seconds);
    ++states[name(result.estimate.status)];
    ++seen[result.estimate.axes_seen];
  }
  std::printf("%s\n  %zu of %d frames", settings.folder.string().c_str(), results.size(), runner.attempts());
  for (const auto& [state, count] : states) std::printf(", %s: %d", state.c_str(), count);
  for (const auto& [axes, count] : seen) std::printf(", %d axes: %d", axes, count);
  std::printf("\n");
  if (pairs.empty()) return;
  const bench::RotationOffsets right = bench::find_offsets(pairs, false);
  const bench::RotationOffsets both = bench::find_offsets(pairs, true);
  const std::vector<double> errors = bench::rotation_errors(pairs, both);
  print_errors("world offset removed", bench::rotation_errors(pairs, right));
  print_errors("world and camera offset removed", errors);
  print_errors("the same, frames that are ok", bench::rotation_errors(sure, both));
  std::printf("  camera offset %.3f deg; kernel median %.3f ms, p95 %.3f ms\n",
              degrees(both.left.log().norm()), 1e3 * quantile(times, 0.5), 1e3 * quantile(times, 0.95));
  if (settings.csv.empty()) return;
  std::ofstream csv(settings.csv);
  csv << "stamp,status,axes_seen,error_deg,deviation_deg,line_rms,ms\n";
  const std::vector<double> strict = bench::rotation_errors(pairs, right);
  for (std::size_t i = 0; i < results.size(); ++i) {
    const ManhattanEstimate<float>& e = results[i].estimate;
    csv << results[i].stamp << ',' << name(e.status) << ',' << e.axes_seen << ',' << degrees(strict[i]) << ','
        << degrees(e.deviation) << ',' << e.line_rms << ',' << 1e3 * results[i].seconds << '\n';
  }
}

bool parse(int argc, char** argv, Settings& settings) {
  if (argc < 2) return false;
  settings.folder = argv[1];
  for (int i = 2; i < argc; ++i) {
    const std::string_view word = argv[i];
    if (word == "lines")
      settings.normals = false;
    else if (word == "normals")
      settings.lines = false;
    else if (word == "--find")
      settings.find = true;
    else if (word == "--csv" && i + 1 < argc)
      settings.csv = argv[++i];
    else if (word == "--model" && i + 1 < argc)
      settings.model = argv[++i];
    else if (word == "--camera" && i + 1 < argc)
      settings.camera = argv[++i];
    else if (word != "both")
      return false;
  }
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  Settings settings;
  if (!parse(argc, argv, settings)) {
    std::fprintf(stderr,
                 "usage: accuracy_manhattan FOLDER [both|lines|normals] [--model ONNX] [--camera NAME] "
                 "[--csv FILE] [--find]\n");
    return 2;
  }
  try {
    Runner runner(settings.find);
    if (std::filesystem::is_directory(settings.folder / "normals"))
      run_stored_normals(settings, runner);
    else if (settings.model.empty())
      run_dataset(settings, DepthNormals(), runner);
    else
      run_dataset(settings, OnnxNormals(settings.model), runner);
    report(settings, runner);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "accuracy_manhattan: %s\n", error.what());
    return 1;
  }
}
