// SPDX-License-Identifier: BSD-3-Clause
// Observers of a System at work: a progress bar, a video, a window, a robot's planner.
#pragma once

#include <string>

#include "sslam/map/map.hpp"
#include "sslam/system/extraction.hpp"
#include "sslam/system/frame_report.hpp"
#include "sslam/track/contract/tracked_frame.hpp"
#include "sslam/track/worlds/trajectory_log.hpp"

namespace sslam {

// A frame that was just tracked, and the state of the system after it. Valid during the call.
struct FrameEvent {
  const FrameReport& report;
  const Extraction& input;
  const TrackedFrame<double>& frame;
  const Map<double>& map;  // of the world that the camera is in
  const TrajectoryLog<double>& trajectory;
};

// All functions are called in the thread that calls System::track, after the frame is done, in this order. An
// exception in an observer leaves track(); the frame counts as tracked.
class Observer {
 public:
  virtual ~Observer() = default;
  virtual void frame_tracked(const FrameEvent&) {}  // each frame, also lost ones
  virtual void keyframe_made(const FrameEvent&) {}  // the frame has become a keyframe
  virtual void loop_closed(const FrameEvent&) {}    // a place was recognised: the map has changed
  virtual void maps_joined(const FrameEvent&) {}    // this map and one that had been left
  virtual void map_changed(const FrameEvent&) {}    // by any of these events, or another map began
  virtual void warning(const std::string&) {}       // one line, for people
};

}  // namespace sslam
