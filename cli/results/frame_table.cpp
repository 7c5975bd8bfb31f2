// SPDX-License-Identifier: BSD-3-Clause
#include "cli/results/frame_table.hpp"

#include <cmath>

#include "sslam/io/files/csv_writer.hpp"

namespace sslam::cli {
namespace {

template <class... Cells>
std::vector<std::string> texts_of(const Cells&... cells) {
  return {io::csv_cell(cells)...};
}

}  // namespace

std::vector<std::string> frame_columns() {
  std::vector<std::string> columns{
      "index",     "stamp",       "image",         "state",         "reason",       "points",
      "lines",     "normals",     "normals_asked", "point_inliers", "line_inliers", "axes_seen",
      "structure", "image_fixed", "keyframe",      "loop_closed",   "world",        "maps_joined",
      "bridged",   "points_ms",   "lines_ms",      "normals_ms",    "extraction_ms"};
  for (int s = 0; s < kStageCount; ++s) columns.push_back(std::string(name(static_cast<Stage>(s))) + "_ms");
  columns.insert(columns.end(), {"tracking_ms", "frame_ms"});
  return columns;
}

std::vector<std::string> frame_cells(const FrameRecord& frame) {
  const FrameRecord& r = frame;
  const auto ms = [](double value) { return std::round(value * 1e3) / 1e3; };
  auto cells =
      texts_of(r.index, r.stamp, frame.image, name(r.state), name(r.reason), frame.points, frame.lines,
               frame.normals, name(frame.normal_need), r.point_inliers, r.line_inliers, r.axes_seen,
               r.structure, r.image_fixed, r.keyframe, r.loop_closed, r.world, r.maps_joined, r.bridged,
               ms(frame.points_ms), ms(frame.lines_ms), ms(frame.normals_ms), ms(frame.extraction_ms));
  for (const double stage : frame.stage_ms) cells.push_back(io::csv_cell(ms(stage)));
  cells.push_back(io::csv_cell(ms(frame.tracking_ms)));
  cells.push_back(io::csv_cell(ms(frame.frame_ms())));
  return cells;
}

}  // namespace sslam::cli
