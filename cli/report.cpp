// SPDX-License-Identifier: BSD-3-Clause
// `sslam report RUN`: makes the report of a run anew.
#include "cli/report.hpp"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <string>
#include <string_view>

#include "cli/base64.hpp"
#include "cli/commands.hpp"
#include "cli/messages.hpp"
#include "cli/report_data.hpp"
#include "cli/report_page.hpp"
#include "cli/run_folder.hpp"
#include "sslam/io/output_file.hpp"

namespace sslam::cli {
namespace {

// JSON that may stand inside a script element: no name in it can end the element.
std::string script_json(const nlohmann::ordered_json& data) {
  const std::string text = data.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
  std::string safe;
  safe.reserve(text.size());
  for (const char c : text) {
    if (c == '<')
      safe += "\\u003c";
    else
      safe += c;
  }
  return safe;
}

}  // namespace

std::string report_html(const nlohmann::ordered_json& data, const std::vector<std::string>& views) {
  const ReportPage page = report_page();
  std::string html(page.before_data);
  html += script_json(data);
  html += page.before_views;
  for (const std::string& view : choose_views(views)) html += base64(view) + '\n';
  return html += page.after_views;
}

std::string report_of(const std::filesystem::path& folder) {
  RunFolder run = read_run_folder(folder);
  const nlohmann::ordered_json data = report_data(run);
  print_warnings(run.problems);
  return report_html(data, run.views);
}

void write_report(const std::filesystem::path& folder, const std::string& page) {
  io::write_text(folder / kReportFile, page);
}

void add_report_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("report", "Make report.html of a run anew, from the run's files");
  auto folder = std::make_shared<std::string>();
  command->add_option("run", *folder, "Folder that `sslam run --out` has written to")->required();
  command->callback([folder] {
    write_report(*folder, report_of(*folder));
    std::printf("written to       %s\n", (std::filesystem::path(*folder) / kReportFile).c_str());
  });
}

}  // namespace sslam::cli
