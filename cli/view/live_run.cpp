// SPDX-License-Identifier: BSD-3-Clause
#include "cli/view/live_run.hpp"

#include <algorithm>
#include <utility>

#include "cli/report.hpp"
#include "cli/report/base64.hpp"
#include "cli/report/report_data.hpp"
#include "cli/results/frame_table.hpp"
#include "cli/results/map_figures.hpp"
#include "cli/shell/json_text.hpp"
#include "cli/view/map_copy.hpp"
#include "sslam/core/move_to_end.hpp"

namespace sslam::cli {
LiveRun::LiveRun(std::string name, nlohmann::ordered_json settings, std::size_t total,
                 const Camera<double>& camera, const FeatureColours& colours)
    : camera_(camera), colours_(colours), total_(total) {
  run_.name = std::move(name);
  run_.metrics["settings"] = std::move(settings);
  run_.frames.columns = frame_columns();
}

void LiveRun::frame_tracked(const FrameEvent& event) {
  unseen_.push_back({event.report, event.input.label});
  const std::size_t row = rows_++;
  {
    const std::lock_guard lock(handing_);
    if (!std::exchange(wanted_, false)) return;
  }
  Handover fresh;
  fresh.map = landmarks_of(event.map, colours_.of(event.map), fresh.colours);
  fresh.trajectory = trajectory_of(event);
  fresh.keyframes = keyframe_poses(event.map);
  fresh.view = encode_frame_view(frame_view(event, row, camera_), event.frame);
  const std::lock_guard lock(handing_);
  fresh.version = handover_.version + 1;
  fresh.frames = std::move(handover_.frames);
  move_to_end(unseen_, fresh.frames);
  handover_ = std::move(fresh);
}

void LiveRun::take_over() {
  Handover taken;
  {
    const std::lock_guard lock(handing_);
    wanted_ = true;
    if (handover_.version == version_) return;
    taken = std::exchange(handover_, {});
    handover_.version = taken.version;
  }
  for (const FrameRecord& frame : taken.frames) run_.frames.add_row(frame_cells(frame));
  run_.map = std::move(taken.map);
  run_.colours = std::move(taken.colours);
  run_.trajectory = std::move(taken.trajectory);
  run_.keyframes = std::move(taken.keyframes);
  view_ = std::move(taken.view);
  version_ = taken.version;
  news_ = nullptr;
}

nlohmann::ordered_json LiveRun::data() {
  const std::size_t count = run_.frames.rows(), tracked = run_.trajectory.size();
  run_.metrics["frames"] = count;
  run_.metrics["tracked"] = tracked;
  run_.metrics["share_tracked"] =
      count == 0 ? 0.0 : static_cast<double>(tracked) / static_cast<double>(count);
  run_.metrics["keyframes"] = run_.keyframes.size();
  run_.metrics["points"] = run_.map.points.size();
  run_.metrics["lines"] = run_.map.lines.size();
  run_.metrics["planes"] = count_alive(run_.map.planes);
  run_.problems.clear();
  nlohmann::ordered_json data = report_data(run_);
  data["kind"] = "live";
  data["version"] = version_;
  data["total"] = total_;
  return data;
}

SharedText LiveRun::page() {
  const std::lock_guard making(making_);
  {
    const std::lock_guard lock(handing_);
    if (report_ != nullptr) return report_;
  }
  take_over();
  std::vector<std::string> views;
  if (!view_.empty()) views.push_back(view_);
  return std::make_shared<const std::string>(report_html(data(), views));
}

SharedText LiveRun::news(std::uint64_t version) {
  const std::lock_guard making(making_);
  {
    const std::lock_guard lock(handing_);
    if (report_ != nullptr) return std::make_shared<const std::string>("{\"over\":true}");
  }
  take_over();
  if (version == version_) return nullptr;
  if (news_ == nullptr) {
    const nlohmann::ordered_json fresh = {{"over", false}, {"data", data()}, {"view", base64(view_)}};
    news_ = std::make_shared<const std::string>(json_text(fresh));
  }
  return news_;
}

void LiveRun::finish(std::string report) {
  const std::lock_guard lock(handing_);
  report_ = std::make_shared<const std::string>(std::move(report));
}

}  // namespace sslam::cli
