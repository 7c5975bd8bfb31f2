// SPDX-License-Identifier: BSD-3-Clause
#include "cli/batch/plan.hpp"

#include <nlohmann/json.hpp>
#include <utility>

#include "cli/batch/suite_options.hpp"
#include "cli/results/eval_report.hpp"
#include "cli/results/json_file.hpp"

namespace sslam::cli {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

void plan_runs(const Suite& suite, const SuiteSequence& sequence, const SuiteMethod& method, Plan& plan) {
  const std::string folder = "runs/" + folder_name(sequence.name) + "/" + folder_name(method.name) + "/";
  for (const std::optional<std::int64_t>& start : starts_of(sequence)) {
    for (const std::uint64_t seed : method.seeds) {
      for (int repeat = 1; repeat <= method.repeats; ++repeat) {
        PlannedRun run{sequence.name,
                       method.name,
                       folder,
                       run_arguments(suite, sequence, method, seed, start),
                       sequence.name + ", " + method.name,
                       frames_file_of(sequence.name, start)};
        const auto add = [&run](const std::string& what, const std::string& number) {
          run.folder += (run.folder.ends_with('/') ? "" : "-") + what + "-" + number;
          run.title += ", " + what + " " + number;
        };
        if (start) add("start", std::to_string(*start));
        add("seed", std::to_string(seed));
        if (method.repeats > 1) add("repeat", std::to_string(repeat));
        plan.runs.push_back(std::move(run));
      }
    }
  }
}

Json run_json(const PlannedRun& run) {
  return {{"title", run.title},   {"sequence", run.sequence}, {"method", run.method},
          {"folder", run.folder}, {"frames", run.frames},     {"arguments", run.arguments}};
}

Plan plan_from(const Json& json) {
  Plan plan;
  plan.name = json.at("name");
  plan.min_tracked = json.at("min_tracked");
  plan.sequences = json.at("sequences");
  plan.methods = json.at("methods");
  plan.parts = json.at("parts");
  for (const Json& r : json.at("references"))
    plan.references.push_back({r.at("name"), r.at("min_tracked"), r.at("trajectories")});
  for (const Json& r : json.at("runs"))
    plan.runs.push_back({r.at("sequence"), r.at("method"), r.at("folder"), r.at("arguments"), r.at("title"),
                         r.value("frames", frames_file_of(r.at("sequence")))});
  return plan;
}

}  // namespace

std::string truth_file_of(const std::string& sequence) {
  return "sequences/" + folder_name(sequence) + "/groundtruth.txt";
}

std::string frames_file_of(const std::string& sequence, std::optional<std::int64_t> start) {
  return "sequences/" + folder_name(sequence) + "/frames" + (start ? "-from-" + std::to_string(*start) : "") +
         ".txt";
}

std::vector<std::string> run_arguments(const Suite& suite, const SuiteSequence& sequence,
                                       const SuiteMethod& method, std::uint64_t seed,
                                       std::optional<std::int64_t> start) {
  std::vector<std::string> arguments{"run",         sequence.dataset, "--preset",
                                     method.preset, "--seed",         std::to_string(seed)};
  const auto add = [&arguments](const std::string& option, const std::string& value) {
    arguments.push_back(option);
    arguments.push_back(value);
  };
  if (const std::string normals = normals_for(method, sequence); !normals.empty()) add("--normals", normals);
  for (const auto* options : {&sequence.options, &method.options})
    for (const SuiteOption& option : *options)
      if (std::string argument = argument_of(option); !argument.empty())
        arguments.push_back(std::move(argument));
  if (start) add("--start", std::to_string(*start));
  for (const std::string& text : method.set) add("--set", text);
  if (!suite.report) arguments.emplace_back("--no-report");
  return arguments;
}

std::vector<std::optional<std::int64_t>> starts_of(const SuiteSequence& sequence) {
  if (sequence.starts.empty()) return {std::nullopt};
  return {sequence.starts.begin(), sequence.starts.end()};
}

std::string normals_for(const SuiteMethod& method, const SuiteSequence& sequence) {
  constexpr std::string_view kPlaceholder = "{sequence}";
  std::string normals = method.normals;
  for (auto at = normals.find(kPlaceholder); at != std::string::npos; at = normals.find(kPlaceholder, at)) {
    normals.replace(at, kPlaceholder.size(), sequence.name);
    at += sequence.name.size();
  }
  return normals;
}

Plan make_plan(const Suite& suite) {
  Plan plan;
  plan.name = suite.name;
  plan.min_tracked = suite.min_tracked;
  plan.parts = {"."};
  for (const SuiteSequence& sequence : suite.sequences) plan.sequences.push_back(sequence.name);
  for (const SuiteMethod& method : suite.methods) plan.methods.push_back(method.name);
  for (const SuiteSequence& sequence : suite.sequences)
    for (const SuiteMethod& method : suite.methods) plan_runs(suite, sequence, method, plan);
  for (const SuiteReference& reference : suite.references) {
    PlannedReference planned{reference.name, reference.min_tracked, {}};
    for (const auto& [sequence, files] : reference.trajectories)
      for (std::size_t i = 0; i < files.size(); ++i)
        planned.trajectories[sequence].push_back("references/" + folder_name(reference.name) + "/" +
                                                 folder_name(sequence) + "-" + std::to_string(i + 1) +
                                                 ".txt");
    plan.references.push_back(std::move(planned));
  }
  return plan;
}

void write_plan(const fs::path& folder, const Plan& plan) {
  Json json = {{"name", plan.name},           {"min_tracked", plan.min_tracked},
               {"sequences", plan.sequences}, {"methods", plan.methods},
               {"parts", plan.parts},         {"references", Json::array()},
               {"runs", Json::array()}};
  for (const PlannedReference& r : plan.references)
    json["references"].push_back(
        {{"name", r.name}, {"min_tracked", r.min_tracked}, {"trajectories", r.trajectories}});
  for (const PlannedRun& run : plan.runs) json["runs"].push_back(run_json(run));
  write_json((folder / kPlanFile).string(), json);
}

Plan read_plan(const fs::path& folder) {
  const fs::path file = folder / kPlanFile;
  std::error_code ignored;
  if (!fs::is_directory(folder, ignored))
    throw Error(folder.string() + ": no such folder; expected one that `sslam batch` has written to");
  if (!fs::exists(file, ignored))
    throw Error(folder.string() + ": holds no " + kPlanFile +
                "; expected a folder that `sslam batch` has written to");
  try {
    return plan_from(read_json_object(file));
  } catch (const std::exception&) {
    throw Error(file.string() + ": is damaged; run the batch again: it keeps finished runs");
  }
}

}  // namespace sslam::cli
