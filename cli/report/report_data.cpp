// SPDX-License-Identifier: BSD-3-Clause
#include "cli/report/report_data.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <string_view>

#include "cli/report/packed.hpp"
#include "cli/report/seen_part.hpp"
#include "cli/report/surface_data.hpp"
#include "cli/results/scale_record.hpp"
#include "cli/video/overlay_colours.hpp"
#include "sslam/io/evaluation/evaluation.hpp"
#include "sslam/io/plots/comparison_view.hpp"
#include "sslam/map/plane_extent.hpp"
#include "sslam/map/vertical.hpp"
#include "sslam/version.hpp"

namespace sslam::cli {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kNone64 = std::numeric_limits<double>::quiet_NaN();

void append(std::vector<double>& values, const Vec3<double>& v) {
  values.insert(values.end(), {v.x(), v.y(), v.z()});
}

void append(std::vector<double>& values, const SE3<double>& pose) {
  append(values, pose.translation);
  const auto q = pose.rotation.quaternion();
  values.insert(values.end(), {q.x(), q.y(), q.z(), q.w()});
}

Json colours_json(const std::vector<LandmarkColour>& colours) {
  std::vector<double> values;
  for (const LandmarkColour& colour : colours)
    for (const std::uint8_t channel : colour.value_or(io::kNoColour)) values.push_back(channel);
  return packed<std::uint8_t>("u8", values);
}

Json poses_json(const io::Trajectory& poses) {
  std::vector<double> values;
  for (const io::StampedPose& pose : poses) append(values, pose.world_from_cam);
  return floats(values);
}

// Numbers where every cell is one, else text as codes into a list of names.
Json column_json(const io::CsvTable& table, std::size_t column) {
  std::vector<double> numbers;
  for (std::size_t row = 0; row < table.rows(); ++row)
    if (const auto number = io::parse_number<double>(table.cell(row, column))) numbers.push_back(*number);
  if (numbers.size() == table.rows())
    return table.columns[column] == "stamp" ? packed<double>("f64", numbers) : floats(numbers);
  std::map<std::string_view, std::size_t> known;
  Json names = Json::array();
  std::vector<double> codes;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const auto [at, fresh] = known.emplace(table.cell(row, column), known.size());
    if (fresh) names.push_back(at->first);
    codes.push_back(static_cast<double>(at->second));
  }
  return {{"names", names}, {"codes", packed<std::uint32_t>("u32", codes)}};
}

Json overlay_json() {
  Json axes = Json::array();
  for (const OverlayColour& colour : kAxisOverlay) axes.push_back(css_colour(colour));
  return {{"axes", axes}, {"mapped", css_colour(kMappedPoint)}, {"other", css_colour(kOtherPoint)}};
}

struct FoundAlignment {
  Sim3<double> truth_from_estimate;
  double max_difference = io::kMaxStampDifference;
};

std::optional<FoundAlignment> find_alignment(const Json& metrics) {
  if (!metrics.contains("trajectory")) return std::nullopt;
  const Json& figures = metrics["trajectory"];
  const Json& found = figures.at("alignment");
  const auto q = found.at("rotation_xyzw").get<std::array<double, 4>>();
  const auto t = found.at("translation_m").get<std::array<double, 3>>();
  FoundAlignment alignment;
  alignment.truth_from_estimate = {SO3<double>::from_quaternion(q[3], q[0], q[1], q[2]),
                                   Vec3<double>(t[0], t[1], t[2]), found.at("scale").get<double>()};
  alignment.max_difference = figures.at("max_difference").get<double>();
  return alignment;
}

class DataMaker {
 public:
  explicit DataMaker(RunFolder& run) : run_(run) {
    const io::CsvTable& frames = run.frames;
    const std::size_t stamp = frames.column("stamp");
    if (stamp == frames.columns.size()) return;
    for (std::size_t row = 0; row < frames.rows(); ++row)
      if (const auto value = io::parse_number<double>(frames.cell(row, stamp))) row_of_[*value] = row;
  }

  [[nodiscard]] Json make() {
    data_["metrics"] = run_.metrics;
    Json columns = Json::object();
    for (std::size_t c = 0; c < run_.frames.columns.size(); ++c)
      columns[run_.frames.columns[c]] = column_json(run_.frames, c);
    data_["frames"]["count"] = run_.frames.rows();
    data_["frames"]["columns"] = std::move(columns);
    add_poses();
    data_["overlay"] = overlay_json();
    const Vec3<double> up = up_direction(run_.map);
    data_["up"] = {up.x(), up.y(), up.z()};
    add_keyframes();
    add_map();
    add_surfaces();
    try {
      add_truth();
    } catch (const std::exception& error) {
      run_.problems.push_back(std::string("ground truth and trajectory do not fit together: ") +
                              error.what());
    }
    if (!data_.contains("metres_per_unit") && is_metric(run_.metrics)) data_["metres_per_unit"] = 1;
    data_["problems"] = run_.problems;
    data_["program"] = std::string("sslam ") + SSLAM_VERSION;
    data_["folder"] = run_.name;
    return std::move(data_);
  }

