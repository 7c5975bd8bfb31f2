// SPDX-License-Identifier: BSD-3-Clause
#include "cli/batch/run_mark.hpp"

#include <array>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <nlohmann/json.hpp>

#include "cli/results/eval_report.hpp"
#include "cli/results/json_file.hpp"
#include "cli/results/result_set.hpp"
#include "sslam/io/files/text.hpp"
#include "sslam/io/maps/checksum.hpp"
#include "sslam/version.hpp"

namespace sslam::cli {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* kMarkFile = "run.json";
constexpr std::array<const char*, 3> kEndNames{"tracked", "lost", "broken"};

Json read_object(const fs::path& file) {
  std::error_code ignored;
  if (!fs::is_regular_file(file, ignored)) return {};
  try {
    return read_json_object(file);
  } catch (const Error&) {
    return {};
  }
}

// Whether the files of a tracked run are there (somebody may have cleaned up since), and all of that run.
bool is_whole(const fs::path& run_folder) {
  settle_results(run_folder);
  std::error_code ignored;
  if (!fs::is_regular_file(run_folder / "trajectory.txt", ignored)) return false;
  const Json metrics = read_object(run_folder / "metrics.json");
  return metrics.is_object() && foreign_files(run_folder, metrics.value("files", Json())).empty();
}

// The error in the log, without what `sslam` puts in front of it; the last line where there is none.
std::string last_words(const fs::path& log) {
  constexpr std::string_view kPrefix = "sslam: error: ";
  std::error_code ignored;
  if (!fs::is_regular_file(log, ignored)) return "";
  std::string text = io::read_text(log);
  while (!text.empty() && text.back() == '\n') text.pop_back();
  // Standard output is written when the run ends, which may be behind the error.
  const auto error = text.rfind(kPrefix);
  if (error == std::string::npos) return text.substr(text.rfind('\n') + 1);
  const auto start = error + kPrefix.size();
  return text.substr(start, text.find('\n', start) - start);
}

// Whether there was anything to track.
bool saw_images(const Json& metrics) {
  const Json states = metrics.value("states", Json::object());
  int frames = 0;
  for (const auto& [state, count] : states.items()) frames += count.is_number() ? count.get<int>() : 0;
  return frames > 0;
}

}  // namespace

std::string program_fingerprint() {
  static const std::string fingerprint = [] {
    const std::uint64_t sum = io::checksum(io::read_text("/proc/self/exe"));
    char text[32];
    std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(sum));
    return std::string(SSLAM_VERSION) + "-" + text;
  }();
  return fingerprint;
}

void write_mark(const fs::path& run_folder, const RunMark& mark) {
  write_json((run_folder / kMarkFile).string(), {{"end", kEndNames[static_cast<std::size_t>(mark.end)]},
                                                 {"reason", mark.reason},
                                                 {"seconds", mark.seconds},
                                                 {"program", mark.program},
                                                 {"arguments", mark.arguments}});
}

std::optional<RunMark> read_mark(const fs::path& run_folder) {
  const Json json = read_object(run_folder / kMarkFile);
  RunMark mark;
  try {
    const std::string end = json.at("end");
    std::size_t i = 0;
    while (i < kEndNames.size() && end != kEndNames[i]) ++i;
    if (i == kEndNames.size()) return std::nullopt;
    mark = {static_cast<RunEnd>(i), json.at("reason"), json.at("seconds"), json.at("program"),
            json.at("arguments")};
  } catch (const Json::exception&) {
    return std::nullopt;
  }
  if (mark.end == RunEnd::kTracked && !is_whole(run_folder)) return std::nullopt;
  return mark;
}

RunMark judge_run(const fs::path& run_folder, int exit_code, int signal) {
  RunMark mark;
  const Json metrics = read_object(run_folder / "metrics.json");
  const std::string said = last_words(run_folder / kLogFile);
  const bool counted = metrics.contains("tracked") && metrics["tracked"].is_number();
  if (signal == 0 && exit_code == 0 && counted) {
    mark.end = RunEnd::kTracked;
  } else if (signal == 0 && exit_code == 1 && counted && metrics["tracked"] == 0 && saw_images(metrics)) {
    mark.end = RunEnd::kLost;
    mark.reason = said;
  } else if (signal != 0) {
    mark.reason = std::string("ended by signal ") + std::to_string(signal) + " (" + strsignal(signal) + ")";
  } else {
    mark.reason = said.empty() ? "exit code " + std::to_string(exit_code) : said;
  }
  return mark;
}

}  // namespace sslam::cli
