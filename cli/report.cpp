// SPDX-License-Identifier: BSD-3-Clause
// `sslam report RUN...`: makes the report of a run anew, or a page that compares several.
#include "cli/report.hpp"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "cli/commands.hpp"
#include "cli/report/base64.hpp"
#include "cli/report/comparison.hpp"
#include "cli/report/report_data.hpp"
#include "cli/report/report_page.hpp"
#include "cli/results/run_folder.hpp"
#include "cli/shell/json_text.hpp"
#include "cli/shell/messages.hpp"
#include "sslam/io/files/output_file.hpp"

namespace sslam::cli {
namespace {

// JSON that may stand inside a script element: no name in it can end the element.
void append_script_json(const nlohmann::ordered_json& data, std::string& html) {
  const std::string text = json_text(data);
  for (const char c : text) {
    if (c == '<')
      html += "\\u003c";
    else
      html += c;
  }
}

}  // namespace

std::string report_html(const nlohmann::ordered_json& data, const std::vector<std::string>& views) {
  const ReportPage page = report_page();
  std::string html(page.before_data);
  append_script_json(data, html);
  html += page.before_views;
  const std::vector<std::string_view> chosen = choose_views(views, html.size() + page.after_views.size());
  std::size_t size = html.size() + page.after_views.size();
  for (const std::string_view view : chosen) size += base64_size(view.size()) + 1;
  html.reserve(size);  // megabytes, of which doubling would ask for up to three times as many
  for (const std::string_view view : chosen) html += base64(view) + '\n';
  return html += page.after_views;
}

std::string report_of(const std::filesystem::path& folder, const std::string& name) {
  RunFolder run = read_run_folder(folder);
  if (!name.empty()) run.name = name;
  const nlohmann::ordered_json data = report_data(run);
  print_warnings(run.problems);
  const std::vector<std::string> views = std::move(run.views);
  run = {};  // the rest is in the data now
  return report_html(data, views);
}

void write_report(const std::filesystem::path& folder, const std::string& page) {
  io::write_text(folder / kReportFile, page);
}

namespace {

constexpr const char* kCompareFile = "compare.html";

std::string comparison_html(const std::vector<std::filesystem::path>& folders,
                            const std::filesystem::path& file) {
  const Comparison comparison = compare_runs(folders, file);
  print_warnings(comparison.warnings);
  const ComparePage page = compare_page();
  std::string html(page.before_data);
  append_script_json(comparison.data, html);
  return html += page.after_data;
}

// out: empty for where such a page usually goes.
void report(const std::vector<std::filesystem::path>& folders, std::filesystem::path out) {
  const bool single = folders.size() == 1;
  if (out.empty()) out = single ? folders.front() / kReportFile : std::filesystem::path(kCompareFile);
  io::write_text(out, single ? report_of(folders.front()) : comparison_html(folders, out));
  std::printf("written to       %s\n", out.c_str());
}

}  // namespace

void add_report_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "report", "Write report.html of a run again from its files, or compare several runs on one page");
  struct Settings {
    std::vector<std::filesystem::path> folders;
    std::filesystem::path out;
  };
  auto s = std::make_shared<Settings>();
  command
      ->add_option("run", s->folders,
                   "Folder that `sslam run --out` has written to; of several, one page compares the runs")
      ->required();
  command
      ->add_option("-o,--out", s->out,
                   "The page; default report.html in the run's folder, compare.html here for several runs")
      ->type_name("FILE");
  command->callback([s] { report(s->folders, s->out); });
}

}  // namespace sslam::cli
