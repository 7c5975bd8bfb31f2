// SPDX-License-Identifier: BSD-3-Clause
// `sslam run DATASET`: tracks a sequence.
#include "cli/run.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <utility>

#include "cli/commands.hpp"
#include "cli/dense/dense_result.hpp"
#include "cli/input/camera_options.hpp"
#include "cli/input/shipped_model.hpp"
#include "cli/report.hpp"
#include "cli/results/folder_lock.hpp"
#include "cli/results/result_set.hpp"
#include "cli/results/run_folder.hpp"
#include "cli/results/run_report.hpp"
#include "cli/run/metric_scale.hpp"
#include "cli/run/run_check.hpp"
#include "cli/run/run_pass.hpp"
#include "cli/run/self_calibration.hpp"
#include "cli/shell/choice_option.hpp"
#include "cli/shell/config_file.hpp"
#include "cli/shell/exit_code.hpp"
#include "cli/shell/help_formatter.hpp"
#include "cli/shell/interrupt.hpp"
#include "cli/shell/messages.hpp"
#include "cli/shell/option_info.hpp"
#include "cli/shell/progress_options.hpp"
#include "cli/stream/live_source.hpp"
#include "cli/stream/recording.hpp"
#include "cli/stream/stream_name.hpp"
#include "cli/view/view_options.hpp"

