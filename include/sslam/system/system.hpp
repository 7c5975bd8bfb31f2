// SPDX-License-Identifier: BSD-3-Clause
// The whole of sslam behind one door: images in, poses and a map out.
//
//   sslam::Settings settings;
//   settings.camera = ...;
//   sslam::System system(settings);
//   while (camera.read(image)) std::cout << system.track(image, stamp).cam_from_world ...
//   system.finish();
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sslam/io/trajectories/trajectory.hpp"
#include "sslam/system/engine.hpp"
#include "sslam/system/extraction.hpp"
#include "sslam/system/image_ref.hpp"
#include "sslam/system/observer.hpp"
#include "sslam/system/presets.hpp"
#include "sslam/system/settings.hpp"

namespace sslam {

// Where the camera was last, for other threads.
struct LatestPose {
  double stamp = 0;
  State state = State::kInitialising;
  std::optional<SE3<double>> world_from_cam;  // empty: no pose
  int world = 0;  // that the pose is in: poses of different worlds have nothing in common
};

// A front end finds features in images: ImageFrontend, or one of your own with the same two verbs. One thread
// calls track() and what changes the system; one, the same or another, calls extract(); any calls latest().
template <class Frontend>
class BasicSystem {
 public:
  // Throws SettingsError.
  explicit BasicSystem(Settings settings);
  ~BasicSystem();
  BasicSystem(const BasicSystem&) = delete;
  BasicSystem& operator=(const BasicSystem&) = delete;

  // The image, 8 bit grey, BGR or BGRA, of the camera's size, at `stamp`, in seconds. Stamps grow. What
  // cannot be used is said in FrameReport::input, and changes nothing.
  FrameReport track(const cv::Mat& image, double stamp);
  FrameReport track(const ImageRef& image, double stamp);
  // With a depth image registered to it: 16 bit, in Settings::depth_factor, or float, in metres; 0: unknown.
  // It serves the normals, where Settings::normals are those of depth.
  FrameReport track(const cv::Mat& image, const cv::Mat& depth, double stamp);
  FrameReport track(const ImageInput& input);

  // The two halves of track(): features of the next image may be looked for in one thread while the last
  // image is tracked in another. Extractions are tracked in the order of their stamps; `out` may be used
  // again, with its buffers.
  void extract(const ImageInput& input, Extraction& out);
  FrameReport track(Extraction& extraction);

  // No more images: takes in what mapping has still to do. Of several maps the one with most frames is kept.
  // Called once; a second call changes nothing.
  bool finish();  // true if that closed a loop

  [[nodiscard]] const Map<double>& map() const { return engine_->map(); }
  // One pose for each frame that has one in the map, ordered by stamp, by the map as it is now.
  [[nodiscard]] io::Trajectory trajectory() const;
  // Stamps of those that the final pass has bridged: turn measured, place between its neighbours'.
  [[nodiscard]] std::vector<double> bridged() const { return engine_->trajectory().bridged(); }
  [[nodiscard]] LatestPose latest() const;

  // The map as a file; throws Error. A map that is loaded is gone on in: frames are lost until one is
  // recognised in it, and the map is never given up.
  void save(const std::filesystem::path& path) const;
  void load(const std::filesystem::path& path);
  void resume(Map<double> map);

  // What another system with the same settings needs to go on from here with the next image: the worlds, the
  // camera's first, of which go_on() takes maps and logs. Its first frames are lost until one is recognised.
  [[nodiscard]] std::vector<const World<double>*> worlds() const { return engine_->worlds(); }
  [[nodiscard]] int last_number() const { return engine_->last_number(); }  // of a world that was begun
  void go_on(std::vector<World<double>> known, int begun_last) {
    engine_->go_on(std::move(known), begun_last);
  }

  // True: no keyframe is made and no map begun, left or joined: the camera is looked for in the map as it is.
  void localise_only(bool on) { engine_->localise_only(on); }

  // Observers are called in the order in which they came, and outlive the system or are removed.
  void add_observer(Observer& observer);
  void remove_observer(Observer& observer);
  void warn(const std::string& line);  // tells all observers

  [[nodiscard]] const Settings& settings() const noexcept { return settings_; }
  // Of the images as they are worked on: that of the settings, or a smaller one (Settings::longest_side).
  [[nodiscard]] const Camera<double>& camera() const noexcept { return camera_; }
  // Whether depth images are looked at.
  [[nodiscard]] bool reads_depth() const noexcept { return reads_depth_; }
  [[nodiscard]] const Preset& preset() const noexcept { return preset_; }
  [[nodiscard]] const ParameterTable& parameters() const noexcept { return parameters_; }
  [[nodiscard]] int world() const { return engine_->world(); }
  [[nodiscard]] MapsApart apart() const { return engine_->apart(); }
  [[nodiscard]] int keyframes_not_made() const { return engine_->keyframes_not_made(); }
  // Of a rolling shutter, as finish() was told it or has found it: seconds from the first row of an image to
  // the last. 0: all rows are read at once, or nothing is known.
  [[nodiscard]] double read_out() const { return engine_->read_out(); }
  [[nodiscard]] std::int64_t frames() const noexcept { return frames_; }  // taken in so far

 private:
  void set_parameters();
  void tell(const FrameReport& report, const Extraction& extraction);
  void ask_for_normals(Extraction& extraction, FrameReport& report);
  void keep_normal_picture(Extraction& extraction) const;
  void note_latest(const FrameReport& report);
  void warn_of_image_fixed(const FrameReport& report);

  Settings settings_;
  Camera<double> camera_;
  Preset preset_;
  std::unique_ptr<Frontend> frontend_;
  std::unique_ptr<Engine> engine_;
  ParameterTable parameters_;
  std::vector<Observer*> observers_;
  Extraction extraction_;  // of track(image, ...)
  std::int64_t frames_ = 0;
  std::optional<double> last_stamp_;
  int last_world_ = 0;
  bool reads_depth_ = false;
  bool normals_on_demand_ = false;
  bool finished_ = false;
  bool told_of_image_fixed_ = false;
  mutable std::mutex latest_mutex_;
  LatestPose latest_;
};

using System = BasicSystem<ImageFrontend<NormalChoice>>;
extern template class BasicSystem<ImageFrontend<NormalChoice>>;  // src/system.cpp

}  // namespace sslam
