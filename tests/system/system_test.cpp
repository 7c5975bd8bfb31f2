// SPDX-License-Identifier: BSD-3-Clause
// The door: images in, poses and a map out.
#include "sslam/system/system.hpp"

#include <atomic>
#include <limits>
#include <set>
#include <thread>

#include "sslam/io/evaluation/evaluation.hpp"
#include "support/catch.hpp"
#include "support/rendered_room.hpp"
#include "support/scratch_folder.hpp"

using namespace sslam;
using namespace sslam::testing;

namespace {

constexpr int kFrames = 60;

const RenderedRoom& room() {
  static const RenderedRoom rendered = render_room({}, kFrames);
  return rendered;
}

Settings settings_of(const RenderedRoom& of) {
  Settings settings;
  settings.camera = of.camera;
  return settings;
}

FrameReport track(System& system, int frame) {
  return system.track(room().images[static_cast<std::size_t>(frame)], frame / room().rate);
}

bool same_poses(const io::Trajectory& a, const io::Trajectory& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const auto& x, const auto& y) {
    return x.stamp == y.stamp && x.world_from_cam.translation == y.world_from_cam.translation &&
           x.world_from_cam.rotation.matrix() == y.world_from_cam.rotation.matrix();
  });
}

std::string field_refused(const Settings& settings) {
  try {
    System system(settings);
  } catch (const SettingsError& error) {
    CHECK(std::string(error.what()).starts_with(error.field + ": "));
    return error.field;
  }
  return "";
}

struct Counter : Observer {
  void frame_tracked(const FrameEvent& event) override {
    ++frames;
    pictures += !event.input.picture.empty();
  }
  void keyframe_made(const FrameEvent&) override { ++keyframes; }
  void map_changed(const FrameEvent&) override { ++changes; }
  void warning(const std::string& line) override { warnings.push_back(line); }

  int frames = 0, keyframes = 0, changes = 0, pictures = 0;
  std::vector<std::string> warnings;
};

}  // namespace

TEST_CASE("Images of a rendered room go in, and poses and a map come out") {
  System system(settings_of(room()));
  int posed = 0;
  for (int i = 0; i < kFrames; ++i) posed += track(system, i).has_pose();
  system.finish();
  CHECK(posed > kFrames / 2);
  CHECK(system.frames() == kFrames);
  CHECK_FALSE(system.map().points.empty());
  REQUIRE(system.trajectory().size() > 0.9 * kFrames);
  const io::Evaluation evaluation = io::evaluate(room().truth, system.trajectory());
  CHECK(evaluation.position.rmse < 0.02);
}

TEST_CASE("The same images give the same poses, as cv::Mat, as a plain view, and in two halves") {
  std::vector<io::Trajectory> trajectories;
  for (int way = 0; way < 3; ++way) {
    System system(settings_of(room()));
    Extraction extraction;
    for (int i = 0; i < kFrames; ++i) {
      const cv::Mat& image = room().images[static_cast<std::size_t>(i)];
      const double stamp = i / room().rate;
      if (way == 0) system.track(image, stamp);
      if (way == 1)
        system.track(ImageRef{image.data, image.cols, image.rows, image.step[0], PixelFormat::kBgr8}, stamp);
      if (way == 2) {
        ImageInput input;
        input.index = i;
        input.stamp = stamp;
        input.image = image;
        system.extract(input, extraction);
        system.track(extraction);
      }
    }
    system.finish();
    trajectories.push_back(system.trajectory());
  }
  CHECK(same_poses(trajectories[0], trajectories[1]));
  CHECK(same_poses(trajectories[0], trajectories[2]));
}

TEST_CASE("Red and blue change places where the view says so") {
  const cv::Mat bgr(2, 2, CV_8UC3, cv::Scalar(10, 20, 30));
  const ImageRef rgb{bgr.data, 2, 2, bgr.step[0], PixelFormat::kRgb8};
  CHECK(to_mat(rgb).at<cv::Vec3b>(1, 1) == cv::Vec3b(30, 20, 10));
  CHECK(to_mat({}).empty());
  CHECK_THROWS_AS(to_mat({bgr.data, 2, 2, 5, PixelFormat::kRgb8}), Error);
}

TEST_CASE("Images and stamps that cannot be used are told and change nothing") {
  System system(settings_of(room()));
  for (int i = 0; i < 5; ++i) REQUIRE(track(system, i).input == InputStatus::kOk);
  const double next = 5 / room().rate;
  CHECK(system.track(cv::Mat(), next).input == InputStatus::kEmptyImage);
  CHECK(system.track(cv::Mat(100, 100, CV_8UC3), next).input == InputStatus::kWrongSize);
  CHECK(system.track(cv::Mat(240, 320, CV_16UC1), next).input == InputStatus::kWrongType);
  CHECK(track(system, 4).input == InputStatus::kBadStamp);
  CHECK(track(system, 2).input == InputStatus::kBadStamp);
  CHECK(system.track(room().images[5], std::numeric_limits<double>::quiet_NaN()).input ==
        InputStatus::kBadStamp);
  CHECK(system.frames() == 5);
  CHECK(track(system, 5).input == InputStatus::kOk);
  system.finish();
  CHECK_FALSE(system.finish());
  CHECK(track(system, 6).input == InputStatus::kFinished);
  CHECK(system.frames() == 6);
}

