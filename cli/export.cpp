// SPDX-License-Identifier: BSD-3-Clause
// `sslam export RUN`: a run's trajectory or map in the form that another program reads.
#include <CLI/CLI.hpp>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "cli/commands.hpp"
#include "cli/results/dense_walls.hpp"
#include "cli/results/depth_export.hpp"
#include "cli/results/export_warnings.hpp"
#include "cli/results/floor_plan.hpp"
#include "cli/results/folder_lock.hpp"
#include "cli/results/keyframe_images.hpp"
#include "cli/results/map_glb.hpp"
#include "cli/results/map_ply.hpp"
#include "cli/results/mcap_export.hpp"
#include "cli/results/nerfstudio.hpp"
#include "cli/results/result_set.hpp"
#include "cli/results/run_folder.hpp"
#include "cli/results/scale_record.hpp"
#include "cli/results/straight_images.hpp"
#include "cli/shell/exit_code.hpp"
#include "cli/shell/messages.hpp"
#include "sslam/io/maps/colmap_writer.hpp"
#include "sslam/io/trajectories/kitti.hpp"

namespace sslam::cli {
namespace {

namespace fs = std::filesystem;

struct ExportSettings {
  std::string run;
  std::string format;
  std::string out;      // empty: a folder of the format's name in the run's
  bool images = false;  // write the keyframes' images too, without the bend of the lens
};

// What is wrong with `file`, where anything is; else why it is not there.
[[noreturn]] void refuse(
    const ExportSettings& settings, const RunFolder& run, const std::string& file,
    const std::string& why = ": the run tracked no frame, so there is nothing to export") {
  for (const std::string& problem : run.problems)
    if (problem.find(file) != std::string::npos) throw Error(problem);
  throw Error(settings.run + why);
}

std::string export_trajectory(const ExportSettings& settings, const RunFolder& run, const fs::path& out) {
  const std::string unit = is_metric(run.metrics) ? "unit: metres" : "";
  const std::string poses = std::to_string(run.trajectory.size()) + " poses";
  if (settings.format == "tum") {
    io::write_trajectory(out / "trajectory.txt", run.trajectory, unit);
    return "trajectory.txt (" + poses + ")";
  }
  io::write_kitti_poses(out / "poses.txt", run.trajectory);
  io::write_stamps(out / "times.txt", io::stamps_of(run.trajectory));
  return "poses.txt (" + poses + "), times.txt";
}

bool is_lens_straight(const RunFolder& run) {
  const auto settings = run.metrics.find("settings");
  if (settings == run.metrics.end() || !settings->is_object() || !settings->contains("distortion"))
    return true;
  for (const auto& coefficient : (*settings)["distortion"])
    if (coefficient != 0) return false;
  return true;
}

// Two numbers of the run's settings, such as the size of its images; zeros where they are not there.
std::array<int, 2> size_in(const RunFolder& run, const char* name) {
  try {
    return run.metrics.at("settings").at(name).get<std::array<int, 2>>();
  } catch (const nlohmann::json::exception&) {
    return {};
  }
}

std::vector<io::Colour> point_colours(const RunFolder& run) {
  std::vector<io::Colour> colours;
  for (const LandmarkColour& colour : run.colours.points) colours.push_back(colour.value_or(io::kNoColour));
  return colours;
}

// Whether files of the format name the keyframes' images.
bool names_images(const std::string& format) {
  return format == "colmap" || format == "depth" || format == "nerfstudio";
}

// ", 17 images" where they were asked for.
std::string export_images(const ExportSettings& settings, const RunFolder& run, const fs::path& stage) {
  if (!settings.images) return {};
  const std::size_t count = write_straight_images(run, keyframe_images(run), stage / kStraightFolder);
  return ", " + std::to_string(count) + " undistorted images";
}

std::string export_colmap(const ExportSettings& settings, const RunFolder& run, const fs::path& out) {
  const KeyframeImages images = keyframe_images(run);
  const std::vector<io::Colour> colours = point_colours(run);
  const io::ColmapCounts counts = io::write_colmap_model(
      out, run.map, {images.names, size_in(run, "working_size"), size_in(run, "image_size"), colours});
  print_warnings(images.warnings);
  if (!is_lens_straight(run) && !settings.images)
    print_note(
        "the model's features and camera are free of lens distortion: give COLMAP undistorted images, "
        "which --images writes");
  return "cameras, images (" + std::to_string(counts.images) + " keyframes, " +
         std::to_string(counts.observations) + " observations), points3D (" + std::to_string(counts.points) +
         " points), each as .txt and .bin" + export_images(settings, run, out);
}

std::string export_nerfstudio(const ExportSettings& settings, const RunFolder& run, const fs::path& stage,
                              const fs::path& out) {
  const NerfstudioCounts counts = write_nerfstudio(run, stage, out, settings.images);
  warn_of_strangers(counts.strangers);
  if (counts.missing > 0)
    print_note("put " + std::to_string(counts.missing) + " images into " + (out / kStraightFolder).string() +
               ", with the names in transforms.json, or let --images write them: the run's dataset is a "
               "video or a bag, or no longer exists");
  return "transforms.json (" + std::to_string(counts.images) + " keyframes), points.ply (" +
         std::to_string(counts.points) + " points)" + export_images(settings, run, stage);
}

std::string export_depth(const ExportSettings& settings, const RunFolder& run, const fs::path& stage,
                         const fs::path& out) {
  const DepthCounts counts = write_depth_export(run, stage, out, settings.images);
  warn_of_strangers(counts.strangers);
  if (counts.too_far > 0)
    print_warning(std::to_string(counts.too_far) + " of " + std::to_string(counts.pixels) +
                  " pixels are farther than the 13.1 " + (is_metric(run.metrics) ? "m" : "units of the map") +
                  " that 16 bits hold: no depth there");
  if (counts.missing > 0)
    print_note(
        std::to_string(counts.missing) +
        " images are in no row of rgb.txt: the run's dataset is a video or a bag, of which --images writes "
        "them, or no longer there");
  return counts.text() + export_images(settings, run, stage);
}

// The model of --dense as it is, else the sparse map.
std::string export_glb(const ExportSettings& settings, const RunFolder& run, const fs::path& stage) {
  const fs::path model = fs::path(settings.run) / kModelFile;
  if (fs::exists(model)) {
    fs::copy_file(model, stage / kModelFile);
    return std::string(kModelFile) + " (of --dense)";
  }
  const GlbCounts counts = write_map_glb(stage / kModelFile, run.map, run.colours);
  return std::string(kModelFile) + " (" + std::to_string(counts.points) + " points, " +
         std::to_string(counts.lines) + " lines, " + std::to_string(counts.planes) + " planes)";
}

std::string export_floor_plan(const ExportSettings& settings, const RunFolder& run, const fs::path& stage) {
  constexpr double kUpright = 0.7;  // length of the mean of unit vectors
  if (mean_down(run.map).norm() < kUpright)
    print_note("the camera was turned about its line of sight: the plan may not be seen from above");
  FloorPlan plan = make_floor_plan(run.map, run.trajectory);
  if (auto walls = dense_walls(settings.run, run, plan_from_world(run.map)); !walls.empty())
    plan.walls = std::move(walls);
  if (plan.walls.empty())
    print_note(
        "the map has no vertical planes: the plan shows its lines and points without walls; a run with "
        "--dense finds more");
  write_floor_plan(stage / "floorplan.svg", plan, run.name, is_metric(run.metrics) ? "m" : "map units");
  return "floorplan.svg (" + std::to_string(plan.walls.size()) + " walls, " +
         std::to_string(plan.lines.size() + plan.uprights.size()) + " lines)";
}

std::string export_map(const ExportSettings& settings, const RunFolder& run, const fs::path& stage,
                       const fs::path& out) {
  if (names_images(settings.format) && !settings.images) warn_of_wide_lens(run);
  if (settings.format == "colmap") return export_colmap(settings, run, stage);
  if (settings.format == "depth") return export_depth(settings, run, stage, out);
  if (settings.format == "nerfstudio") return export_nerfstudio(settings, run, stage, out);
  if (settings.format == "glb") return export_glb(settings, run, stage);
  if (settings.format == "floorplan") return export_floor_plan(settings, run, stage);
  if (settings.format == "mcap") {
    const McapCounts counts = write_mcap_export(stage / "run.mcap", run);
    return "run.mcap (" + std::to_string(counts.poses) + " poses, " + std::to_string(counts.points) +
           " points, " + std::to_string(counts.lines) + " lines, " + std::to_string(counts.pictures) +
           " pictures)";
  }
  write_map_ply(stage / "map.ply", run.map, run.colours, is_metric(run.metrics) ? "unit: metres" : "");
  return "map.ply";
}

void run_export(const ExportSettings& settings) {
  if (settings.images && !names_images(settings.format))
    throw UsageError("--images: needs --format colmap, depth or nerfstudio, found " + settings.format);
  const RunFolder run = read_run_folder(settings.run);
  const fs::path out =
      settings.out.empty() ? fs::path(settings.run) / settings.format : fs::path(settings.out);
  const bool map = settings.format != "tum" && settings.format != "kitti";
  if (map ? run.map.empty() : run.trajectory.empty())
    refuse(settings, run, map ? "map.sslam" : "trajectory.txt");
  if (settings.format == "mcap" && run.trajectory.empty()) refuse(settings, run, "trajectory.txt");
  if (settings.format == "depth") {
    if (run.surfaces.empty())
      refuse(settings, run, kModelFile, ": has no model to take depth from: run again with --dense");
    claim_depth_folder(out);
  }
  print_warnings(run.problems);
  io::prepare_output_folder(out);
  const FolderLock lock = FolderLock::demand(out);
  ResultSet results(out);
  const std::string files = map ? export_map(settings, run, results.stage(), out)
                                : export_trajectory(settings, run, results.stage());
  results.commit();
  std::printf("written to       %s: %s; unit: %s\n", out.c_str(), files.c_str(),
              is_metric(run.metrics) ? "metres" : "the map's own");
}

}  // namespace

void add_export_command(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("export", "Convert a run's trajectory or map to files for other programs");
  auto s = std::make_shared<ExportSettings>();
  command->add_option("run", s->run, "Folder that `sslam run --out` has written to")->required();
  command
      ->add_option("--format", s->format,
                   "tum, kitti: the trajectory; ply: points and lines; colmap: a model of the keyframes "
                   "with their points; nerfstudio: transforms.json and points; depth: depth and normals of "
                   "the keyframes by the model of --dense; glb: a 3D model for viewers; "
                   "floorplan: walls and the path from above; mcap: all of it as a recording of ROS 2, "
                   "for Foxglove and RViz")
      ->required()
      ->check(CLI::IsMember(
          {"colmap", "depth", "floorplan", "glb", "kitti", "mcap", "nerfstudio", "ply", "tum"}));
  command->add_option("-o,--out", s->out, "Folder for the files; default RUN/FORMAT")->type_name("DIR");
  command->add_flag(
      "--images", s->images,
      "With colmap, depth and nerfstudio: also write the keyframes' images, undistorted, into images");
  command->callback([s] { run_export(*s); });
}

}  // namespace sslam::cli
