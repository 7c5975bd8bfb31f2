// SPDX-License-Identifier: BSD-3-Clause
// The observer that writes down a run: a record of each frame, pictures for the report, the colours
// of features, warnings.
#pragma once

#include <string>
#include <vector>

#include "cli/results/frame_record.hpp"
#include "cli/results/frame_view.hpp"
#include "cli/results/map_colours.hpp"
#include "sslam/system/observer.hpp"

namespace sslam::cli {

class RunRecorder : public Observer {
 public:
  // view_stride: every n-th frame is kept for the report; 0: none.
  RunRecorder(const Camera<double>& camera, std::size_t frames, std::size_t view_stride)
      : camera_(camera), view_stride_(view_stride) {
    outcome.frames.reserve(frames);
  }

  void frame_tracked(const FrameEvent& event) override {
    const std::size_t row = outcome.frames.size();
    if (view_stride_ > 0 && row % view_stride_ == 0)
      outcome.views.push_back(encode_frame_view(frame_view(event, row, camera_), event.frame));
    outcome.frames.push_back({event.report, event.input.label});
  }
  void keyframe_made(const FrameEvent& event) override {
    colours.note(event.frame.frame, event.input.picture, camera_);
  }
  void warning(const std::string& line) override { outcome.warnings.push_back(line); }

  RunOutcome outcome;
  FeatureColours colours;

 private:
  const Camera<double>& camera_;
  std::size_t view_stride_;
};

}  // namespace sslam::cli
