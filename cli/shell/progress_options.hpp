// SPDX-License-Identifier: BSD-3-Clause
// How a command tells of its progress: --quiet, --verbose or --json-progress.
#pragma once

#include <CLI/CLI.hpp>

#include "cli/shell/messages.hpp"
#include "cli/shell/progress.hpp"

namespace sslam::cli {

// The verbosity must live until the application has been parsed. tracks: the command has states and keyframes
// to tell of.
inline void add_progress_options(CLI::App& command, Verbosity& verbosity, bool tracks) {
  const auto be = [&verbosity](Verbosity wanted) { return [&verbosity, wanted] { verbosity = wanted; }; };
  CLI::Option* const quiet = command.add_flag_callback("--quiet", be(Verbosity::kQuiet), "No progress");
  const auto be_json = [&verbosity] {
    verbosity = Verbosity::kJson;
    set_message_form(MessageForm::kJson);
  };
  CLI::Option* const json =
      command
          .add_flag_callback("--json-progress", be_json,
                             "Progress and messages on standard error as JSON, one object a line")
          ->excludes(quiet);
  if (!tracks) return;
  command
      .add_flag_callback("-v,--verbose", be(Verbosity::kVerbose),
                         "A line for each change of state, loss and keyframe, with the reason")
      ->excludes(quiet)
      ->excludes(json);
}

}  // namespace sslam::cli
