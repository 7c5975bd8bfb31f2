// SPDX-License-Identifier: BSD-3-Clause
// `sslam run --foxglove`: the run's messages while it goes on, for Foxglove and other clients of its
// protocol. The tracker hands over what is new and somebody has subscribed to; messages are made of it in the
// server's thread.
#pragma once

#include <chrono>
#include <cstdint>
#include <mutex>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "cli/foxglove/socket_server.hpp"
#include "cli/results/frame_record.hpp"
#include "cli/results/map_colours.hpp"
#include "sslam/io/datasets/dataset.hpp"
#include "sslam/system/observer.hpp"

namespace sslam::cli {

class LiveStream : public Observer {
 public:
  // Says where clients find it. Throws Error where nobody can listen, or where the dataset has stamps that
  // ROS has not.
  LiveStream(const Endpoint& endpoint, const io::Dataset& dataset);

  // A pass through the dataset begins. `camera`: of the images as they are worked on; `colours`: what the
  // tracker's thread has noted so far, read in that thread alone, until the next pass.
  void begin(const Camera<double>& camera, const FeatureColours& colours);

  void frame_tracked(const FrameEvent& event) override;
  void map_changed(const FrameEvent& event) override;
  void warning(const std::string& line) override;

  // No more frames: the finished map, and the path in it.
  void finish(const RunOutcome& outcome);

 private:
  struct MapState {
    std::int64_t time = 0;  // of the frame
    Map<double> map;        // landmarks alone
    MapColours colours;
    io::Trajectory trajectory;
  };
  struct Picture {
    cv::Mat image;  // empty: none
    std::int64_t time = 0;
  };
  struct Handover {
    std::vector<StreamMessage> ready;
    Picture picture, normals;
    std::optional<MapState> map;
  };
  [[nodiscard]] std::string diagnostics_of(const FrameEvent& event) const;
  [[nodiscard]] bool map_wanted() const;
  void hand_map_over(const FrameEvent& event);
  void hand_over(std::size_t channel, std::int64_t time, std::string message);
  [[nodiscard]] std::vector<StreamMessage> take();

  double seconds_per_stamp_;
  const FeatureColours* colours_ = nullptr;
  std::int64_t now_ = 0;     // of the newest frame; the tracker's own, and so is
  bool map_is_new_ = false;  // no client has it yet
  std::chrono::steady_clock::time_point map_given_{};
  std::mutex handing_;  // for what follows
  Handover handover_;
  SocketServer server_;
};

}  // namespace sslam::cli
