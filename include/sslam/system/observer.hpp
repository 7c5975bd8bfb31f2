// SPDX-License-Identifier: BSD-3-Clause
// Those who look on while a System works: a progress bar, a video, a window, a robot's planner.
#pragma once

#include <string>

#include "sslam/map/map.hpp"
#include "sslam/system/extraction.hpp"
#include "sslam/system/frame_report.hpp"
#include "sslam/track/contract/tracked_frame.hpp"
#include "sslam/track/worlds/trajectory_log.hpp"

namespace sslam {

// A frame that was just tracked, and the system as it stands then. Valid during the call.
struct FrameEvent {
  const FrameReport& report;
  const Extraction& input;
  const TrackedFrame<double>& frame;
  const Map<double>& map;  // of the world that the camera is in
  const TrajectoryLog<double>& trajectory;
};

// Everything is called in the thread that calls System::track, after the frame is done, in the order of these
// functions. What an observer throws comes out of track; the frame counts as tracked.
class Observer {
 public:
  virtual ~Observer() = default;
  virtual void frame_tracked(const FrameEvent&) {}  // each frame, lost ones and all
  virtual void keyframe_made(const FrameEvent&) {}  // the frame has joined the map
  virtual void loop_closed(const FrameEvent&) {}    // a place was recognised: the map has moved
  virtual void maps_joined(const FrameEvent&) {}    // with a map that had been left
  virtual void map_changed(const FrameEvent&) {}    // for any of these reasons, or because another map began
  virtual void warning(const std::string&) {}       // one line, for people
};

}  // namespace sslam
