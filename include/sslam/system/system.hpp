// SPDX-License-Identifier: BSD-3-Clause
// All of sslam in one class: images in, poses and a map out.
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

// The latest pose of the camera, for other threads.
struct LatestPose {
  double stamp = 0;
  State state = State::kInitialising;
  std::optional<SE3<double>> world_from_cam;  // empty: no pose
  int world = 0;  // number of the map that the pose is in; different maps have different coordinates
};

// A front end finds features in images: ImageFrontend, or your own with the same two functions. Threads: one
// calls track() and everything else that changes the system; one, the same or another, calls extract(); any
// may call latest().
template <class Frontend>
class BasicSystem {
 public:
  // Throws SettingsError.
  explicit BasicSystem(Settings settings);
  ~BasicSystem();
  BasicSystem(const BasicSystem&) = delete;
  BasicSystem& operator=(const BasicSystem&) = delete;

  // Tracks the image: 8 bit grey, BGR or BGRA, of the camera's size, taken at `stamp`, in seconds. Stamps
  // increase. FrameReport::input says if the input cannot be used; then the system does not change.
  FrameReport track(const cv::Mat& image, double stamp);
  FrameReport track(const ImageRef& image, double stamp);
  // With a depth image registered to the image: 16 bit, in units of Settings::depth_factor, or float, in
  // metres; 0: unknown. It is used for normals, if Settings::normals come from depth.
  FrameReport track(const cv::Mat& image, const cv::Mat& depth, double stamp);
  FrameReport track(const ImageInput& input);

  // The two halves of track(): one thread may extract the features of the next image while another tracks the
  // last one. Track extractions in the order of their stamps. `out` may be reused, with its buffers.
  void extract(const ImageInput& input, Extraction& out);
  FrameReport track(Extraction& extraction);

  // Ends the input: waits for mapping and runs the final pass. Of several maps, keeps the one with most
  // frames. A second call does nothing.
  bool finish();  // true if that closed a loop

  [[nodiscard]] const Map<double>& map() const { return engine_->map(); }
  // The poses in the current map of all frames that have one, ordered by stamp.
  [[nodiscard]] io::Trajectory trajectory() const;
  // Stamps of the frames that the final pass bridged: rotation measured, position interpolated.
  [[nodiscard]] std::vector<double> bridged() const { return engine_->trajectory().bridged(); }
  [[nodiscard]] LatestPose latest() const;

  // Write and read the map as a file; both throw Error. The system continues in a loaded map: frames are lost
  // until one is recognised in it, and the map is never given up.
  void save(const std::filesystem::path& path) const;
  void load(const std::filesystem::path& path);
  void resume(Map<double> map);

  // The state from which another system with the same settings can continue with the next image: the worlds,
  // the one with the camera first. go_on() takes their maps and logs; the first frames are then lost until
  // one is recognised.
  [[nodiscard]] std::vector<const World<double>*> worlds() const { return engine_->worlds(); }
  [[nodiscard]] int last_number() const { return engine_->last_number(); }  // number of the newest world
  void go_on(std::vector<World<double>> known, int begun_last) {
    engine_->go_on(std::move(known), begun_last);
  }

  // True: the camera is only localised in the map. No keyframe is made; no map is begun, left or joined.
  void localise_only(bool on) { engine_->localise_only(on); }

  // Observers are called in the order in which they were added. Each must outlive the system or be removed.
  void add_observer(Observer& observer);
  void remove_observer(Observer& observer);
  void warn(const std::string& line);  // tells all observers

  [[nodiscard]] const Settings& settings() const noexcept { return settings_; }
  // The camera of the images at their working size: that of the settings, or a smaller one
  // (Settings::longest_side).
  [[nodiscard]] const Camera<double>& camera() const noexcept { return camera_; }
  // Whether depth images are used.
  [[nodiscard]] bool reads_depth() const noexcept { return reads_depth_; }
  [[nodiscard]] const Preset& preset() const noexcept { return preset_; }
  [[nodiscard]] const ParameterTable& parameters() const noexcept { return parameters_; }
  [[nodiscard]] int world() const { return engine_->world(); }
  [[nodiscard]] MapsApart apart() const { return engine_->apart(); }
  [[nodiscard]] int keyframes_not_made() const { return engine_->keyframes_not_made(); }
  // Read-out time of a rolling shutter, given or estimated by finish(): seconds from the first row of an
  // image to the last. 0: all rows are read at once, or the time is not known.
  [[nodiscard]] double read_out() const { return engine_->read_out(); }
  [[nodiscard]] std::int64_t frames() const noexcept { return frames_; }  // number of frames so far

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
