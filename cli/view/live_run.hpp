// SPDX-License-Identifier: BSD-3-Clause
// A run as those see it who watch it: the tracker hands over what is new, and goes on; a server's threads
// make JSON of it for the report's page.
#pragma once

#include <cstdint>
#include <mutex>
#include <string>
#include <vector>

#include "cli/results/frame_record.hpp"
#include "cli/results/frame_view.hpp"
#include "cli/results/run_folder.hpp"
#include "cli/view/view_server.hpp"

namespace sslam::cli {

class LiveRun : public Observer {
 public:
  // settings: as metrics.json has them; total: frames of the run; camera: of the images; colours: what the
  // tracker's thread has noted so far, read in that thread alone.
  LiveRun(std::string name, nlohmann::ordered_json settings, std::size_t total, const Camera<double>& camera,
          const FeatureColours& colours);

  // The tracker's: notes the frame, and hands the map over if somebody has asked since the last time. Waits
  // for nobody but for the moment in which another thread takes what was handed over.
  void frame_tracked(const FrameEvent& event) override;

  // The server's: the page as of now.
  [[nodiscard]] SharedText page();
  // The newest state for a page that has `version`; null where that is the newest.
  [[nodiscard]] SharedText news(std::uint64_t version);

  // The run is over, and this is its report.
  void finish(std::string report);

 private:
  struct Handover {
    std::vector<FrameRecord> frames;  // since the last one was taken
    Map<double> map;                  // landmarks alone
    MapColours colours;               // of its landmarks
    io::Trajectory trajectory, keyframes;
    std::string view;
    std::uint64_t version = 0;
  };
  void take_over();
  [[nodiscard]] nlohmann::ordered_json data();

  Camera<double> camera_;
  const FeatureColours& colours_;
  std::vector<FrameRecord> unseen_;  // the tracker's own
  std::size_t rows_ = 0;             // and that, frames so far
  std::mutex handing_;               // for what follows
  Handover handover_;
  bool wanted_ = false;
  SharedText report_;

  std::mutex making_;  // for what follows
  RunFolder run_;
  std::string view_;
  std::uint64_t version_ = 0;
  SharedText news_;
  std::size_t total_;
};

}  // namespace sslam::cli
