// SPDX-License-Identifier: BSD-3-Clause
#include "cli/report/map_data.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "cli/report/packed.hpp"
#include "cli/report/seen_part.hpp"
#include "sslam/map/plane_extent.hpp"

namespace sslam::cli {
namespace {

using Json = nlohmann::ordered_json;

Json colours_json(const std::vector<LandmarkColour>& colours) {
  std::vector<double> values;
  for (const LandmarkColour& colour : colours)
    for (const std::uint8_t channel : colour.value_or(io::kNoColour)) values.push_back(channel);
  return packed<std::uint8_t>("u8", values);
}

// Landmarks that are shown: by how many keyframes each is seen, which of this run's they are, one after the
// other, and on which of the shown planes it lies.
struct Witnesses {
  std::vector<double> counts, keyframes, listed, planes;

  [[nodiscard]] Json json() const {
    return {{"counts", packed<std::uint16_t>("u16", counts)},
            {"listed", packed<std::uint16_t>("u16", listed)},
            {"keyframes", packed<std::uint16_t>("u16", keyframes)},
            {"planes", packed<std::int32_t>("i32", planes)}};
  }
};

class MapDataMaker {
 public:
  MapDataMaker(const RunFolder& run, Json& data) : run_(run), data_(data) {}

  void add() {
    const Map<double>& map = run_.map;
    places_ = places_of_keyframes();
    add_planes();
    std::vector<double> points, lines, axes;
    std::vector<LandmarkColour> point_colours, line_colours;
    Witnesses of_points, of_lines;
    for (std::size_t i = 0; i < map.points.size(); ++i) {
      if (!map.points[i].alive) continue;
      append(points, map.points[i].position);
      point_colours.push_back(colour_at(run_.colours.points, i));
      add_witnesses(map.points[i], of_points);
    }
    for (std::size_t i = 0; i < map.lines.size(); ++i) {
      const auto& line = map.lines[i];
      if (!line.alive) continue;
      const auto [start, end] = seen_part(map, line);
      if (!start.allFinite() || !end.allFinite()) continue;
      append(lines, start);
      append(lines, end);
      axes.push_back(axis_in_frame(line.axis));
      line_colours.push_back(colour_at(run_.colours.lines, i));
      add_witnesses(line, of_lines);
    }
    data_["points"] = floats(points);
    data_["point_colours"] = colours_json(point_colours);
    data_["point_witnesses"] = of_points.json();
    data_["lines"] = {{"ends", floats(lines)},
                      {"axes", packed<std::int8_t>("i8", axes)},
                      {"colours", colours_json(line_colours)},
                      {"witnesses", of_lines.json()}};
    data_["coloured"] = run_.colours.any();
  }

 private:
  // Where each keyframe of the map stands in the list of this run's keyframes. Those of an earlier run may
  // have the same stamps, but not the same places.
  [[nodiscard]] std::vector<std::optional<std::size_t>> places_of_keyframes() const {
    constexpr double kRounding = 1e-6;  // of a pose in a text file, map units
    std::map<double, std::size_t> place_of_stamp;
    for (std::size_t i = 0; i < run_.keyframes.size(); ++i) place_of_stamp[run_.keyframes[i].stamp] = i;
    std::vector<std::optional<std::size_t>> places;
    for (const auto& keyframe : run_.map.keyframes) {
      const auto found = place_of_stamp.find(keyframe.frame.stamp);
      const bool same = keyframe.alive() && found != place_of_stamp.end() &&
                        (run_.keyframes[found->second].world_from_cam.translation -
                         keyframe.cam_from_world.inverse().translation)
                                .norm() <= kRounding;
      places.push_back(same ? std::optional(found->second) : std::nullopt);
    }
    return places;
  }

  void add_witnesses(const LandmarkCommon& landmark, Witnesses& to) const {
    constexpr std::size_t kMost = 65535;
    std::size_t listed = 0;
    for (const Observation& o : landmark.observations) {
      const auto& place = places_[Map<double>::index(o.keyframe)];
      if (!place || *place > kMost || listed == kMost) continue;
      to.keyframes.push_back(static_cast<double>(*place));
      ++listed;
    }
    to.counts.push_back(static_cast<double>(std::min(landmark.observations.size(), kMost)));
    to.listed.push_back(static_cast<double>(listed));
    to.planes.push_back(landmark.plane == kNone ? -1 : shown_planes_[Map<double>::index(landmark.plane)]);
  }

  // Each as the rectangle that its members cover.
  void add_planes() {
    std::vector<PlaneExtent<double>> extents;
    gather_extents(run_.map, extents);
    std::vector<double> corners, axes;
    shown_planes_.assign(extents.size(), -1);
    for (std::size_t p = 0; p < extents.size(); ++p) {
      const PlaneLandmark<double>& plane = run_.map.planes[p];
      if (!plane.alive || extents[p].places == 0) continue;
      shown_planes_[p] = static_cast<double>(axes.size());
      for (const Vec3<double>& corner : extents[p].corners(plane.plane)) append(corners, corner);
      axes.push_back(axis_in_frame(plane.axis));
    }
    data_["planes"] = {{"corners", floats(corners)}, {"axes", packed<std::int8_t>("i8", axes)}};
  }

  const RunFolder& run_;
  Json& data_;
  std::vector<std::optional<std::size_t>> places_;  // of the map's keyframes in the list of the run's
  std::vector<double> shown_planes_;                // place of each plane among those that are shown, or -1
};

}  // namespace

void add_map_data(const RunFolder& run, nlohmann::ordered_json& data) {
  MapDataMaker(run, data).add();
}

}  // namespace sslam::cli
