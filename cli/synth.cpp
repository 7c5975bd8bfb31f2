// SPDX-License-Identifier: BSD-3-Clause
// `sslam synth DIR`: renders a house that is known to the last edge.
#include "cli/synth.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cli/commands.hpp"
#include "cli/shell/choice_option.hpp"
#include "cli/shell/exit_code.hpp"
#include "cli/shell/interrupt.hpp"
#include "cli/shell/option_info.hpp"
#include "cli/shell/progress_options.hpp"
#include "cli/shell/worker_threads.hpp"
#include "cli/synth/synth_files.hpp"
#include "cli/synth/synth_names.hpp"
#include "sslam/core/error.hpp"
#include "sslam/io/files/text.hpp"
#include "sslam/synth/render.hpp"
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
std::size_t render_frames(const SynthSettings& settings, const synth::House& house, const synth::View& view,
                          std::size_t frames) {
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
      synth::render_open_shutter(*renderer, pose_at, stamp, settings.blur / settings.rate, view, frame);
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

bool parse_size(const std::string& text, int& width, int& height) {
  int end = 0;
  return std::sscanf(text.c_str(), "%dx%d%n", &width, &height, &end) == 2 &&
         end == static_cast<int>(text.size()) && width >= 32 && height >= 32 && width <= 8192 &&
         height <= 8192;
}

// A number between two bounds; CLI::Range lets nan through.
CLI::Validator between(double low, double high) {
  return CLI::Validator(
      [low, high](std::string& text) {
        const std::optional<double> value = io::parse_number<double>(text);
        if (value && *value >= low && *value <= high) return std::string();
        char reason[128];
        std::snprintf(reason, sizeof reason, "expected a number between %g and %g, found ", low, high);
        return reason + ("'" + text + "'");
      },
      "");
}

void run_synth(const SynthSettings& settings) {
  const SynthReport report = synthesise(settings);
  std::printf("%s: %d frames, %.1f m, house built in %.1f s, %.1f frames/s\n", settings.folder.c_str(),
              report.frames, report.path_metres, report.build_seconds,
              report.frames / std::max(report.render_seconds, 1e-6));
  if (report.interrupted) throw Stop{ExitCode::kInterrupted};
}

// The settings must live until the application has been parsed.
void add_scene_options(CLI::App& synth, SynthSettings& s) {
  synth.add_option("--seed", s.house.seed, "of layout, materials, light, path and noise; default 1")
      ->check([](const std::string& text) {
        return io::parse_number<std::uint64_t>(text) ? std::string()
                                                     : "'" + text + "' is not a whole number from 0 on";
      });
  add_choice(synth, "--texture", s.house.richness, kRichnessNames,
             "rich, mixed or poor (plain paint alone); default rich");
  add_choice(
      synth, "--world", s.house.world, kWorldNames,
      "manhattan, turned (furniture at other headings), oblique (one such wall) or free (no right angle "
      "between walls); the last two for a single room; default manhattan");
  synth.add_option("--rooms", s.house.rooms, "1, or 3 along a corridor; default 1")
      ->check(CLI::IsMember({1, 3}));
  add_choice(
      synth, "--path", s.house.path, kPathNames,
      "loop, sweep (to and fro before a wall) or pivot (turns on the spot, then loops); three rooms are "
      "always toured; default loop");
  synth.add_option("--speed", s.house.motion.speed, "metres per second; default 0.5")
      ->check(between(0.01, 5.0));
  synth.add_option("--tremor", s.house.motion.tremor, "of the hand; 0: none, default 1")
      ->check(between(0.0, 10.0));
}

void add_camera_options(CLI::App& synth, SynthSettings& s) {
  synth.add_option("--frames", s.frames, "how many; default one lap of the path")
      ->check(CLI::Range(1, 1000000).description(""));
  synth.add_option("--fps", s.rate, "frames per second; default 30")->check(between(0.1, 1000.0));
  synth
      .add_option_function<std::string>(
          "--size", [&s](const std::string& text) { (void)parse_size(text, s.width, s.height); },
          "WIDTHxHEIGHT in pixels; default 640x480")
      ->check([](const std::string& text) {
        int width = 0, height = 0;
        return parse_size(text, width, height)
                   ? std::string()
                   : "'" + text + "' is not a size such as 640x480 (32 to 8192 pixels)";
      });
  synth.add_option("--focal", s.focal, "focal length in pixels; default three quarters of the width")
      ->check(between(10.0, 1e5));
  synth.add_option("--noise", s.sensor.noise, "standard deviation in grey levels; default 1.5")
      ->check(between(0.0, 100.0));
  synth.add_option("--vignetting", s.sensor.vignetting, "darkening of the corners as a share; default 0.12")
      ->check(between(0.0, 1.0));
  synth.add_option("--blur", s.blur, "share of the frame time that the shutter is open; default 0")
      ->check(between(0.0, 1.0));
  synth
      .add_option("--exposure", s.sensor.exposure_swing,
                  "largest change of brightness, as a share; default 0")
      ->check(between(0.0, 0.9));
}

}  // namespace

SynthReport synthesise(const SynthSettings& asked) {
  SynthSettings settings = asked;
  const bool plain =
      settings.house.world == synth::World::kManhattan || settings.house.world == synth::World::kTurned;
  if (settings.house.rooms == 3 && !(plain && settings.house.path == synth::PathKind::kLoop)) {
    throw Error(
        "three rooms have Manhattan walls and a tour: --world oblique or free, and --path, need --rooms 1");
  }
  if (settings.focal <= 0.0) settings.focal = 0.75 * settings.width;
  prepare_synth_folder(settings);
  const Interrupt interrupt;
  SynthReport report;
  const Clock::time_point start = Clock::now();
  const synth::House house = synth::build_house(settings.house, WorkerThreads(settings.threads));
  report.build_seconds = seconds_since(start);
  const int lap = std::max(1, static_cast<int>(std::lround(house.path.lap_seconds() * settings.rate)));
  const std::size_t frames = static_cast<std::size_t>(settings.frames > 0 ? settings.frames : lap);
  const Pinhole<double> pinhole{settings.focal, settings.focal, 0.5 * (settings.width - 1),
                                0.5 * (settings.height - 1)};
  const Clock::time_point rendering = Clock::now();
  const std::size_t complete =
      render_frames(settings, house, {pinhole, settings.width, settings.height, {}}, frames);
  io::Trajectory truth;
  for (std::size_t i = 0; i < complete; ++i) {
    const double stamp = stamp_of(settings, i);
    truth.push_back({stamp, house.path.world_from_cam(stamp)});
  }
  write_synth_lists(settings, pinhole, truth);
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
  synth->add_option("DIR", settings->folder, "where the data set goes; made if it is not there")->required();
  add_scene_options(*synth, *settings);
  add_camera_options(*synth, *settings);
  synth->add_option("--image-format", settings->image_format, "jpg (quality 95) or png; default jpg")
      ->check(CLI::IsMember({"jpg", "png"}));
  synth->add_flag_callback(
      "--no-depth", [settings] { settings->depth = false; }, "leave the depth images out");
  synth->add_flag_callback(
      "--no-normals", [settings] { settings->normals = false; }, "leave the normal images out");
  synth->add_option("--threads", settings->threads, "default one for each processor; the result is the same")
      ->check(CLI::Range(1, 1024).description(""));
  add_progress_options(*synth, settings->verbosity, false);
  synth->callback([settings] { run_synth(*settings); });
}

}  // namespace sslam::cli