 private:
  // Of the frame with exactly this stamp: both files have it to the last bit.
  [[nodiscard]] std::optional<std::size_t> row_of(double stamp) const {
    const auto at = row_of_.find(stamp);
    return at == row_of_.end() ? std::nullopt : std::optional(at->second);
  }

  void add_poses() {
    constexpr std::size_t kSize = 7;
    std::vector<double> poses(run_.frames.rows() * kSize, kNone64);
    std::size_t strangers = 0;
    for (const io::StampedPose& pose : run_.trajectory) {
      const auto row = row_of(pose.stamp);
      if (!row) ++strangers;
      if (!row) continue;
      std::vector<double> values;
      append(values, pose.world_from_cam);
      std::copy(values.begin(), values.end(), poses.begin() + static_cast<std::ptrdiff_t>(*row * kSize));
    }
    if (strangers > 0)
      run_.problems.push_back("trajectory.txt: " + std::to_string(strangers) +
                              " poses belong to no frame in frames.csv: left out");
    data_["poses"] = floats(poses);
  }

  // Their poses, and the rows of the frames that they are; -1 where there is none.
  void add_keyframes() {
    std::vector<double> rows;
    for (const io::StampedPose& pose : run_.keyframes) {
      const auto row = row_of(pose.stamp);
      rows.push_back(row ? static_cast<double>(*row) : -1);
    }
    data_["keyframes"] = poses_json(run_.keyframes);
    data_["keyframe_rows"] = packed<std::int32_t>("i32", rows);
  }

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

  void add_map() {
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

  // Those of `--dense`, in place of the rectangles.
  void add_surfaces() {
    if (run_.surfaces.empty()) return;
    std::string problem;
    data_["surfaces"] = surface_data(run_.surfaces, kSurfaceRoom, problem);
    if (!problem.empty()) run_.problems.push_back(std::string(kModelFile) + ": " + problem);
  }

  // The ground truth in the map's world, and the error of each frame.
  void add_truth() {
    if (run_.truth.empty() || run_.trajectory.empty()) return;
    const auto alignment = find_alignment(run_.metrics);
    if (!alignment) return;
    const Sim3<double>& truth_from_map = alignment->truth_from_estimate;
    std::vector<double> path, stamps;
    for (const io::StampedPose& pose : io::aligned(run_.truth, truth_from_map.inverse())) {
      append(path, pose.world_from_cam.translation);
      stamps.push_back(pose.stamp);
    }
    data_["truth"] = {{"positions", floats(path)}, {"stamps", packed<double>("f64", stamps)}};
    const io::PairedPoses paired = io::pair_poses(run_.truth, run_.trajectory, alignment->max_difference);
    const std::vector<double> distances = io::position_errors(paired, truth_from_map);
    const std::vector<double> angles = io::rotation_errors(paired, io::rotation_offset(paired));
    std::vector<double> position(run_.frames.rows(), kNone64), rotation = position;
    for (std::size_t i = 0; i < paired.estimate.size(); ++i) {
      const auto row = row_of(paired.estimate[i].stamp);
      if (!row) continue;
      position[*row] = distances[i];
      rotation[*row] = degrees(angles[i]);
    }
    data_["errors"] = {{"position_m", floats(position)}, {"rotation_deg", floats(rotation)}};
    data_["metres_per_unit"] = truth_from_map.scale;
  }

  RunFolder& run_;
  std::map<double, std::size_t> row_of_;
  std::vector<std::optional<std::size_t>> places_;  // of the map's keyframes in the list of the run's
  std::vector<double> shown_planes_;                // place of each plane among those that are shown, or -1
  Json data_;
};

}  // namespace

nlohmann::ordered_json report_data(RunFolder& run) {
  return DataMaker(run).make();
}

std::vector<std::string_view> choose_views(const std::vector<std::string>& views, std::size_t taken) {
  constexpr std::size_t kPage = 15'000'000, kLeast = 2'000'000;
  const std::size_t room = std::max(kLeast, kPage - std::min(kPage, taken)) / 4 * 3;  // base64
  for (std::size_t count = views.size();;) {
    std::vector<std::string_view> chosen;
    std::size_t size = 0;
    for (std::size_t i = 0; i < count; ++i) {
      chosen.push_back(views[i * views.size() / count]);
      size += chosen.back().size();
    }
    if (size <= room || count <= 1) return chosen;
    count = std::min(count - 1, count * room / size);
  }
}

}  // namespace sslam::cli
