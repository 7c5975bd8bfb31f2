// SPDX-License-Identifier: BSD-3-Clause
// `sslam demo DIR`: renders a room, tracks it, compares with the truth. It is `synth`, `run` and `eval` in
// one.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>

#include "cli/commands.hpp"
#include "cli/input/default_normals.hpp"
#include "cli/input/shipped_model.hpp"
#include "cli/results/run_folder.hpp"
#include "cli/run.hpp"
#include "cli/shell/exit_code.hpp"
#include "cli/shell/messages.hpp"
#include "cli/shell/number_checks.hpp"
#include "cli/shell/progress_options.hpp"
#include "cli/synth.hpp"

namespace sslam::cli {
namespace {

struct DemoSettings {
  std::string folder = "demo";
  int frames = 300;
  std::uint64_t seed = 1;
  std::string normals;  // as in RunSettings
  Verbosity verbosity = Verbosity::kNormal;
};

// Those of a run without --dense, which asks for normals in every frame: the demo is to be quick.
std::string usual_normals() {
  const DefaultNormals usual = default_normals(find_shipped_model(), true);
  if (!usual.note.empty()) print_note(usual.note);
  return usual.source;
}

void run_demo(const DemoSettings& settings) {
  const std::filesystem::path folder = settings.folder;
  SynthSettings synth;
  synth.folder = (folder / "room").string();
  synth.frames = settings.frames;
  synth.house.seed = settings.seed;
  synth.verbosity = settings.verbosity;
  const SynthReport rendered = synthesise(synth);
  if (rendered.interrupted) throw Stop{ExitCode::kInterrupted};
  RunSettings track;
  track.dataset = synth.folder;
  track.out = (folder / "run").string();
  track.seed = settings.seed;
  track.normals = settings.normals.empty() ? usual_normals() : settings.normals;
  track.dense = true;
  track.verbosity = settings.verbosity;
  run(track);
  std::printf("\nOpen %s in a browser.\n", (folder / "run" / kReportFile).c_str());
}

}  // namespace

void add_demo_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("demo", "Render a room, track it, compare with ground truth");
  auto s = std::make_shared<DemoSettings>();
  command->add_option("folder", s->folder, "Folder for the room and the results")->capture_default_str();
  command->add_option("--frames", s->frames, "Number of frames")
      ->capture_default_str()
      ->check(CLI::Range(10, 100000));
  command->add_option("--seed", s->seed, "Seed of the room and of the run")
      ->capture_default_str()
      ->check(number_from_zero());
  command->add_option("--normals", s->normals, kNormalsMeaning)->type_name("SOURCE");
  add_progress_options(*command, s->verbosity, true);
  command->callback([s] { run_demo(*s); });
}

}  // namespace sslam::cli
