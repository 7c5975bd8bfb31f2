// SPDX-License-Identifier: BSD-3-Clause
// The program: parses the command line, runs one subcommand, turns whatever goes wrong into one line and an
// exit code.
#include "sslam/system/program.hpp"

#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <iostream>
#include <memory>
#include <new>
#include <opencv2/core.hpp>
#include <opencv2/core/utils/logger.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "cli/batch/child.hpp"
#include "cli/commands.hpp"
#include "cli/shell/completion.hpp"
#include "cli/shell/exit_code.hpp"
#include "cli/shell/help_formatter.hpp"
#include "cli/shell/man_page.hpp"
#include "cli/shell/messages.hpp"
#include "cli/shell/usage_text.hpp"
#include "sslam/core/closest_word.hpp"
#include "sslam/core/error.hpp"
#include "sslam/version.hpp"

namespace sslam::cli {
namespace {

constexpr const char* kFooter =
    "Exit codes: 0 success; 1 bad input, unwritable output or no result; 2 wrong command line; "
    "130 interrupted; the results until then were written.";

// What is typed and what comes of it, for --help.
struct Example {
  const char* command;
  const char* lines;
};
constexpr Example kExamples[] = {
    {"", "  sslam demo\n  sslam run DATASET --out results\n  sslam help run\n"},
    {"run",
     "  sslam run room --out results\n  sslam run walk.mp4 --camera phone.yaml\n"
     "  sslam run 0 --live --view --record walk\n  ffmpeg -i X -f image2pipe -c:v mjpeg - | sslam run - "
     "--fov 70\n"
     "  sslam run room --preset paper --set keyframes.max_turn=10\n  sslam run room --foxglove 8765\n"},
    {"eval", "  sslam eval groundtruth.txt trajectory.txt\n  sslam eval room results --plot compared.svg\n"},
    {"normals", "  sslam normals photo.jpg --out normals\n"},
    {"report", "  sslam report results\n  sslam report a b -o compare.html\n"},
    {"view", "  sslam view results\n  sslam view results/map.sslam\n"},
    {"export", "  sslam export results --format colmap --out model\n"},
    {"batch", "  sslam batch suite.toml --jobs 4\n"},
    {"calibrate", "  sslam calibrate photos --size 9x6 --out camera.yaml\n"},
    {"fetch", "  sslam fetch --help\n"},
    {"synth", "  sslam synth room --frames 120\n"},
    {"demo", "  sslam demo\n"},
};

std::string footer_of(std::string_view command) {
  for (const Example& example : kExamples)
    if (command == example.command) return std::string("Examples:\n") + example.lines + "\n" + kFooter;
  return kFooter;
}

// The deepest command that has been named.
const CLI::App& named_command(const CLI::App& app) {
  const std::vector<CLI::App*> named = app.get_subcommands();
  return named.empty() ? app : named_command(*named.front());
}

// A word that nobody knows, with the nearest one that somebody does; empty: there is none.
std::string unknown_word(const CLI::App& app) {
  const CLI::App& command = named_command(app);
  const std::vector<std::string> left = app.remaining(true);
  const auto is_option = [](const std::string& word) { return word.size() > 1 && word[0] == '-'; };
  // Of a command that nobody knows, the options are not known either.
  const bool no_command = &command == &app && !left.empty() && !is_option(left.front());
  const auto option = no_command ? left.end() : std::find_if(left.begin(), left.end(), is_option);
  const std::string full = &command == &app ? "sslam" : "sslam " + command.get_name();
  const auto meant = [](const std::string& word, const std::vector<std::string>& known) {
    const std::string nearest = closest_word(word, known);
    return nearest.empty() ? "" : "; did you mean '" + nearest + "'?";
  };
  std::vector<std::string> known;
  if (option != left.end()) {
    const std::string word = option->substr(0, option->find('='));
    for (const CLI::Option* o : command.get_options()) {
      for (const std::string& name : o->get_lnames()) known.push_back("--" + name);
      for (const std::string& name : o->get_snames()) known.push_back("-" + name);
    }
    return "'" + word + "' is not an option of " + full + meant(word, known);
  }
  if (left.empty()) return {};
  for (const CLI::App* sub : command.get_subcommands(nullptr)) known.push_back(sub->get_name());
  if (&command == &app) return "'" + left.front() + "' is not a command" + suggestion(left.front(), known);
  return "'" + left.front() + "' is one word too many for " + full + meant(left.front(), known);
}

// CLI11 prints help and version by itself; everything else becomes our one line.
int report_parse_result(const CLI::App& app, const CLI::ParseError& error) {
  if (error.get_exit_code() == 0) return app.exit(error);
  std::string text = error.what();
  const bool missing = dynamic_cast<const CLI::RequiredError*>(&error) != nullptr;
  if (missing || dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr)
    if (const std::string unknown = unknown_word(app); !unknown.empty()) text = unknown;
  print_error(usage_text(text) + " (see sslam --help)");
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
                                       "Print the completion script for this shell and exit")
      ->check(CLI::IsMember({"bash", "zsh"}))
      ->trigger_on_parse();
}

// `sslam help run` is `sslam run --help`.
std::vector<std::string> words_given(int argc, char** argv) {
  std::vector<std::string> words(argv + std::min(argc, 1), argv + argc);
  if (words.empty() || words.front() != "help") return words;
  words.erase(words.begin());
  words.emplace_back("--help");
  return words;
}

int parse_and_run(int argc, char** argv) {
  CLI::App app{"Low-drift monocular SLAM for indoor places with little texture", "sslam"};
  app.formatter(std::make_shared<HelpFormatter>());
  app.set_version_flag("--version", std::string("sslam ") + SSLAM_VERSION);
  app.footer(footer_of(""));
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
  for (CLI::App* command : app.get_subcommands({})) command->footer(footer_of(command->get_name()));
  add_self_description(app);
  std::vector<std::string> words = words_given(argc, argv);
  const auto is_command = [&app](const std::string& word) {
    const std::vector<const CLI::App*> all = std::as_const(app).get_subcommands(nullptr);
    return std::any_of(all.begin(), all.end(), [&](const CLI::App* each) { return each->check_name(word); });
  };
  const bool asks_for_help = argc > 1 && std::string_view(argv[1]) == "help" && words.size() > 1;
  if (asks_for_help && !is_command(words.front())) words.pop_back();  // which tells that there is none
  std::reverse(words.begin(), words.end());                           // as CLI11 takes them
  try {
    app.parse(std::move(words));
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
  if (errno == EPIPE) {  // as with `| head`: whoever read has seen enough, which is no error to tell
    std::signal(SIGPIPE, SIG_DFL);
    std::raise(SIGPIPE);
  }
  throw Error(std::string("standard output: cannot write: ") + std::strerror(errno));
}

// A reader that has gone, or a limit of a file's size, must not end a run before its files are written: the
// write fails, and that is told, or does not matter.
void hear_of_failed_writes() {
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
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
    hear_of_failed_writes();
    end_with_parent();
    const int code = parse_and_run(argc, argv);
    if (code == static_cast<int>(ExitCode::kOk)) demand_printed();
    return code;
  } catch (const Stop& stop) {
    return static_cast<int>(stop.code);
  } catch (const UsageError& error) {
    print_error(error.what());
    return static_cast<int>(ExitCode::kUsage);
  } catch (const cv::Exception& error) {  // its what() has several lines, and places in OpenCV's sources
    print_error("OpenCV failed: " + error.err + " (in " + error.func + ")");
  } catch (const std::bad_alloc&) {
    print_error("not enough memory; take smaller images or fewer frames, or raise the limit (ulimit -v)");
  } catch (const std::exception& error) {
    print_error(error.what());
  }
  return static_cast<int>(ExitCode::kFailed);
}
