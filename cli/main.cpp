// SPDX-License-Identifier: BSD-3-Clause
// `sslam`: parses the command line, runs one subcommand, turns whatever goes wrong into one line and an exit
// code.
#include <CLI/CLI.hpp>
#include <exception>
#include <iostream>
#include <string>

#include "cli/batch/child.hpp"
#include "cli/commands.hpp"
#include "cli/exit_code.hpp"
#include "cli/messages.hpp"

namespace sslam::cli {
namespace {

constexpr const char* kFooter =
    "Exit codes: 0 success; 1 bad input, unwritable output or no result; 2 wrong command line; "
    "130 interrupted, with what had been computed written.";

// CLI11 prints help and version by itself; everything else becomes our one line.
int report_parse_result(const CLI::App& app, const CLI::ParseError& error) {
  if (error.get_exit_code() == 0) return app.exit(error);
  std::string text = error.what();
  for (char& c : text) {
    if (c == '\n') c = ' ';
  }
  print_error(text + " (see sslam --help)");
  return static_cast<int>(ExitCode::kUsage);
}

int run_main(int argc, char** argv) {
  CLI::App app{"Low-drift monocular SLAM for indoor places with little texture", "sslam"};
  app.set_version_flag("--version", std::string("sslam ") + SSLAM_VERSION);
  app.footer(kFooter);
  app.require_subcommand(1);
  add_run_command(app);
  add_eval_command(app);
  add_normals_command(app);
  add_report_command(app);
  add_batch_command(app);
  add_calibrate_command(app);
  add_fetch_command(app);
  add_synth_command(app);
  add_demo_command(app);
  for (CLI::App* command : app.get_subcommands({})) command->footer(kFooter);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return report_parse_result(app, error);
  }
  return static_cast<int>(ExitCode::kOk);
}

}  // namespace
}  // namespace sslam::cli

int main(int argc, char** argv) {
  using namespace sslam::cli;
  try {
    end_with_parent();
    return run_main(argc, argv);
  } catch (const Stop& stop) {
    return static_cast<int>(stop.code);
  } catch (const std::exception& error) {
    print_error(error.what());
  }
  return static_cast<int>(ExitCode::kFailed);
}
