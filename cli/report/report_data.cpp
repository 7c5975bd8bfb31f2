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

#include "cli/report/base64.hpp"
#include "cli/video/overlay_colours.hpp"
#include "sslam/io/evaluation/evaluation.hpp"
#include "sslam/io/maps/byte_archive.hpp"
#include "sslam/io/plots/comparison_view.hpp"
#include "sslam/map/plane_extent.hpp"
#include "sslam/version.hpp"

namespace sslam::cli {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kNone64 = std::numeric_limits<double>::quiet_NaN();

template <class Target>
Json packed(const char* type, std::span<const double> values) {
  io::ByteWriter out;
  for (const double value : values) out(static_cast<Target>(value));
  Json array;
  array["type"] = type;
  array["base64"] = base64(out.bytes);
  return array;
}

Json floats(std::span<const double> values) {
  return packed<float>("f32", values);
}

void append(std::vector<double>& values, const Vec3<double>& v) {
  values.insert(values.end(), {v.x(), v.y(), v.z()});
}

void append(std::vector<double>& values, const SE3<double>& pose) {
  append(values, pose.translation);
  const auto q = pose.rotation.quaternion();
  values.insert(values.end(), {q.x(), q.y(), q.z(), q.w()});
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
    data_["keyframes"] = poses_json(run_.keyframes);
    add_map();
    try {
      add_truth();
    } catch (const std::exception& error) {
      run_.problems.push_back(std::string("ground truth and trajectory do not fit together: ") +
                              error.what());
    }
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

  void add_map() {
    std::vector<double> points, lines, axes;
    for (const auto& point : run_.map.points)
      if (point.alive) append(points, point.position);
    for (const auto& line : run_.map.lines) {
      if (!line.alive || !line.start.allFinite() || !line.end.allFinite()) continue;
      append(lines, line.start);
      append(lines, line.end);
      axes.push_back(axis_in_frame(line.axis));
    }
    data_["points"] = floats(points);
    add_planes();
    data_["lines"] = {{"ends", floats(lines)}, {"axes", packed<std::int8_t>("i8", axes)}};
  }

  // Each as the rectangle that its members cover.
  void add_planes() {
    std::vector<PlaneExtent<double>> extents;
    gather_extents(run_.map, extents);
    std::vector<double> corners, axes;
    for (std::size_t p = 0; p < extents.size(); ++p) {
      const PlaneLandmark<double>& plane = run_.map.planes[p];
      if (!plane.alive || extents[p].places == 0) continue;
      for (const Vec3<double>& corner : extents[p].corners(plane.plane)) append(corners, corner);
      axes.push_back(axis_in_frame(plane.axis));
    }
    data_["planes"] = {{"corners", floats(corners)}, {"axes", packed<std::int8_t>("i8", axes)}};
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
  Json data_;
};

}  // namespace

nlohmann::ordered_json report_data(RunFolder& run) {
  return DataMaker(run).make();
}

std::vector<std::string_view> choose_views(const std::vector<std::string>& views) {
  constexpr std::size_t kBudget = 10'600'000;  // bytes: 14.1 MB as text
  for (std::size_t count = views.size();;) {
    std::vector<std::string_view> chosen;
    std::size_t size = 0;
    for (std::size_t i = 0; i < count; ++i) {
      chosen.push_back(views[i * views.size() / count]);
      size += chosen.back().size();
    }
    if (size <= kBudget || count <= 1) return chosen;
    count = std::min(count - 1, count * kBudget / size);
  }
}

}  // namespace sslam::cli
