// SPDX-License-Identifier: BSD-3-Clause
#include "cli/run/whole_run.hpp"

#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "cli/dense/dense_result.hpp"
#include "cli/dense/missing_pictures.hpp"
#include "cli/input/shipped_model.hpp"
#include "cli/report.hpp"
#include "cli/results/mcap_export.hpp"
#include "cli/results/result_set.hpp"
#include "cli/results/run_folder.hpp"
#include "cli/results/run_report.hpp"
#include "cli/run/run_check.hpp"
#include "cli/shell/exit_code.hpp"
#include "cli/shell/messages.hpp"
#include "cli/stream/stream_name.hpp"

namespace sslam::cli {
namespace {

// Why the last frame has no pose, if it has none.
std::string last_reason_of(const RunOutcome& outcome) {
  return outcome.frames.empty() ? "no image could be read" : name(outcome.frames.back().reason);
}

// What it has to say is a warning of the run.
void add_dense(const RunInput& input, RunPass& pass) {
  RunOutcome& outcome = pass.recorder.outcome;
  if (!input.source)
    read_missing_pictures(outcome.map, pass.first_keyframe(),
                          {input.dataset, input.masks, input.view ? &*input.view : nullptr,
                           pass.context.camera, pass.system.camera()},
                          pass.recorder.pictures);
  outcome.dense = std::make_shared<const DenseResult>(
      make_dense(outcome.map, pass.first_keyframe(), pass.recorder.pictures, pass.system.camera()));
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

}  // namespace

void WholeRun::open() {
  const Preset& preset = choose_preset(settings_.preset);
  check_live(settings_, preset);
  if (settings_.normals.empty()) choose_normals_source(preset);
  parameters_ = set_parameters(preset, settings_.set, settings_.set_places);
  scale_ = parse_scale(settings_.scale);
  checkpoints_ = checkpoint_clock(settings_);
  goes_on_ = !settings_.map.empty();
  if (goes_on_ && !settings_.resumed) known_ = load_run_map(settings_.map);
  if (stream_named(settings_.dataset)) interrupt_.emplace();  // it may never send anything
  input_.open(settings_);
  check_normals(settings_, input_.dataset, input_.camera.depth_factor);
  check_scale(scale_, input_.dataset, input_.camera.depth_factor);
  input_.choose_pixels(settings_);
  wanted_ = system_settings();
  head_ = begun_checkpoint(settings_.words, input_.dataset, input_.camera.camera);
  if (settings_.resumed)
    check_resumed(*settings_.resumed, input_.dataset, input_.camera.camera, settings_.out);
  open_output();
  if (!interrupt_) interrupt_.emplace();
}

void WholeRun::choose_normals_source(const Preset& preset) {
  const DefaultNormals chosen = default_normals(find_shipped_model(), preset.use_normals);
  // The dense model looks at the normals of every keyframe.
  settings_.normals = settings_.dense ? source_of_normals(chosen.source) : chosen.source;
  if (!chosen.note.empty()) print_note(chosen.note);
}

void WholeRun::open_output() {
  io::prepare_output_folder(settings_.out);
  lock_.emplace(FolderLock::demand(settings_.out));
  if (!settings_.resumed && has_checkpoint(settings_.out))
    print_note(settings_.out + ": holds the checkpoint of a run that stopped, which sslam run --resume " +
               settings_.out + " would continue; this run replaces it");
  if (settings_.foxglove) stream_.emplace(*settings_.foxglove, input_.dataset);
  if (settings_.record.empty() || records_results(settings_)) return;
  recording_.emplace(settings_.record);
  keep_camera(input_.camera, *recording_);
}

void WholeRun::track() {
  calibration_.emplace(input_.dataset, input_.masks, input_.camera,
                       settings_.calibration == CalibrationMode::kFind);
  const bool finds = !settings_.resumed && repeats() && calibration_->is_guess();
  if (settings_.resumed) calibration_->go_on(*settings_.resumed, input_.camera);
  if (finds) calibration_->find(std::move(wanted_), input_.camera, found_at());
  if (settings_.resumed || finds) wanted_ = system_settings();
  begin_pass();
  if (examines() && !outcome().interrupted) examine_camera();
  follow_up();
}

void WholeRun::begin_pass() {
  pass_.reset();  // two of them would write the same video
  calibration_->keep(input_.camera, head_);
  pass_ = std::make_unique<RunPass>(settings_, input_.dataset, input_.camera, std::move(wanted_), head_);
  if (stream_) {
    stream_->begin(pass_->context.working_camera, pass_->recorder.colours);
    pass_->system.add_observer(*stream_);
  }
  if (!known_.empty()) pass_->go_on_in(std::exchange(known_, {}));
  if (const auto resumed = std::exchange(settings_.resumed, nullptr)) pass_->go_on_from(std::move(*resumed));
  pass_->track(input_.dataset, input_.frames(recording_ ? &*recording_ : nullptr), checkpoints_);
}

void WholeRun::track_again() {
  wanted_ = system_settings();
  begin_pass();
}

void WholeRun::examine_camera() {
  calibration_->examine(pass_->system);
  const bool second = calibration_->replaced() && !calibration_->is_guess();  // and the last
  if (!second && repeats() && !calibration_->is_guess() && calibration_->contradicts()) {
    const std::size_t tracked = outcome().trajectory.size();
    const CameraChoice given = input_.camera;
    pass_.reset();  // its memory serves the search
    calibration_->find(system_settings(), input_.camera, found_at());
    track_again();
    if (!outcome().interrupted && calibration_->refuted(tracked, outcome().trajectory.size())) {
      input_.camera = given;
      track_again();
    } else {
      calibration_->examine(pass_->system);
    }
  } else if (!second && calibration_->contradicts()) {
    pass_->system.warn(calibration_->advice(found_at()));
  }
  outcome().calibration = calibration_->record();
}

void WholeRun::follow_up() {
  RunOutcome& outcome = this->outcome();
  const std::size_t told = outcome.warnings.size();  // to those who looked on while frames were tracked
  input_.report(settings_.normals, outcome);
  bring_to_metres(scale_,
                  {input_.dataset, pass_->context.working_camera, input_.camera.depth_factor,
                   is_metric_map(settings_.map)},
                  outcome);
  if (stream_) stream_->finish(outcome);
  if (settings_.dense) add_dense(input_, *pass_);
  const std::vector<std::string>& of_camera = calibration_->warnings();
  if (stream_) {
    for (const std::string& line : of_camera) stream_->warning(line);
    for (std::size_t i = told; i < outcome.warnings.size(); ++i) stream_->warning(outcome.warnings[i]);
  }
  outcome.warnings.insert(outcome.warnings.begin(), of_camera.begin(), of_camera.end());
  print_warnings(outcome.warnings);
  pass_->tell_health();
}

void WholeRun::write() {
  RunOutcome& outcome = this->outcome();
  ResultSet results(settings_.out);
  write_run(pass_->context, outcome, results.stage());
  const bool interrupted = outcome.interrupted, tracked = !outcome.trajectory.empty();
  std::vector<const char*> older(kOptionalFiles.begin(), kOptionalFiles.end());
  // What was interrupted can go on.
  if (!interrupted || !pass_->has_checkpoint())
    older.insert(older.end(), kCheckpointFiles.begin(), kCheckpointFiles.end());
  const std::string last_reason = last_reason_of(outcome);
  outcome = {};  // the report is made from the files, and needs the room
  std::string page;
  if (settings_.report || pass_->live)
    page = report_of(results.stage(), folder_name(std::filesystem::path(settings_.out)));
  if (settings_.report) write_report(results.stage(), page);
  results.commit(older);
  std::printf("written to       %s\n", settings_.out.c_str());
  if (tracked && !settings_.record.empty() && records_results(settings_)) {
    write_mcap_export(settings_.record, read_run_folder(settings_.out));
    std::printf("recorded in      %s\n", settings_.record.c_str());
  }
  if (pass_->video) pass_->video->commit();
  if (interrupted || Interrupt::asked()) {
    const bool resumable = has_checkpoint(settings_.out);
    print_warning("interrupted; the results until then were written" +
                  (resumable ? "; sslam run --resume " + settings_.out + " continues it" : ""));
    throw Stop{ExitCode::kInterrupted};
  }
  if (!tracked) print_error(settings_.dataset + ": no frame was tracked; last reason: " + last_reason);
  if (pass_->live) pass_->live->show(std::move(page));
  if (!tracked) throw Stop{ExitCode::kFailed};
}

Settings WholeRun::system_settings() const {
  Settings wanted;
  wanted.preset = settings_.preset;
  wanted.parameters = parameters_;
  wanted.camera = input_.camera.camera;
  wanted.depth_factor = input_.camera.depth_factor;
  wanted.normals = choose_normals(settings_.normals);
  wanted.seed = settings_.seed;
  wanted.live = settings_.live;
  wanted.longest_side = settings_.longest_side;
  wanted.final_pass = settings_.final_pass;
  wanted.keep_pictures = true;  // the map's colours come from them
  return wanted;
}

// A map that is gone on in was made with its own camera; a view of a wide lens has no lens of its own.
bool WholeRun::examines() const {
  return settings_.calibration != CalibrationMode::kFixed && !goes_on_ && !input_.view;
}

bool WholeRun::repeats() const {
  return examines() && !settings_.live && !settings_.view && !input_.source && !recording_;
}

std::string WholeRun::found_at() const {
  return (std::filesystem::path(settings_.out) / kCameraFoundFile).string();
}

void run(RunSettings settings) {
  WholeRun whole(std::move(settings));
  whole.open();
  whole.track();
  whole.write();
}

}  // namespace sslam::cli
