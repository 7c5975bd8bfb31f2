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
      "fixed: use it as given; refine: if the images contradict it, track them again with the camera that "
      "was found; find: it is a guess, so find the camera first, as without a calibration; default refine");
  command.add_option("--start", s.slice.start, "First frame")
      ->capture_default_str()
      ->check(CLI::NonNegativeNumber);
  command.add_option("--end", s.slice.end, "Frame to stop before; negative: use all")->capture_default_str();
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
                  "Longest side of an image in pixels: larger images are shrunk; 0: no limit")
      ->capture_default_str()
      ->check(CLI::Range(0, 100000));
  command
      .add_option("--mask", s.mask,
                  "Mask: an image whose pixels of 0 are left out of all frames (a robot's own parts, "
                  "burnt-in text), or a folder with a mask for each frame, NAME.png")
      ->type_name("FILE");
  command
      .add_option("--record", s.record,
                  "Save the tracked images as a dataset in a new folder; FILE.mcap: save the results as "
                  "`sslam export --format mcap` does")
      ->type_name("DIR");
  command.add_option("--retry", s.retry, "Seconds during which a lost camera or stream is tried again")
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
  std::string presets = "Stages of the pipeline:";
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
  command.add_flag_callback("--list-parameters", list, "Print all parameters for --set, and stop")
      ->trigger_on_parse();
  command.add_option("--seed", s.seed, "Seed of all random samples")
      ->capture_default_str()
      ->check(number_from_zero());
  command
      .add_option("--map", s.map,
                  "Continue in the map of an earlier run (map.sslam): poses are in the world of that map")
      ->type_name("FILE");
  command.add_flag("--live", s.live,
                   "Live mode: frames arrive at the pace of their stamps, mapping and loop closing have "
                   "their own thread, tracking never waits for them; no two runs are alike");
  command.add_flag_callback(
      "--no-final-pass", [&s] { s.final_pass = false; },
      "Leave out the final pass, which adjusts the whole map after the last frame and tracks every frame "
      "again");
  const auto tell_read_out = [&s](double seconds) {
    s.set.push_back("final_pass.read_out=" + std::to_string(seconds));
    s.set.push_back("final_pass.shutter.search=0");
  };
  command
      .add_option_function<double>("--read-out", tell_read_out,
                                   "Read-out time of a rolling shutter, from the first row to the last; 0: "
                                   "global shutter; default: estimated after the last frame")
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
      "--view", s.view, "Show the run in a browser on this machine, then its report until Ctrl-C");
  add_port_option(command, s.port)->needs(view);
  add_foxglove_option(command, s.foxglove);
  command.add_flag("--dense", s.dense,
                   "Write walls, floors and other planes with texture: model.glb, model.obj, model.ply");
  command.add_flag_callback(
      "--no-report", [&s] { s.report = false; }, "Do not write report.html and its pictures");
  command
      .add_option("--checkpoint", s.checkpoint,
                  "Interval of checkpoints, which --resume continues from; 0: none; default 60, and none "
                  "with --live, --view, --video, --record, --dense or a stream")
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
                ": the options of the run that stopped are no longer valid: " + error.what());
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
    throw UsageError("--resume continues with the dataset and options of the run that stopped: leave " +
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
  add_config_option(*command, &settings->set_places);
  add_run_options(*command, *settings);
  auto resume = std::make_shared<std::string>();
  const auto resumes = [command, resume](const std::string& folder) {
    *resume = folder;
    command->get_option("dataset")->required(false);
  };
  command
      ->add_option_function<std::string>(
          "--resume", resumes,
          "Continue the run into this folder from its last checkpoint, with its dataset and options")
      ->trigger_on_parse()
      ->type_name("DIR");
  put_in_group(*command, "Output", {"--resume"});
  add_progress_options(*command, settings->verbosity, true);
  put_in_group(*command, "Messages", {"--quiet", "--verbose", "--json-progress"});
  command->callback([command, settings, resume] { run_as_given(*command, *settings, *resume); });
}

}  // namespace sslam::cli
