// SPDX-License-Identifier: BSD-3-Clause
// `sslam synth DIR`: renders a house that is known to the last edge.
#include "cli/synth.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "cli/commands.hpp"
#include "cli/results/folder_lock.hpp"
#include "cli/results/result_set.hpp"
#include "cli/shell/exit_code.hpp"
#include "cli/shell/interrupt.hpp"
#include "cli/shell/worker_threads.hpp"
#include "cli/synth/synth_files.hpp"
#include "cli/synth/synth_options.hpp"
#include "sslam/core/error.hpp"
#include "sslam/synth/render.hpp"
#include "sslam/synth/rolling_shutter.hpp"
#include "sslam/synth/shutter.hpp"

namespace sslam::cli {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

// Rounded to what the lists print, so that every file tells the same time.
double stamp_of(const SynthSettings& settings, std::size_t frame) {
  return std::round(static_cast<double>(frame) / settings.rate * 1e6) * 1e-6;
}

// Renders and writes the frames on all threads; returns how many from the first on are complete.
std::size_t render_frames(const SynthSettings& settings, const synth::House& house,
                          const Camera<double>& camera, const synth::LensGrid& lens, std::size_t frames) {
  const synth::View view{camera.pinhole, camera.width, camera.height, {}};
  const synth::Shutter shutter{settings.blur / settings.rate, settings.read_out};
  const bool plain = settings.read_out == 0.0 && camera.distortion.is_identity();
  Progress progress(frames, settings.verbosity, "synth");
  const synth::Sensor sensor(settings.sensor, settings.house.seed);
  std::vector<std::uint8_t> written(frames, 0);
  const auto pose_at = [&](double t) { return house.path.world_from_cam(t).inverse(); };
  WorkerThreads(settings.threads).run(frames, [&] {
    auto renderer = std::make_shared<synth::Renderer>(house.scene);
    return [&, renderer, frame = synth::RenderedFrame{}, rgb = std::vector<std::uint8_t>{},
            writer = FrameWriter(settings)](std::size_t i) mutable {
      if (Interrupt::asked()) return;
      const double stamp = stamp_of(settings, i);
      if (plain)
        synth::render_open_shutter(*renderer, pose_at, stamp, shutter.open, view, frame);
      else
        synth::render_rolling_shutter(*renderer, pose_at, stamp, shutter, view, lens, frame);
      sensor.expose(frame, static_cast<int>(i), stamp, rgb);
      writer.write(static_cast<int>(i), frame, rgb);
      written[i] = 1;
      progress.show("rendered");
    };
  });
  progress.finish();
  return static_cast<std::size_t>(std::find(written.begin(), written.end(), 0) - written.begin());
}

double length_of(const io::Trajectory& trajectory) {
  double length = 0.0;
  for (std::size_t i = 1; i < trajectory.size(); ++i) {
    length +=
        (trajectory[i].world_from_cam.translation - trajectory[i - 1].world_from_cam.translation).norm();
  }
  return length;
}

// Throws where what was asked of the house goes together in none.
void check_house(const synth::HouseOptions& house) {
  const bool plain = house.world == synth::World::kManhattan || house.world == synth::World::kTurned;
  if (house.rooms > 1 && !(plain && house.path == synth::PathKind::kLoop)) {
    throw Error(
        "several rooms have Manhattan walls and a tour: --world oblique or free, and --path, need --rooms 1");
  }
  if (house.off_square > 0.0 && (house.rooms > 1 || house.world != synth::World::kManhattan)) {
    throw Error(
        "--off-square turns the walls of one Manhattan room: it needs --rooms 1 and --world manhattan");
  }
  if ((house.doors_ajar || house.clutter > 0) && house.rooms != 1 && house.rooms != 3) {
    throw Error(
        "a floor of many rooms has no clutter and its doors are closed: --doors-ajar and --clutter need "
        "--rooms 1 or 3");
  }
}

void run_synth(const SynthSettings& settings) {
  const SynthReport report = synthesise(settings);
  std::printf("%s: %d frames, %.1f m, house built in %.1f s, %.1f frames/s\n", settings.folder.c_str(),
              report.frames, report.path_metres, report.build_seconds,
              report.frames / std::max(report.render_seconds, 1e-6));
  if (report.interrupted) throw Stop{ExitCode::kInterrupted};
}

}  // namespace

SynthReport synthesise(const SynthSettings& asked) {
  SynthSettings settings = asked;  // and its folder is the one beside, until all is written
  check_house(settings.house);
  if (settings.read_out * settings.rate > 1.0 + 1e-9) {
    char text[128];
    std::snprintf(text, sizeof text,
                  "--read-out %g is longer than a frame: expected at most %.4g s at --fps %g",
                  settings.read_out, 1.0 / settings.rate, settings.rate);
    throw Error(text);
  }
  if (settings.focal <= 0.0) settings.focal = settings.focal_of_width * settings.width;
  const Camera<double> camera{
      {settings.focal, settings.focal, 0.5 * (settings.width - 1), 0.5 * (settings.height - 1)},
      settings.lens,
      settings.width,
      settings.height};
  const synth::LensGrid lens(camera);
  if (!lens.usable()) {
    throw Error("--lens " + lens_text(camera.distortion) +
                ": the distortion folds the image back, or nearly; expected a weaker one, or a --focal "
                "longer than " +
                std::to_string(std::lround(settings.focal)));
  }
  claim_synth_folder(asked.folder);
  const FolderLock lock = FolderLock::demand(asked.folder);
  ResultSet results(asked.folder);
  settings.folder = results.stage().string();
  prepare_image_folders(settings);
  const Interrupt interrupt;
  SynthReport report;
  const Clock::time_point start = Clock::now();
  const synth::House house = synth::build_house(settings.house, WorkerThreads(settings.threads));
  report.build_seconds = seconds_since(start);
  const int lap = std::max(1, static_cast<int>(std::lround(house.path.first_lap_seconds() * settings.rate)));
  const std::size_t frames = static_cast<std::size_t>(settings.frames > 0 ? settings.frames : lap);
  const Clock::time_point rendering = Clock::now();
  const std::size_t complete = render_frames(settings, house, camera, lens, frames);
  io::Trajectory truth;
  for (std::size_t i = 0; i < complete; ++i) {
    const double stamp = stamp_of(settings, i);
    truth.push_back({stamp, house.path.world_from_cam(stamp)});
  }
  if (complete > 0) {
    write_synth_lists(settings, camera, house.outline, truth);
    results.commit(kSynthParts);
  }
  report.render_seconds = seconds_since(rendering);
  report.frames = static_cast<int>(complete);
  report.path_metres = length_of(truth);
  report.interrupted = complete < frames;
  return report;
}

void add_synth_command(CLI::App& app) {
  CLI::App* synth =
      app.add_subcommand("synth", "Render a synthetic house with ground truth, TUM RGB-D layout");
  auto settings = std::make_shared<SynthSettings>();
  synth->add_option("DIR", settings->folder, "folder for the dataset; created if missing")->required();
  add_synth_options(*synth, *settings);
  synth->callback([settings] { run_synth(*settings); });
}

}  // namespace sslam::cli
