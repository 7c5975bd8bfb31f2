// SPDX-License-Identifier: BSD-3-Clause
// `sslam view RUN|MAP`: the report of a run, or a map, for a browser on this machine.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>

#include "cli/commands.hpp"
#include "cli/report.hpp"
#include "cli/report/report_data.hpp"
#include "cli/results/json_file.hpp"
#include "cli/results/map_figures.hpp"
#include "cli/results/result_set.hpp"
#include "cli/results/run_folder.hpp"
#include "cli/shell/interrupt.hpp"
#include "cli/shell/messages.hpp"
#include "cli/view/view_options.hpp"
#include "cli/view/view_server.hpp"

namespace sslam::cli {
namespace {

namespace fs = std::filesystem;

// Of the model that `sslam run --dense` has written beside the map; none where there is no such file, and
// with a warning where it is damaged or of another run.
TexturedMesh surfaces_beside(const fs::path& map) {
  const fs::path folder = map.parent_path(), model = folder / kModelFile;
  std::error_code ignored;
  if (map.filename() != "map.sslam" || !fs::is_regular_file(model, ignored)) return {};
  try {
    const auto checksums = read_json_object(folder / "metrics.json").value("files", nlohmann::ordered_json());
    if (checksums.contains(kModelFile))
      print_warnings(foreign_files(folder, {{kModelFile, checksums[kModelFile]}}));
  } catch (const Error&) {  // a map and its model may stand alone
  }
  try {
    return read_glb(model);
  } catch (const Error& problem) {
    print_warning(std::string(problem.what()) + ": no surfaces are shown");
    return {};
  }
}

// The page of a run of which there is the map alone.
std::string map_page(const fs::path& file) {
  RunFolder run;
  run.name = file.filename().string();
  run.map = load_run_map(file);
  run.colours = load_map_colours(file, run.map);
  run.surfaces = surfaces_beside(file);
  run.keyframes = keyframe_poses(run.map);
  run.metrics = {{"keyframes", run.keyframes.size()},
                 {"points", count_alive(run.map.points)},
                 {"lines", count_alive(run.map.lines)},
                 {"planes", count_alive(run.map.planes)}};
  nlohmann::ordered_json data = report_data(run);
  data["kind"] = "map";
  return report_html(data, {});
}

SharedText page_of(const fs::path& path) {
  std::error_code ignored;
  if (!fs::exists(path, ignored))
    throw Error(path.string() + ": no such file or folder; expected the folder of a run or a map.sslam");
  return std::make_shared<const std::string>(fs::is_directory(path, ignored) ? report_of(path)
                                                                             : map_page(path));
}

void view(const std::string& path, int port) {
  const SharedText page = page_of(path);
  const ViewServer server(port, {[page] { return page; }, {}});
  const Interrupt interrupt;
  std::printf("look at          %s until Ctrl-C\n", server.address().c_str());
  std::fflush(stdout);
  wait_for(interrupt);
}

}  // namespace

void add_view_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "view", "Show a run or a map in a browser on this machine; `sslam run --view` shows a run in progress");
  struct Settings {
    std::string path;
    int port = 0;
  };
  auto s = std::make_shared<Settings>();
  command->add_option("path", s->path, "Folder that `sslam run --out` has written to, or a map (map.sslam)")
      ->required();
  add_port_option(*command, s->port);
  command->callback([s] { view(s->path, s->port); });
}

}  // namespace sslam::cli
