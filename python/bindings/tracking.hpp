// SPDX-License-Identifier: BSD-3-Clause
// A System for Python: one caller at a time, whatever the threads, and never with the interpreter's lock held
// while it works or waits.
#pragma once

#include <nanobind/nanobind.h>
#include <sys/types.h>

#include <filesystem>
#include <memory>
#include <mutex>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "bindings/free.hpp"
#include "bindings/map_arrays.hpp"
#include "cli/results/map_colours.hpp"
#include "sslam/system/system.hpp"

namespace sslam::python {

// What System::track says, and what its observers would have heard. Callbacks are called from it, by Python,
// when nothing is held any more.
struct Result : FrameReport {
  bool map_changed = false;
  std::vector<std::string> warnings;
};

// Pixels stay the caller's, and are read during the call alone. Empty: there is none.
struct Given {
  cv::Mat image, depth, mask;
  cv::Mat normals;  // as take_normals takes them
  bool rgb = false;
  double stamp = 0;
  std::string name;
};

// Raised as sslam.FinishedError.
struct Finished : Error {
  using Error::Error;
};

class Tracking : Observer {
 public:
  // normals_sigma: of normals that come with the images, radians (NormalField::plane_sigma).
  Tracking(Settings settings, double normals_sigma);
  ~Tracking() override;
  Tracking(const Tracking&) = delete;
  Tracking& operator=(const Tracking&) = delete;

  [[nodiscard]] Result track(const Given& given);
  bool finish();
  void load(const std::filesystem::path& path);
  void localise_only(bool on);

  // What use(system) answers, when nobody else uses the system. Runs without the interpreter's lock.
  template <class Use>
  auto read(Use use) {
    const Turn turn(*this);
    return use(std::as_const(*system_));
  }
  [[nodiscard]] CloudRows cloud();

  // For what needs no turn.
  [[nodiscard]] const System& system() const {
    demand_same_process();
    return *system_;
  }

 private:
  // One caller's turn, without the interpreter's lock.
  struct Turn {
    explicit Turn(Tracking& tracking) : lock((tracking.demand_same_process(), tracking.in_use_)) {}
    Free free;
    std::lock_guard<std::mutex> lock;
  };
  void demand_same_process() const;
  void demand_unfinished(const char* call) const;
  [[nodiscard]] std::string fault(InputStatus status, const Given& given) const;
  void add_normals(const cv::Mat& normals);
  void keyframe_made(const FrameEvent& event) override;
  void map_changed(const FrameEvent&) override { heard_.map_changed = true; }
  void warning(const std::string& line) override { heard_.warnings.push_back(line); }

  pid_t process_;
  std::unique_ptr<System> system_;
  double normals_sigma_;
  std::mutex in_use_;  // the members below, and what changes the system
  Extraction extraction_;
  Result heard_;
  cli::FeatureColours colours_;
  std::optional<double> last_stamp_;
  bool finished_ = false;
};

}  // namespace sslam::python
