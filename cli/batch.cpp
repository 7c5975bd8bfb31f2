// SPDX-License-Identifier: BSD-3-Clause
// `sslam batch SUITE.toml`: many sequences by many methods, and the tables of it.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <memory>
#include <optional>

#include "cli/batch/batch_folder.hpp"
#include "cli/batch/plan.hpp"
#include "cli/batch/run_batch.hpp"
#include "cli/batch/run_mark.hpp"
#include "cli/batch/suite_check.hpp"
#include "cli/batch/table_formats.hpp"
#include "cli/commands.hpp"
#include "cli/shell/exit_code.hpp"
#include "cli/shell/messages.hpp"
#include "sslam/io/files/output_file.hpp"

namespace sslam::cli {
namespace {

namespace fs = std::filesystem;

struct BatchOptions {
  std::string suite;
  std::string out;  // empty: as the suite says
  std::string shard;
  std::vector<std::string> against;
  int jobs = 0;
  bool list = false;
  Verbosity verbosity = Verbosity::kNormal;
};

struct MergeOptions {
  std::vector<std::string> folders;
  std::string out = "merged";
  std::vector<std::string> against;
};

// "2/8"
std::optional<Shard> parse_shard(const std::string& text) {
  const auto slash = text.find('/');
  if (slash == std::string::npos) return std::nullopt;
  const auto index = io::parse_number<int>(text.substr(0, slash));
  const auto count = io::parse_number<int>(text.substr(slash + 1));
  if (!index || !count || *index < 1 || *index > *count) return std::nullopt;
  return Shard{*index, *count};
}

void list_runs(const Plan& plan, const Shard& shard) {
  for (std::size_t i = 0; i < plan.runs.size(); ++i)
    if (shard.holds(i)) std::printf("%s\n", plan.runs[i].folder.c_str());
}

// Writes the tables of a folder and prints the first of them; the number of runs that are not done.
std::size_t write_results(const fs::path& folder, const std::vector<fs::path>& against) {
  const Results results = read_results(folder, against);
  const ResultPage page = make_page(results);
  write_tables(folder, results, page);
  std::fputs(markdown_page({page.title, {page.tables.front()}, {}, page.notes}).c_str(), stdout);
  std::printf(
      "\nwritten to       %s: tables.md, tables.tex, tables.html, table.csv, common_frames.csv, runs.csv\n",
      folder.c_str());
  return page.missing;
}

void run_suite(const BatchOptions& options) {
  Suite suite = read_suite(options.suite);
  const Shard shard = options.shard.empty() ? Shard{} : parse_shard(options.shard).value();
  const std::vector<SequenceFacts> facts = check_suite(suite);
  for (const std::string& earlier : options.against) {
    (void)read_plan(earlier);
    suite.against.emplace_back(earlier);
  }
  const Plan plan = make_plan(suite);
  if (options.list) return list_runs(plan, shard);

  BatchSettings settings;
  settings.folder = options.out.empty() ? suite.out : fs::path(options.out);
  if (!options.shard.empty()) settings.folder /= shard.folder();
  settings.shard = shard;
  settings.jobs = options.jobs;
  settings.verbosity = options.verbosity;
  const BatchFolder folder(settings.folder);
  folder.prepare(suite, plan, facts);
  const BatchOutcome outcome = run_batch(plan, settings);
  if (outcome.kept > 0 && options.verbosity != Verbosity::kQuiet)
    print_note(std::to_string(outcome.kept) + " runs were already finished and are kept");
  (void)write_results(settings.folder, suite.against);
  if (outcome.interrupted) {
    print_warning("interrupted; finished runs are kept, and the same command continues from there");
    throw Stop{ExitCode::kInterrupted};
  }
  if (outcome.broken > 0)
    throw Error(std::to_string(outcome.broken) + " of " + std::to_string(outcome.done + outcome.kept) +
                " runs failed unexpectedly; " + (settings.folder / "tables.md").string() +
                " says why, and their folders hold " + kLogFile);
}

void run_merge(const MergeOptions& options) {
  const std::vector<fs::path> folders(options.folders.begin(), options.folders.end());
  const fs::path out = options.out;
  const Plan plan = merge_plans(folders, out);
  const BatchFolder folder(out);
  write_plan(out, plan);
  const std::size_t missing = write_results(out, {options.against.begin(), options.against.end()});
  if (missing > 0)
    throw Error(std::to_string(missing) + " of " + std::to_string(plan.runs.size()) +
                " runs are in none of these folders; name all shards, or run the missing ones");
}

void add_merge_command(CLI::App& batch) {
  CLI::App* merge = batch.add_subcommand("merge", "Make the tables of all shards of a batch");
  auto options = std::make_shared<MergeOptions>();
  merge->add_option("FOLDERS", options->folders, "the shards' folders")->required()->type_name("DIR");
  merge->add_option("-o,--out", options->out, "folder for the tables")
      ->capture_default_str()
      ->type_name("DIR");
  merge
      ->add_option("--against", options->against,
                   "folder of an earlier batch to compare with; may be repeated")
      ->allow_extra_args(false)
      ->type_name("DIR");
  merge->callback([options] { run_merge(*options); });
}

}  // namespace

void add_batch_command(CLI::App& app) {
  CLI::App* batch = app.add_subcommand(
      "batch", "Run many sequences, presets and seeds in parallel, and make a table of the results");
  auto options = std::make_shared<BatchOptions>();
  CLI::Option* const suite =
      batch->add_option("SUITE", options->suite, "TOML file, see docs/batch.md")->type_name("FILE");
  batch
      ->add_option("-o,--out", options->out,
                   "folder for the results; default that of the suite, else SUITE_results. Complete runs "
                   "with the same settings are kept")
      ->type_name("DIR");
  batch
      ->add_option("--jobs", options->jobs,
                   "number of parallel runs, each on its own core; default one for each core")
      ->check(CLI::Range(1, 1024).description(""));
  batch->add_option("--shard", options->shard, "i/n: every n-th run, from the i-th on, into OUT/shard-i-of-n")
      ->check([](const std::string& text) {
        return parse_shard(text) ? std::string() : "'" + text + "' is not a part such as 2/8";
      });
  batch
      ->add_option("--against", options->against,
                   "folder of an earlier batch to compare with; may be repeated")
      ->allow_extra_args(false)
      ->type_name("DIR");
  batch->add_flag("--list", options->list, "check the suite, print the folder of each run, and stop");
  batch->add_flag_callback(
      "--quiet", [options] { options->verbosity = Verbosity::kQuiet; }, "no progress");
  batch->require_subcommand(0, 1);
  add_merge_command(*batch);
  batch->callback([batch, suite, options] {
    if (!batch->get_subcommands().empty()) return;
    if (suite->count() == 0) throw CLI::RequiredError("SUITE");
    run_suite(*options);
  });
}

}  // namespace sslam::cli
