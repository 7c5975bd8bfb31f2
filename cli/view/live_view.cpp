// SPDX-License-Identifier: BSD-3-Clause
#include "cli/view/live_view.hpp"

#include <cstdio>
#include <utility>

#include "cli/results/run_metrics.hpp"
#include "cli/shell/interrupt.hpp"
#include "cli/shell/messages.hpp"

namespace sslam::cli {

LiveView::LiveView(const RunContext& context, const FeatureColours& colours)
    : run_(folder_name(context.settings.out), settings_json(context), context.dataset.frames.size(),
           context.working_camera, colours),
      server_(context.settings.port, {[this] { return run_.page(); },
                                      [this](std::uint64_t version) { return run_.news(version); }}) {
  print_note("look at the run at " + server_.address());
}

void LiveView::show(std::string report) {
  run_.finish(std::move(report));
  const Interrupt interrupt;
  std::fflush(stdout);  // the summary
  print_note("the run is over; its report stays at " + server_.address() + " until Ctrl-C");
  wait_for(interrupt);
}

}  // namespace sslam::cli
