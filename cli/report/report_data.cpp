// SPDX-License-Identifier: BSD-3-Clause
#include "cli/report/report_data.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string_view>

#include "cli/report/frame_rows.hpp"
#include "cli/report/map_data.hpp"
#include "cli/report/packed.hpp"
#include "cli/report/surface_data.hpp"
#include "cli/report/truth_data.hpp"
#include "cli/results/scale_record.hpp"
#include "cli/video/overlay_colours.hpp"
#include "sslam/io/evaluation/evaluation.hpp"
#include "sslam/io/plots/comparison_view.hpp"
#include "sslam/map/vertical.hpp"
#include "sslam/version.hpp"

namespace sslam::cli {
namespace {

using Json = nlohmann::ordered_json;

void append_pose(std::vector<double>& values, const SE3<double>& pose) {
  append(values, pose.translation);
  const auto q = pose.rotation.quaternion();
  values.insert(values.end(), {q.x(), q.y(), q.z(), q.w()});
}

Json poses_json(const io::Trajectory& poses) {
  std::vector<double> values;
  for (const io::StampedPose& pose : poses) append_pose(values, pose.world_from_cam);
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
  explicit DataMaker(RunFolder& run) : run_(run), rows_(run.frames) {}

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
    add_map_data(run_, data_);
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
  void add_poses() {
    constexpr std::size_t kSize = 7;
    std::vector<double> poses = rows_.empty(kSize);
    std::size_t strangers = 0;
    for (const io::StampedPose& pose : run_.trajectory) {
      const auto row = rows_.row_of(pose.stamp);
      if (!row) ++strangers;
      if (!row) continue;
      std::vector<double> values;
      append_pose(values, pose.world_from_cam);
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
      const auto row = rows_.row_of(pose.stamp);
      rows.push_back(row ? static_cast<double>(*row) : -1);
    }
    data_["keyframes"] = poses_json(run_.keyframes);
    data_["keyframe_rows"] = packed<std::int32_t>("i32", rows);
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
    data_["truth"] = truth_data(io::aligned(run_.truth, truth_from_map.inverse()));
    const io::PairedPoses paired = io::pair_poses(run_.truth, run_.trajectory, alignment->max_difference);
    const std::vector<double> distances = io::position_errors(paired, truth_from_map);
    const std::vector<double> angles = io::rotation_errors(paired, io::rotation_offset(paired));
    data_["errors"] = error_data(rows_, paired.estimate, distances, angles);
    data_["metres_per_unit"] = truth_from_map.scale;
  }

  RunFolder& run_;
  FrameRows rows_;
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
