// SPDX-License-Identifier: BSD-3-Clause
#include "cli/live_view.hpp"

#include <cstdio>

#include "cli/interrupt.hpp"
#include "cli/messages.hpp"
#include "cli/report.hpp"
#include "cli/report_data.hpp"

namespace sslam::cli {

LiveView::LiveView(const RunContext& context)
    : folder_(context.settings.out),
      run_(folder_name(folder_), settings_json(context), context.dataset.frames.size()),
      server_(context.settings.port, {[this] { return run_.page(); },
                                      [this](std::uint64_t version) { return run_.news(version); }}) {
  print_note("look at the run at " + server_.address());
}

void LiveView::show_report() {
  RunFolder run = read_run_folder(folder_);
  const nlohmann::ordered_json data = report_data(run);
  run_.finish(report_html(data, run.views));
  const Interrupt interrupt;
  std::fflush(stdout);  // the summary
  print_note("the run is over; its report stays at " + server_.address() + " until Ctrl-C");
  wait_for(interrupt);
}

}  // namespace sslam::cli
