// SPDX-License-Identifier: BSD-3-Clause
// `sslam run DATASET`: its options.
#include "cli/run.hpp"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "cli/commands.hpp"
#include "cli/foxglove/endpoint_option.hpp"
#include "cli/input/camera_options.hpp"
#include "cli/input/topic_options.hpp"
#include "cli/results/result_set.hpp"
#include "cli/run/checkpoint.hpp"
#include "cli/run/command_words.hpp"
#include "cli/run/run_check.hpp"
#include "cli/shell/choice_option.hpp"
#include "cli/shell/config_file.hpp"
#include "cli/shell/exit_code.hpp"
#include "cli/shell/help_formatter.hpp"
#include "cli/shell/number_checks.hpp"
#include "cli/shell/option_info.hpp"
#include "cli/shell/progress_options.hpp"
#include "cli/stream/stream_name.hpp"
#include "cli/view/view_options.hpp"

namespace sslam::cli {
namespace {

void add_input_options(CLI::App& command, RunSettings& s) {
  command
      .add_option(
          "dataset", s.dataset,
          "Folder (TUM RGB-D, EuRoC, ICL-NUIM, 7-Scenes, ScanNet, KITTI, nerfstudio, ..., plain images), a "
          "quoted glob of images, a video, a bag of ROS 1 or 2 (bag, mcap, db3), " +
              std::string(kStreamKinds))
      ->required();
  add_topic_option(command, s.topics);
  add_depth_topic_option(command, s.topics);
  add_camera_options(command, s.camera, s.focal, s.fov);
  add_undistort_option(command, s.undistort_fov);
  static const std::map<std::string, CalibrationMode> kCalibrations{{"fixed", CalibrationMode::kFixed},
                                                                    {"refine", CalibrationMode::kRefine},
                                                                    {"find", CalibrationMode::kFind}};
  add_choice(
      command, "--calibration", s.calibration, kCalibrations,
      "fixed: as it is given; refine: where the images contradict it, track them again with the camera "
      "that was found; find: it is a guess, so find the camera first, as is done without a calibration; "
      "default refine");
  command.add_option("--start", s.slice.start, "First frame")
      ->capture_default_str()
      ->check(CLI::NonNegativeNumber);
  command.add_option("--end", s.slice.end, "Frame to stop before; negative: the last")->capture_default_str();
  command.add_option("--stride", s.slice.stride, "Take every n-th frame")
      ->capture_default_str()
      ->check(CLI::PositiveNumber);
  command
      .add_option("--fps", s.frame_rate,
                  "Frames a second, for images without stamps, in a folder or through a pipe")
      ->capture_default_str()
      ->check(finite_number())
      ->check(CLI::PositiveNumber);
  command
      .add_option("--longest-side", s.longest_side,
                  "Images with a longer side are shrunk to it, pixels; 0: none is")
      ->capture_default_str()
      ->check(CLI::Range(0, 100000));
  command
      .add_option(
          "--mask", s.mask,
          "Image whose pixels of 0 are left out of all frames (a robot's own parts, burnt-in text), or "
          "a folder with such an image for each frame, NAME.png")
      ->type_name("FILE");
  command
      .add_option("--record", s.record,
                  "Keep the images as a dataset that sslam run takes, in a new folder, as they come")
      ->type_name("DIR");
  command.add_option("--retry", s.retry, "Seconds that a lost camera or stream is tried again for")
      ->capture_default_str()
      ->check(finite_number())
      ->check(CLI::Range(0.0, 86400.0));
  put_in_group(
      command, "Input",
      {"--topic", "--depth-topic", "--camera", "--focal", "--fov", "--undistort-fov", "--calibration",
       "--start", "--end", "--stride", "--fps", "--longest-side", "--mask", "--record", "--retry"});
}

void add_tracking_options(CLI::App& command, RunSettings& s) {
  command.add_option("--normals", s.normals, kNormalsMeaning)->type_name("SOURCE");
  std::string presets = "What the pipeline is made of:";
  std::vector<std::string> names;
  for (const Preset& preset : all_presets()) {
    presets += "\n  " + std::string(preset.name) + ": " + std::string(preset.meaning);
    names.emplace_back(preset.name);
  }
  command.add_option("--preset", s.preset, presets)->capture_default_str()->type_name(words_type(names));
  command.add_option("--set", s.set, "stage.parameter=value, see --list-parameters; may be repeated")
      ->allow_extra_args(false);
  const auto list = [] {
    std::fputs(describe_parameters().c_str(), stdout);
    throw CLI::Success();
  };
  command.add_flag_callback("--list-parameters", list, "Print what --set can change, and stop")
      ->trigger_on_parse();
  command.add_option("--seed", s.seed, "Of everything random")
      ->capture_default_str()
      ->check(number_from_zero());
  command
      .add_option("--map", s.map,
                  "Go on in the map of an earlier run, its map.sslam: poses are in that map's world")
      ->type_name("FILE");
  command.add_flag("--live", s.live,
                   "As with a camera: frames come at the pace of their stamps, mapping and loop closing have "
                   "a thread of their own, tracking never waits for them; no two runs are alike");
  command.add_flag_callback(
      "--no-final-pass", [&s] { s.final_pass = false; },
      "Leave out what follows the last frame: the whole map is adjusted, and every frame tracked again in "
      "it");
  const auto tell_read_out = [&s](double seconds) {
    s.set.push_back("final_pass.read_out=" + std::to_string(seconds));
    s.set.push_back("final_pass.shutter.search=0");
  };
  command
      .add_option_function<double>(
          "--read-out", tell_read_out,
          "From the first row of an image to the last, of a rolling shutter; 0: all rows at once; without "
          "it, the map is asked for it after the last frame")
      ->check(finite_number())
      ->check(CLI::Range(0.0, 0.2))
      ->type_name("SECONDS");
  put_in_group(command, "Tracking",
               {"--normals", "--preset", "--set", "--list-parameters", "--seed", "--map", "--live",
                "--no-final-pass", "--read-out"});
}

void add_output_options(CLI::App& command, RunSettings& s) {
  command.add_option("-o,--out", s.out, "Folder for the results")->capture_default_str()->type_name("DIR");
  command
      .add_option("--scale", s.scale,
                  "Results in metres: depth (by the dataset's depth images), height=METRES (of the camera "
                  "above the floor), known=METRES (between the first and the last frame with a pose) or "
                  "known=METRES@A:B (between the frames A and B); default none: the map's own unit")
      ->type_name("HOW");
  command
      .add_option("--video", s.video,
                  "Overlay video to write, .mp4 or .avi: features, segments by axis, normals, state")
      ->type_name("FILE");
  CLI::Option* const view = command.add_flag(
      "--view", s.view,
      "Show the run in a browser on this machine while it goes on, then its report until Ctrl-C");
  add_port_option(command, s.port)->needs(view);
  add_foxglove_option(command, s.foxglove);
  command.add_flag(
      "--dense", s.dense,
      "Write the walls, floors and other planes with the images on them: model.glb for any viewer, "
      "model.obj, model.ply");
  command.add_flag_callback(
      "--no-report", [&s] { s.report = false; }, "Leave report.html and the pictures for it out");
  command
      .add_option("--checkpoint", s.checkpoint,
                  "Seconds after which the state of the run is kept in --out, for --resume, again and again; "
                  "0: never; default 60, and never with --live, --view, --video, --record, --dense or a "
                  "stream")
      ->check(finite_number())
      ->check(CLI::Range(0.0, 1e6))
      ->type_name("SECONDS");
  put_in_group(command, "Output",
               {"--out", "--scale", "--video", "--view", "--port", "--foxglove", "--dense", "--no-report",
                "--checkpoint"});
}

// What a run that goes on does not take from the one that stopped, and what may stand beside --resume.
constexpr const char* kOwn[] = {"config", "out", "quiet", "verbose", "json-progress", "foxglove"};
constexpr const char* kBesideResume[] = {"resume", "quiet", "verbose", "json-progress", "foxglove"};

// The settings of the run that stopped in this folder.
RunSettings resumed_settings(const std::string& folder) {
  settle_results(folder);
  auto checkpoint = std::make_shared<Checkpoint>(read_checkpoint(folder));
  RunSettings settings;
  CLI::App command;
  add_run_options(command, settings);
  settings.words = checkpoint->words;
  try {
    command.parse(std::vector<std::string>(settings.words.rbegin(), settings.words.rend()));
  } catch (const CLI::Error& error) {
    throw Error("--resume " + folder +
                ": the options of the run that stopped no longer hold: " + error.what());
  }
  settings.out = folder;
  settings.resumed = std::move(checkpoint);
  return settings;
}

// `sslam run` as it was typed.
void run_as_given(const CLI::App& command, const RunSettings& given, const std::string& resume) {
  if (resume.empty()) {
    RunSettings settings = given;
    settings.words = words_of(command, kOwn);
    return run(std::move(settings));
  }
  for (const CLI::Option* other : given_options(command, kBesideResume))
    throw UsageError("--resume goes on with dataset and options of the run that stopped: leave " +
                     (other->get_positional() ? "" : std::string("--")) + name_of(*other) + " out");
  RunSettings settings = resumed_settings(resume);
  settings.verbosity = given.verbosity;
  settings.foxglove = given.foxglove;
  run(std::move(settings));
}

}  // namespace

void add_run_options(CLI::App& command, RunSettings& settings) {
  add_input_options(command, settings);
  add_tracking_options(command, settings);
  add_output_options(command, settings);
}

void add_run_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("run", "Track a sequence: trajectory, map, figures and pictures");
  auto settings = std::make_shared<RunSettings>();
  add_config_option(*command);
  add_run_options(*command, *settings);
  auto resume = std::make_shared<std::string>();
  const auto resumes = [command, resume](const std::string& folder) {
    *resume = folder;
    command->get_option("dataset")->required(false);
  };
  command
      ->add_option_function<std::string>("--resume", resumes,
                                         "Go on where the run into this folder stopped, with its dataset and "
                                         "options, from its last checkpoint")
      ->trigger_on_parse()
      ->type_name("DIR");
  put_in_group(*command, "Output", {"--resume"});
  add_progress_options(*command, settings->verbosity, true);
  put_in_group(*command, "Messages", {"--quiet", "--verbose", "--json-progress"});
  command->callback([command, settings, resume] { run_as_given(*command, *settings, *resume); });
}

}  // namespace sslam::cli
