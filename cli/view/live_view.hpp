// SPDX-License-Identifier: BSD-3-Clause
// `sslam run --view`: the report's page while the run goes on, then the report.
#pragma once

#include <string>

#include "cli/results/run_report.hpp"
#include "cli/view/live_run.hpp"
#include "cli/view/view_server.hpp"

namespace sslam::cli {

class LiveView {
 public:
  // Says where to look. Throws Error when the port cannot be had.
  LiveView(const RunContext& context, const FeatureColours& colours);

  [[nodiscard]] Observer& observer() noexcept { return run_; }

  // The run is over: shows its report until Ctrl-C.
  void show(std::string report);

 private:
  LiveRun run_;
  ViewServer server_;
};

}  // namespace sslam::cli
