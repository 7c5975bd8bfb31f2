// SPDX-License-Identifier: BSD-3-Clause
// The subcommands of `sslam`: each adds itself, with its options and its callback, to the application.
#pragma once

namespace CLI {
class App;
}

namespace sslam::cli {

void add_run_command(CLI::App& app);        // run.cpp
void add_eval_command(CLI::App& app);       // eval.cpp
void add_synth_command(CLI::App& app);      // synth.cpp
void add_normals_command(CLI::App& app);    // normals.cpp
void add_report_command(CLI::App& app);     // report.cpp
void add_view_command(CLI::App& app);       // view.cpp
void add_export_command(CLI::App& app);     // export.cpp
void add_batch_command(CLI::App& app);      // batch.cpp
void add_calibrate_command(CLI::App& app);  // calibrate.cpp
void add_fetch_command(CLI::App& app);      // fetch.cpp
void add_demo_command(CLI::App& app);       // demo.cpp

}  // namespace sslam::cli
