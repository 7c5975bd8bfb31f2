// SPDX-License-Identifier: BSD-3-Clause
// What real cameras do and rendered ones do not, each on rendered images: bounds are twice what was measured.
#include <opencv2/imgproc.hpp>
#include <string>
#include <utility>
#include <vector>

#include "sslam/core/median.hpp"
#include "sslam/io/evaluation/evaluation.hpp"
#include "sslam/solver/triangulation/triangulate_point.hpp"
#include "sslam/system/system.hpp"
#include "support/catch.hpp"
#include "support/rendered_room.hpp"

using namespace sslam;
using namespace sslam::testing;

namespace real_cameras {
namespace {

struct Outcome {
  double tracked = 0, structure = 0;  // shares of the frames
  double ate = 0, ate_live = 0;       // metres
  bool warned = false;
};

struct Listener : Observer {
  void warning(const std::string& line) override {
    warned |= line.find("do not move in the image") != std::string::npos;
  }
  bool warned = false;
};

double ate_of(const io::Trajectory& truth, const io::Trajectory& estimate) {
  return io::evaluate(truth, estimate).position.rmse;
}

// The images, at most `every` of them, as the settings say that the camera took them.
Outcome track(const RenderedRoom& room, Settings settings, std::size_t every = 1) {
  System system(std::move(settings));
  Listener listener;
  system.add_observer(listener);
  Outcome outcome;
  io::Trajectory live, truth;
  for (std::size_t i = 0; i < room.images.size(); i += every) {
    const FrameReport report = system.track(room.images[i], room.truth[i].stamp);
    truth.push_back(room.truth[i]);
    outcome.structure += report.structure;
    if (report.has_pose()) live.push_back({report.stamp, report.cam_from_world.inverse()});
  }
  system.finish();
  const auto frames = static_cast<double>(truth.size());
  outcome.tracked = static_cast<double>(system.trajectory().size()) / frames;
  outcome.structure /= frames;
  outcome.ate = ate_of(truth, system.trajectory());
  outcome.ate_live = ate_of(truth, live);
  outcome.warned = listener.warned;
  UNSCOPED_INFO("tracked " << outcome.tracked << ", structure " << outcome.structure << ", ATE "
                           << outcome.ate << " m, live " << outcome.ate_live << " m");
  return outcome;
}

const RenderedRoom& room() {
  static const RenderedRoom rendered = render_room({}, 80);
  return rendered;
}

Settings settings_of(const RenderedRoom& of) {
  Settings settings;
  settings.camera = of.camera;
  return settings;
}

// By how much the features that see one point contradict each other, if the true poses are given: the median
// error of a feature against the point that all of them give, pixels of its level.
double disagreement(Settings settings) {
  System system(std::move(settings));
  for (std::size_t i = 0; i < room().images.size(); ++i)
    (void)system.track(room().images[i], room().truth[i].stamp);
  system.finish();
  const Map<double>& map = system.map();
  std::vector<double> errors;
  for (const PointLandmark<double>& landmark : map.points) {
    if (!landmark.alive || landmark.observations.size() < 3) continue;
    std::vector<PointView<double>> views;
    for (const Observation& o : landmark.observations) {
      const Frame<double>& frame = map.keyframes[map.index(o.keyframe)].frame;
      const PointFeature<double>& feature = frame.points[map.index(o.feature)];
      const SE3<double>& world_from_cam = room().truth[static_cast<std::size_t>(frame.index)].world_from_cam;
      views.push_back({world_from_cam.inverse(), frame.pinhole.unproject(feature.pixel).head<2>(),
                       feature.sigma / frame.pinhole.fx});
    }
    const auto point = triangulate_point<double>(views);
    if (!usable(point.status)) continue;
    for (const PointView<double>& view : views) {
      const Vec3<double> seen = view.cam_from_world * point.point;
      errors.push_back(0.5 * (seen.head<2>() / seen.z() - view.normalised).norm() / view.sigma);
    }
  }
  REQUIRE(errors.size() > 1000);
  return median<double>(errors);
}

}  // namespace

TEST_CASE("Poses of the final pass are nearer to the truth than those when the next frame came") {
  const Outcome outcome = track(room(), settings_of(room()));
  CHECK_FALSE(outcome.warned);
  CHECK(outcome.tracked == 1);
  CHECK(outcome.ate < 0.8 * outcome.ate_live);
}

TEST_CASE("Features of the keyframes agree better with the true poses once the final pass has aligned them") {
  Settings detected = settings_of(room());
  detected.parameters = {{"final_pass.alignment.max_shift", 0}};
  const double before = disagreement(detected), after = disagreement(settings_of(room()));
  INFO(before << " pixels as detected, " << after << " aligned");
  CHECK(after < 0.8 * before);
}

TEST_CASE("Structure acts and tracking holds where the calibration is off") {
  Settings lens = settings_of(room()), focal = lens;
  lens.camera.distortion.k1 = 0.03;
  focal.camera.pinhole.fx *= 1.02;
  focal.camera.pinhole.fy *= 1.02;
  const Outcome with_lens = track(room(), lens), with_focal = track(room(), focal);
  CHECK(with_lens.tracked == 1);
  CHECK(with_lens.structure > 0.4);
  CHECK(with_lens.ate < 0.047);
  CHECK(with_focal.tracked == 1);
  CHECK(with_focal.structure > 0.6);
  CHECK(with_focal.ate < 0.03);
}

TEST_CASE("A camera of a few frames a second is tracked") {
  const Outcome outcome = track(room(), settings_of(room()), 3);  // 5 a second
  CHECK(outcome.tracked == 1);
  CHECK(outcome.structure > 0.5);
  CHECK(outcome.ate < 0.008);
}

TEST_CASE("An image with more pixels than its lens resolves is tracked as well as one with few") {
  constexpr int kTimes = 6;
  RenderedRoom large;
  large.truth = room().truth;
  large.camera = room().camera;
  large.camera.width *= kTimes;
  large.camera.height *= kTimes;
  auto& k = large.camera.pinhole;
  k = {k.fx * kTimes, k.fy * kTimes, (k.cx + 0.5) * kTimes - 0.5, (k.cy + 0.5) * kTimes - 0.5};
  for (const cv::Mat& image : room().images)
    cv::resize(image, large.images.emplace_back(), {}, kTimes, kTimes, cv::INTER_LINEAR);
  const Outcome outcome = track(large, settings_of(large));
  CHECK(outcome.tracked == 1);
  CHECK(outcome.structure > 0.6);
  CHECK(outcome.ate < 0.005);
}

TEST_CASE("What is fixed to the image is left out, and told") {
  RenderedRoom cockpit = room();
  for (cv::Mat& image : cockpit.images) {
    image = image.clone();
    cv::Mat dashboard = image(cv::Rect(0, image.rows * 3 / 4, image.cols, image.rows / 4));
    cv::RNG random(3);
    for (int i = 0; i < 150; ++i) {
      const cv::Point at(random.uniform(0, dashboard.cols), random.uniform(0, dashboard.rows));
      const int shade = random.uniform(0, 255);
      cv::rectangle(dashboard, at, at + cv::Point(random.uniform(4, 20), random.uniform(4, 12)),
                    cv::Scalar::all(shade), cv::FILLED);
    }
  }
  const Outcome outcome = track(cockpit, settings_of(cockpit));
  CHECK(outcome.warned);
  CHECK(outcome.tracked == 1);
  CHECK(outcome.ate < 0.042);
}

}  // namespace real_cameras