namespace sslam::cli {
namespace {

// Why the last frame has no pose, if it has none.
std::string last_reason_of(const RunOutcome& outcome) {
  return outcome.frames.empty() ? "no image could be read" : name(outcome.frames.back().reason);
}

// A source of normals that gives nothing, view after view, is wrong as a whole: its manifest, or its scale.
void warn_of_useless_normals(const std::string& source, RunOutcome& outcome) {
  constexpr std::size_t kEnough = 10;  // frames, to tell a fault from a view of clutter
  std::size_t asked = 0;
  bool any = false;
  for (const FrameRecord& frame : outcome.frames) {
    if (frame.normal_need == NormalNeed::kNotNeeded) continue;
    ++asked;
    any = any || frame.normal_status == NormalStatus::kOk;
  }
  if (any || asked < kEnough) return;
  outcome.warnings.push_back("--normals " + source + ": not one of " + std::to_string(asked) +
                             " frames has normals that are of use; sslam normals shows what a network sees");
}

void note_stream(const LiveSource& source, RunOutcome& outcome) {
  const StreamFigures figures = source.figures();
  outcome.frames_dropped = figures.dropped;
  outcome.stream_losses = figures.lost;
  if (!figures.end.empty()) outcome.warnings.push_back(figures.end);
}

Settings system_settings(const RunSettings& settings, const CameraChoice& camera,
                         const std::vector<ParameterValue>& parameters) {
  Settings wanted;
  wanted.preset = settings.preset;
  wanted.parameters = parameters;
  wanted.camera = camera.camera;
  wanted.depth_factor = camera.depth_factor;
  wanted.normals = choose_normals(settings.normals);
  wanted.seed = settings.seed;
  wanted.live = settings.live;
  wanted.longest_side = settings.longest_side;
  wanted.final_pass = settings.final_pass;
  wanted.keep_pictures = true;  // the map's colours come from them
  return wanted;
}

// What it has to say is a warning of the run.
void add_dense(RunPass& pass) {
  RunOutcome& outcome = pass.recorder.outcome;
  outcome.dense = std::make_shared<const DenseResult>(
      make_dense(outcome.map, pass.recorder.pictures, pass.system.camera()));
  outcome.warnings.insert(outcome.warnings.end(), outcome.dense->warnings.begin(),
                          outcome.dense->warnings.end());
}

// Of the images as they come, for who tracks the recording.
void keep_camera(const CameraChoice& camera, Recording& recording) {
  if (camera.assumed) return;
  CameraFile file;
  file.camera = camera.camera;
  file.wide = camera.wide;
  if (file.wide) {
    file.camera.pinhole = file.wide->pinhole;
    if (file.wide->model != WideModel::kFisheye)
      return print_warning("--record: a camera file for this lens is not written; put a copy of " +
                           camera.source + " into the folder, as camera.yaml");
  }
  recording.keep_camera(file);
}

// In metres, where the settings ask for it and the map can tell.
void bring_to_metres(const ScaleWish& wish, const ScaleInput& input, RunOutcome& outcome) {
  outcome.scale = find_scale(wish, outcome, input);
  apply_scale(outcome.scale, outcome);
  if (!outcome.scale.problem.empty() && !outcome.trajectory.empty())
    outcome.warnings.push_back("--scale " + outcome.scale.method + ": " + outcome.scale.problem +
                               "; the results stay in the map's own unit");
}

// What a warning of a camera ends with: where to read the one that was found.
std::string found_at(const RunSettings& settings) {
  return (std::filesystem::path(settings.out) / kCameraFoundFile).string();
}

}  // namespace

void run(RunSettings settings) {
  const Preset& preset = choose_preset(settings.preset);
  check_live(settings, preset);
  if (settings.normals.empty()) {
    const DefaultNormals chosen = default_normals(find_shipped_model(), preset.use_normals);
    // The dense model looks at the normals of every keyframe.
    settings.normals = settings.dense ? source_of_normals(chosen.source) : chosen.source;
    if (!chosen.note.empty()) print_note(chosen.note);
  }
  const std::vector<ParameterValue> parameters = set_parameters(preset, settings.set);
  const ScaleWish scale = parse_scale(settings.scale);
  Map<double> known;
  if (!settings.map.empty()) known = load_run_map(settings.map);
  std::optional<Recording> recording;
  std::optional<Interrupt> interrupt;  // until all is written
  std::optional<LiveSource> source;
  io::Dataset dataset;
  CameraChoice camera;
  if (const std::optional<StreamName> stream = stream_named(settings.dataset)) {
    interrupt.emplace();  // it may never send anything
    source.emplace(*stream, StreamOptions{settings.live, settings.retry, settings.frame_rate, settings.slice,
                                          size_of_stream_camera(settings)});
    const cv::Size size = source->wait_for_first();
    dataset = source->dataset();
    settings.dataset = dataset.root.string();
    camera = choose_stream_camera(settings, dataset, size);
  } else {
    dataset = open_run_dataset(settings);
    camera = choose_run_camera(settings, dataset);
  }
  print_notes(camera);
  check_normals(settings, dataset, camera.depth_factor);
  check_scale(scale, dataset, camera.depth_factor);
  check_wide(settings, camera);
  std::optional<WideView> view;
  if (camera.wide) view.emplace(*camera.wide, camera.view_fov);
  MaskSource masks;
  if (!settings.mask.empty()) masks = MaskSource(settings.mask, {camera.camera.width, camera.camera.height});
  Settings wanted = system_settings(settings, camera, parameters);
  io::prepare_output_folder(settings.out);
  const FolderLock lock = FolderLock::demand(settings.out);
  if (!settings.record.empty()) {
    recording.emplace(settings.record);
    keep_camera(camera, *recording);
  }
  if (!interrupt) interrupt.emplace();
  const FrameStreamOptions stream{0, masks, view ? &*view : nullptr, source ? &*source : nullptr,
                                  recording ? &*recording : nullptr};

  // A map that is gone on in was made with its own camera.
  // A view of a wide lens has no lens of its own.
  const bool examines = settings.calibration != CalibrationMode::kFixed && known.empty() && !view;
  const bool repeats = examines && !settings.live && !settings.view && !source && !recording;
  SelfCalibration calibration(dataset, masks, camera, settings.calibration == CalibrationMode::kFind);
  if (repeats && calibration.is_guess()) {
    calibration.find(std::move(wanted), camera, found_at(settings));
    wanted = system_settings(settings, camera, parameters);
  }
  auto pass = std::make_unique<RunPass>(settings, dataset, camera, std::move(wanted));
  if (!known.empty()) pass->go_on_in(std::move(known));
  pass->track(dataset, stream);
  if (examines && !pass->recorder.outcome.interrupted) {
    calibration.examine(pass->system);
    if (repeats && !calibration.is_guess() && calibration.contradicts()) {
      pass.reset();
      calibration.find(system_settings(settings, camera, parameters), camera, found_at(settings));
      pass =
          std::make_unique<RunPass>(settings, dataset, camera, system_settings(settings, camera, parameters));
      pass->track(dataset, stream);
      calibration.examine(pass->system);
    } else if (calibration.contradicts()) {
      pass->system.warn(calibration.advice(found_at(settings)));
    }
    pass->recorder.outcome.calibration = calibration.record();
  }

  RunOutcome& outcome = pass->recorder.outcome;
  if (source) note_stream(*source, outcome);
  warn_of_useless_normals(settings.normals, outcome);
  bring_to_metres(scale,
                  {dataset, pass->context.working_camera, camera.depth_factor, is_metric_map(settings.map)},
                  outcome);
  if (settings.dense) add_dense(*pass);
  outcome.warnings.insert(outcome.warnings.begin(), calibration.warnings().begin(),
                          calibration.warnings().end());
  print_warnings(outcome.warnings);
  ResultSet results(settings.out);
  write_run(pass->context, outcome, results.stage());
  const bool interrupted = outcome.interrupted, tracked = !outcome.trajectory.empty();
  const std::string last_reason = last_reason_of(outcome);
  outcome = {};  // the report is made from the files, and needs the room
  std::string page;
  if (settings.report || pass->live)
    page = report_of(results.stage(), folder_name(std::filesystem::path(settings.out)));
  if (settings.report) write_report(results.stage(), page);
  results.commit(kOptionalFiles);
  std::printf("written to       %s\n", settings.out.c_str());
  if (pass->video) pass->video->commit();
  if (interrupted || Interrupt::asked()) {
    print_warning("interrupted; what had been computed was written");
    throw Stop{ExitCode::kInterrupted};
  }
  if (!tracked) print_error(settings.dataset + ": no frame was tracked; last reason: " + last_reason);
  if (pass->live) pass->live->show(std::move(page));
  if (!tracked) throw Stop{ExitCode::kFailed};
}

void add_run_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("run", "Track a sequence: trajectory, map, figures and pictures");
  auto s = std::make_shared<RunSettings>();
  add_config_option(*command);
  command
      ->add_option(
          "dataset", s->dataset,
          "Folder (TUM RGB-D, EuRoC, ICL-NUIM, 7-Scenes, ScanNet, KITTI, nerfstudio, ..., plain images), a "
          "quoted glob of images, a video, a bag of ROS 1 or 2 (bag, mcap), " +
              std::string(kStreamKinds))
      ->required();
  command
      ->add_option("--topic", s->topics.images, "Topic of a bag's images; not needed where it has one alone")
      ->type_name("NAME");
  command
      ->add_option("--depth-topic", s->topics.depth,
                   "Topic of a bag's depth images, for the same pixels; not needed where it has one alone")
      ->type_name("NAME");
  add_camera_options(*command, s->camera, s->focal, s->fov);
  command
      ->add_option("--undistort-fov", s->undistort_fov,
                   "Of a lens that is too wide for a pinhole: degrees across of the view that its images are "
                   "undistorted to; default 110, or what it sees")
      ->check(CLI::Range(30.0, WideView::kWidest))
      ->type_name("DEGREES");
  static const std::map<std::string, CalibrationMode> kCalibrations{{"fixed", CalibrationMode::kFixed},
                                                                    {"refine", CalibrationMode::kRefine},
                                                                    {"find", CalibrationMode::kFind}};
  add_choice(
      *command, "--calibration", s->calibration, kCalibrations,
      "fixed: as it is given; refine: where the images contradict it, track them again with the camera "
      "that was found; find: it is a guess, so find the camera first, as is done without a calibration; "
      "default refine");
  command->add_option("--normals", s->normals, kNormalsMeaning)->type_name("SOURCE");
  command
      ->add_option("--longest-side", s->longest_side,
                   "Images with a longer side are shrunk to it, pixels; 0: none is")
      ->capture_default_str()
      ->check(CLI::Range(0, 100000));
  command
      ->add_option(
          "--mask", s->mask,
          "Image whose pixels of 0 are left out of all frames (a robot's own parts, burnt-in text), or "
          "a folder with such an image for each frame, NAME.png")
      ->type_name("FILE");
  std::string presets = "What the pipeline is made of:";
  std::vector<std::string> names;
  for (const Preset& preset : all_presets()) {
    presets += "\n  " + std::string(preset.name) + ": " + std::string(preset.meaning);
    names.emplace_back(preset.name);
  }
  command->add_option("--preset", s->preset, presets)->capture_default_str()->type_name(words_type(names));
  command
      ->add_option("--map", s->map,
                   "Go on in the map of an earlier run, its map.sslam: poses are in that map's world")
      ->type_name("FILE");
  command
      ->add_option("--scale", s->scale,
                   "Results in metres: depth (by the dataset's depth images), height=METRES (of the camera "
                   "above the floor), known=METRES (between the first and the last frame with a pose) or "
                   "known=METRES@A:B (between the frames A and B); default none: the map's own unit")
      ->type_name("HOW");
  command->add_option("-o,--out", s->out, "Folder for the results")->capture_default_str()->type_name("DIR");
  command->add_option("--start", s->slice.start, "First frame")
      ->capture_default_str()
      ->check(CLI::NonNegativeNumber);
  command->add_option("--end", s->slice.end, "Frame to stop before; negative: the last")
      ->capture_default_str();
  command->add_option("--stride", s->slice.stride, "Take every n-th frame")
      ->capture_default_str()
      ->check(CLI::PositiveNumber);
  command->add_option("--set", s->set, "stage.parameter=value, see --list-parameters; may be repeated")
      ->allow_extra_args(false);
  const auto list = [] {
    std::fputs(describe_parameters().c_str(), stdout);
    throw CLI::Success();
  };
  command->add_flag_callback("--list-parameters", list, "Print what --set can change, and stop")
      ->trigger_on_parse();
  command->add_option("--seed", s->seed, "Of everything random")->capture_default_str();
  command->add_flag(
      "--live", s->live,
      "As with a camera: frames come at the pace of their stamps, mapping and loop closing have "
      "a thread of their own, tracking never waits for them; no two runs are alike");
  command
      ->add_option("--record", s->record,
                   "Keep the images as a dataset that sslam run takes, in a new folder, as they come")
      ->type_name("DIR");
  command->add_option("--retry", s->retry, "Seconds that a lost camera or stream is tried again for")
      ->capture_default_str()
      ->check(CLI::Range(0.0, 86400.0));
  command->add_flag_callback(
      "--no-final-pass", [s] { s->final_pass = false; },
      "Leave out what follows the last frame: the whole map is adjusted, and every frame tracked again in "
      "it");
  command
      ->add_option("--fps", s->frame_rate,
                   "Frames a second, for images without stamps, in a folder or through a pipe")
      ->capture_default_str()
      ->check(CLI::PositiveNumber);
  command
      ->add_option("--video", s->video,
                   "Overlay video to write, .mp4 or .avi: features, segments by axis, normals, state")
      ->type_name("FILE");
  CLI::Option* const view = command->add_flag(
      "--view", s->view,
      "Show the run in a browser on this machine while it goes on, then its report until Ctrl-C");
  add_port_option(*command, s->port)->needs(view);
  command->add_flag(
      "--dense", s->dense,
      "Write the walls, floors and other planes with the images on them: model.glb for any viewer, "
      "model.ply");
  command->add_flag_callback(
      "--no-report", [s] { s->report = false; }, "Leave report.html and the pictures for it out");
  add_progress_options(*command, s->verbosity, true);
  put_in_group(
      *command, "Input",
      {"--topic", "--depth-topic", "--camera", "--focal", "--fov", "--undistort-fov", "--calibration",
       "--start", "--end", "--stride", "--fps", "--longest-side", "--mask", "--record", "--retry"});
  put_in_group(*command, "Tracking",
               {"--normals", "--preset", "--set", "--list-parameters", "--seed", "--map", "--live",
                "--no-final-pass"});
  put_in_group(*command, "Output",
               {"--out", "--scale", "--video", "--view", "--port", "--dense", "--no-report"});
  put_in_group(*command, "Messages", {"--quiet", "--verbose", "--json-progress"});
  command->callback([s] { run(*s); });
}

}  // namespace sslam::cli
