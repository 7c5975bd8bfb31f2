// SPDX-License-Identifier: BSD-3-Clause
// The observer that writes down a run: a record of each frame, pictures for the report, the colours
// of features, warnings.
#pragma once

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "cli/dense/keyframe_pictures.hpp"
#include "cli/results/frame_record.hpp"
#include "cli/results/frame_view.hpp"
#include "cli/results/map_colours.hpp"
#include "sslam/system/observer.hpp"

namespace sslam::cli {

class RunRecorder : public Observer {
 public:
  // frames: how many are expected; 0: not known. Of all of them, at most `most_views` pictures are kept for
  // the report, evenly.
  RunRecorder(const Camera<double>& camera, std::size_t frames, std::size_t most_views)
      : camera_(camera), most_views_(most_views) {
    if (most_views > 0) view_stride_ = std::max<std::size_t>(1, (frames + most_views - 1) / most_views);
    outcome.frames.reserve(frames);
  }

  void frame_tracked(const FrameEvent& event) override {
    const std::size_t row = outcome.frames.size();
    if (view_stride_ > 0 && row % view_stride_ == 0 && outcome.views.size() == most_views_) thin_out();
    if (view_stride_ > 0 && row % view_stride_ == 0)
      outcome.views.push_back(encode_frame_view(frame_view(event, row, camera_), event.frame));
    outcome.frames.push_back({event.report, event.input.label});
  }
  void keyframe_made(const FrameEvent& event) override {
    const Frame<double>& frame = event.frame.frame;
    const Extraction& input = event.input;
    colours.note(frame, input.picture, camera_);
    if (!keep_pictures) return;
    pictures.note(frame, input.picture, input.picture_mask);
    pictures.note_normals(frame, input.normal_picture, input.normal_pinhole);
  }
  void warning(const std::string& line) override { outcome.warnings.push_back(line); }

  RunOutcome outcome;
  FeatureColours colours;
  bool keep_pictures = false;  // of keyframes
  KeyframePictures pictures;

 private:
  // More frames than expected: every other picture goes.
  void thin_out() {
    std::vector<std::string>& views = outcome.views;
    for (std::size_t i = 1; 2 * i < views.size(); ++i) views[i] = std::move(views[2 * i]);
    views.resize((views.size() + 1) / 2);
    view_stride_ *= 2;
  }

  const Camera<double>& camera_;
  std::size_t most_views_;
  std::size_t view_stride_ = 0;  // every n-th frame is kept; 0: none
};

}  // namespace sslam::cli
