// SPDX-License-Identifier: BSD-3-Clause
// `sslam export RUN`: a run's trajectory or map in the form that another program reads.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>

#include "cli/commands.hpp"
#include "cli/results/folder_lock.hpp"
#include "cli/results/keyframe_images.hpp"
#include "cli/results/map_ply.hpp"
#include "cli/results/result_set.hpp"
#include "cli/results/run_folder.hpp"
#include "cli/shell/messages.hpp"
#include "sslam/io/maps/colmap_writer.hpp"
#include "sslam/io/trajectories/kitti.hpp"

namespace sslam::cli {
namespace {

namespace fs = std::filesystem;

struct ExportSettings {
  std::string run;
  std::string format;
  std::string out;  // empty: a folder of the format's name in the run's
};

// What is wrong with `file`, where anything is; else that the run has tracked nothing.
[[noreturn]] void refuse(const ExportSettings& settings, const RunFolder& run, const std::string& file) {
  for (const std::string& problem : run.problems)
    if (problem.find(file) != std::string::npos) throw Error(problem);
  throw Error(settings.run + ": the run tracked no frame, so there is nothing to export");
}

std::string export_trajectory(const ExportSettings& settings, const RunFolder& run, const fs::path& out) {
  const std::string poses = std::to_string(run.trajectory.size()) + " poses";
  if (settings.format == "tum") {
    io::write_trajectory(out / "trajectory.txt", run.trajectory);
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

std::string export_colmap(const RunFolder& run, const fs::path& out) {
  const KeyframeImages images = keyframe_images(run);
  const io::ColmapCounts counts = io::write_colmap_model(out, run.map, images.names);
  print_warnings(images.warnings);
  if (!is_lens_straight(run))
    print_note("the model's features and camera are free of lens distortion: give COLMAP undistorted images");
  return "cameras.txt, images.txt (" + std::to_string(counts.images) + " keyframes, " +
         std::to_string(counts.observations) + " observations), points3D.txt (" +
         std::to_string(counts.points) + " points)";
}

std::string export_map(const ExportSettings& settings, const RunFolder& run, const fs::path& out) {
  if (settings.format == "colmap") return export_colmap(run, out);
  write_map_ply(out / "map.ply", run.map);
  return "map.ply";
}

void run_export(const ExportSettings& settings) {
  const RunFolder run = read_run_folder(settings.run);
  const fs::path out =
      settings.out.empty() ? fs::path(settings.run) / settings.format : fs::path(settings.out);
  const bool map = settings.format == "colmap" || settings.format == "ply";
  if (map ? run.map.empty() : run.trajectory.empty())
    refuse(settings, run, map ? "map.sslam" : "trajectory.txt");
  print_warnings(run.problems);
  io::prepare_output_folder(out);
  const FolderLock lock = FolderLock::demand(out);
  ResultSet results(out);
  const std::string files =
      map ? export_map(settings, run, results.stage()) : export_trajectory(settings, run, results.stage());
  results.commit();
  std::printf("written to       %s: %s\n", out.c_str(), files.c_str());
}

}  // namespace

void add_export_command(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("export", "Write a run's trajectory or map in the form that another program reads");
  auto s = std::make_shared<ExportSettings>();
  command->add_option("run", s->run, "Folder that `sslam run --out` has written to")->required();
  command
      ->add_option("--format", s->format,
                   "tum, kitti: the trajectory; ply: points and lines; colmap: a text model of the keyframes "
                   "with their points")
      ->required()
      ->check(CLI::IsMember({"colmap", "kitti", "ply", "tum"}));
  command->add_option("--out", s->out, "Folder for the files; default one of the format's name in the run's")
      ->type_name("DIR");
  command->callback([s] { run_export(*s); });
}

}  // namespace sslam::cli