TEST_CASE("Images that are larger than they need be are shrunk, and observers see them so") {
  Settings settings = settings_of(room());
  settings.longest_side = room().camera.width * 3 / 4;
  settings.keep_pictures = true;
  System system(settings);
  CHECK(system.camera().width == settings.longest_side);
  struct Sizes : Observer {
    void frame_tracked(const FrameEvent& event) override {
      widths.insert(event.input.picture.cols);
      widths.insert(event.frame.frame.width);
    }
    std::set<int> widths;
  } sizes;
  system.add_observer(sizes);
  int posed = 0;
  for (int frame = 0; frame < kFrames; ++frame) posed += track(system, frame).has_pose();
  CHECK(sizes.widths == std::set<int>{settings.longest_side});
  CHECK(posed > kFrames / 2);
  cv::Mat small;
  cv::resize(room().images[0], small, {system.camera().width, system.camera().height});
  CHECK(system.track(small, 100).input == InputStatus::kWrongSize);
}

TEST_CASE("finish() tracks the frames again, unless the settings leave that out") {
  Settings settings = settings_of(room());
  System twice(settings);
  settings.final_pass = false;
  System once(settings);
  for (int frame = 0; frame < kFrames; ++frame) {
    track(twice, frame);
    track(once, frame);
  }
  CHECK(same_poses(once.trajectory(), twice.trajectory()));
  twice.finish();
  const io::Trajectory before = once.trajectory();
  once.finish();
  CHECK(same_poses(before, once.trajectory()));
  CHECK_FALSE(same_poses(once.trajectory(), twice.trajectory()));
}

TEST_CASE("Settings that contradict themselves are refused by the name of the field") {
  const Settings good = settings_of(room());
  CHECK(field_refused(good).empty());
  Settings bad = good;
  bad.preset = "structur";
  CHECK(field_refused(bad) == "preset");
  bad = good;
  bad.camera.width = 0;
  CHECK(field_refused(bad) == "camera");
  bad = good;
  bad.camera.pinhole.fx = std::numeric_limits<double>::quiet_NaN();
  CHECK(field_refused(bad) == "camera");
  bad = good;
  bad.normals.source = DepthNormals{};
  bad.depth_factor = 0;
  CHECK(field_refused(bad) == "depth_factor");
  bad = good;
  bad.preset = "paper";
  bad.live = true;
  CHECK(field_refused(bad) == "live");
  bad = good;
  bad.parameters = {{"rotation.squarenes", 0.1}};
  CHECK(field_refused(bad) == "parameters");
}

TEST_CASE("Observers hear of frames, keyframes, changes of the map and warnings") {
  Settings settings = settings_of(room());
  settings.keep_pictures = true;
  System system(settings);
  Counter counter;
  system.add_observer(counter);
  for (int i = 0; i < kFrames; ++i) track(system, i);
  system.warn("a line");
  CHECK(counter.frames == kFrames);
  CHECK(counter.pictures == kFrames);
  CHECK(counter.keyframes > 1);
  CHECK(counter.changes >= counter.keyframes);
  CHECK(counter.warnings == std::vector<std::string>{"a line"});
  system.remove_observer(counter);
  system.warn("unheard");
  CHECK(counter.warnings.size() == 1);
}

TEST_CASE("The latest pose can be read from another thread while images are tracked") {
  Settings settings = settings_of(room());
  settings.live = true;
  System system(settings);
  std::atomic<bool> done = false;
  bool ordered = true;
  std::thread reader([&] {
    double last = 0;
    while (!done) {
      const double now = system.latest().stamp;
      ordered = ordered && now >= last;
      last = now;
    }
  });
  for (int i = 0; i < kFrames; ++i) track(system, i);
  system.finish();
  done = true;
  reader.join();
  CHECK(ordered);
  CHECK(system.latest().stamp == Approx((kFrames - 1) / room().rate));
}

TEST_CASE("A map that was saved is gone on in, and stays as it is where the camera is only localised") {
  const ScratchFolder scratch;
  const auto file = scratch.path() / "map.sslam";
  System first(settings_of(room()));
  for (int i = 0; i < kFrames; ++i) track(first, i);
  first.finish();
  first.save(file);
  for (const bool only : {false, true}) {
    System second(settings_of(room()));
    second.load(file);
    second.localise_only(only);
    const std::size_t known = second.map().keyframes.size();
    int posed = 0;
    for (int i = 0; i < kFrames; ++i) posed += track(second, i).has_pose();
    CHECK(posed > kFrames * 0.9);
    if (only)
      CHECK(second.map().keyframes.size() == known);
    else
      CHECK(second.map().keyframes.size() >= known);
  }
  System third(settings_of(room()));
  CHECK_THROWS_AS(third.load(scratch.path() / "none.sslam"), Error);
}
