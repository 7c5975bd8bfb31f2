// SPDX-License-Identifier: BSD-3-Clause
// The program: parses the command line, runs one subcommand, turns whatever goes wrong into one line and an
// exit code.
#include "sslam/system/program.hpp"

#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <iostream>
#include <opencv2/core.hpp>
#include <opencv2/core/utils/logger.hpp>
#include <string>

#include "cli/batch/child.hpp"
#include "cli/commands.hpp"
#include "cli/shell/completion.hpp"
#include "cli/shell/exit_code.hpp"
#include "cli/shell/man_page.hpp"
#include "cli/shell/messages.hpp"
#include "sslam/core/error.hpp"
#include "sslam/version.hpp"

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

// For the places where man and the shells look.
void add_self_description(CLI::App& app) {
  const auto print = [](const std::string& text) {
    std::fputs(text.c_str(), stdout);
    throw CLI::Success();
  };
  app.add_flag_callback(
         "--man", [&app, print] { print(man_page(app)); }, "Print the man page and exit")
      ->trigger_on_parse();
  const auto complete = [&app, print](const std::string& shell) {
    print(shell == "zsh" ? zsh_completion(app) : bash_completion(app));
  };
  app.add_option_function<std::string>("--completion", complete,
                                       "Print what completes the command line in this shell and exit")
      ->check(CLI::IsMember({"bash", "zsh"}))
      ->trigger_on_parse();
}

int parse_and_run(int argc, char** argv) {
  CLI::App app{"Low-drift monocular SLAM for indoor places with little texture", "sslam"};
  app.set_version_flag("--version", std::string("sslam ") + SSLAM_VERSION);
  app.footer(kFooter);
  app.require_subcommand(1);
  add_run_command(app);
  add_eval_command(app);
  add_normals_command(app);
  add_report_command(app);
  add_view_command(app);
  add_export_command(app);
  add_batch_command(app);
  add_calibrate_command(app);
  add_fetch_command(app);
  add_synth_command(app);
  add_demo_command(app);
  for (CLI::App* command : app.get_subcommands({})) command->footer(kFooter);
  add_self_description(app);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return report_parse_result(app, error);
  }
  return static_cast<int>(ExitCode::kOk);
}

// Throws Error when what was printed has not got to where it should, a full disk, say.
void demand_printed() {
  errno = 0;
  std::cout.flush();
  const bool printed = std::fflush(stdout) == 0 && std::ferror(stdout) == 0 && std::cout.good();
  if (printed) return;
  // A write that failed earlier has left no reason: one more has it.
  if (errno == 0 && write(STDOUT_FILENO, "\n", 1) >= 0) errno = EIO;
  throw Error(std::string("standard output: cannot write: ") + std::strerror(errno));
}

}  // namespace
}  // namespace sslam::cli

int sslam::run_program(int argc, char** argv) {
  using namespace sslam::cli;
  // What goes wrong in OpenCV, and below it in FFmpeg, comes back to us, and is told in one line.
  setenv("OPENCV_FFMPEG_LOGLEVEL", "-8", 0);
  if (std::getenv("OPENCV_LOG_LEVEL") == nullptr)
    cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
  try {
    end_with_parent();
    const int code = parse_and_run(argc, argv);
    if (code == static_cast<int>(ExitCode::kOk)) demand_printed();
    return code;
  } catch (const Stop& stop) {
    return static_cast<int>(stop.code);
  } catch (const cv::Exception& error) {  // its what() has several lines, and places in OpenCV's sources
    print_error("OpenCV could not do what it was asked to: " + error.err + " (in " + error.func + ")");
  } catch (const std::exception& error) {
    print_error(error.what());
  }
  return static_cast<int>(ExitCode::kFailed);
}
