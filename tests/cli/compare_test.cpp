// SPDX-License-Identifier: BSD-3-Clause
// `sslam report A B`: several runs on one page. report/ looks at it in a browser.
#include <cmath>
#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "cli/page_data.hpp"
#include "cli/room_copy.hpp"
#include "support/catch.hpp"

namespace compare_test {

namespace {

namespace fs = std::filesystem;
using namespace sslam::testing;

// A room that was tracked twice, into a and into b.
struct TwoRuns : RoomCopy {
  fs::path a = scratch.path() / "a", b = scratch.path() / "b", page = scratch.path() / "pages/compare.html";

  explicit TwoRuns(bool with_truth = true) {
    if (!with_truth) fs::remove(folder / "groundtruth.txt");
    track(a, "--no-report");
    track(b, "--preset points");
    fs::create_directory(page.parent_path());
  }
  void track(const fs::path& to, const std::string& options) const {
    const Outcome outcome = run_program("run " + folder.string() + " --quiet --normals none --out " +
                                        to.string() + " " + options);
    INFO(outcome.text);
    REQUIRE(outcome.code == 0);
  }
  [[nodiscard]] Outcome compare(const std::string& others = "") const {
    return run_program("report " + a.string() + " " + b.string() + " " + others + " -o " + page.string());
  }
  [[nodiscard]] nlohmann::json metrics_of(const fs::path& run) const {
    return nlohmann::json::parse(text_of(run / "metrics.json"));
  }
};

}  // namespace

TEST_CASE("report of two runs lays their paths over the ground truth, with the errors that each run told") {
  const TwoRuns runs;
  const Outcome outcome = runs.compare();
  INFO(outcome.text);
  REQUIRE(outcome.code == 0);
  CHECK(outcome.text.find("written to       " + runs.page.string()) != std::string::npos);
  const auto data = page_data(runs.page);
  CHECK(data["reference"] == "truth");
  CHECK(data["unit"] == "m");
  REQUIRE(data["runs"].size() == 2);
  const std::vector<float> truth = floats_of(data["truth"]["positions"]);
  for (std::size_t i = 0; i < 2; ++i) {
    const auto& run = data["runs"][i];
    const auto told = runs.metrics_of(i == 0 ? runs.a : runs.b)["trajectory"];
    CHECK(run["label"] == (i == 0 ? "a" : "b"));
    CHECK(run["figures"]["position"]["rmse"].get<double>() ==
          Approx(told["ate_m"]["rmse"].get<double>()).epsilon(1e-6));
    CHECK(run["figures"]["rotation"]["rmse"].get<double>() ==
          Approx(told["rotation_own_offset_deg"]["rmse"].get<double>()).epsilon(1e-6));
    // Frame by frame, the path is as far from the truth as the errors say.
    const std::vector<float> path = floats_of(run["path"]), errors = floats_of(run["errors"]["position_m"]);
    REQUIRE(path.size() == 3 * kFrames);
    REQUIRE(truth.size() == path.size());
    std::size_t seen = 0;
    for (std::size_t row = 0; row < kFrames; ++row) {
      if (std::isnan(path[3 * row])) continue;
      ++seen;
      double squared = 0;
      for (std::size_t k = 3 * row; k < 3 * row + 3; ++k) squared += std::pow(path[k] - truth[k], 2);
      CHECK(std::abs(std::sqrt(squared) - errors[row]) < 1e-5);
    }
    CHECK(seen > 50);
    CHECK(run["metrics"]["times"]["processor_seconds"].get<double>() > 0);
  }
  CHECK(data["runs"][0]["link"] == "");  // it has no report
  CHECK(data["runs"][1]["link"] == "../b/report.html");
  const std::string first = text_of(runs.page);
  REQUIRE(runs.compare().code == 0);
  CHECK(text_of(runs.page) == first);
}

TEST_CASE("report of two runs without ground truth lays the second over the first") {
  const TwoRuns runs(false);
  REQUIRE(runs.compare().code == 0);
  const auto data = page_data(runs.page);
  CHECK(data["reference"] == "run");
  CHECK(data["reference_label"] == "a");
  CHECK(data["unit"] == "map units");
  CHECK_FALSE(data.contains("truth"));
  CHECK_FALSE(data["runs"][0].contains("figures"));
  const std::vector<float> a = floats_of(data["runs"][0]["path"]), b = floats_of(data["runs"][1]["path"]);
  double length = 0, apart = 0;
  std::size_t last = 0;
  for (std::size_t row = 0; row < kFrames; ++row) {
    if (std::isnan(a[3 * row]) || std::isnan(b[3 * row])) continue;
    double step = 0, gap = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      step += std::pow(a[3 * row + k] - a[3 * last + k], 2);
      gap += std::pow(a[3 * row + k] - b[3 * row + k], 2);
    }
    if (row > 0 && !std::isnan(a[3 * last])) length += std::sqrt(step);
    apart = std::max(apart, std::sqrt(gap));
    last = row;
  }
  CHECK(apart < 0.05 * length);
  CHECK(data["runs"][1]["figures"]["position"]["max"].get<double>() == Approx(apart).epsilon(1e-3));
}

TEST_CASE("report shows a run that tracked nothing beside others") {
  const TwoRuns runs;
  const fs::path none = runs.scratch.path() / "none";
  REQUIRE(
      run_program("run " + runs.folder.string() + " --quiet --normals none --end 3 --out " + none.string())
          .code == 1);
  const Outcome outcome = runs.compare(none.string());
  INFO(outcome.text);
  REQUIRE(outcome.code == 0);
  const auto data = page_data(runs.page);
  CHECK(data["runs"][2]["metrics"]["tracked"] == 0);
  CHECK_FALSE(data["runs"][2].contains("path"));
}

TEST_CASE("report refuses runs that cannot be compared, and writes nothing") {
  const TwoRuns runs;
  const fs::path other = runs.scratch.path() / "other", later = runs.scratch.path() / "later";
  require_refused(runs.compare(runs.a.string() + "/."), "is named twice");
  require_refused(runs.compare(other.string()), "other: no such folder");
  // The same stamps, another path.
  REQUIRE(run_program("synth " + other.string() + "_room --quiet --frames 5 --seed 4 --size 64x48").code ==
          0);
  (void)run_program("run " + other.string() + "_room --quiet --normals none --out " + other.string());
  require_refused(runs.compare(other.string()),
                  "other: has a different ground truth from " + runs.a.string());
  fs::remove(other / "groundtruth.txt");
  require_refused(runs.compare(other.string()), "other: is a run of " + other.string() + "_room, ");
  (void)run_program("run " + runs.folder.string() + " --quiet --normals none --start 56 --out " +
                    later.string());
  const fs::path brief = runs.scratch.path() / "brief";
  (void)run_program("run " + runs.folder.string() + " --quiet --normals none --start 58 --out " +
                    brief.string());
  require_refused(runs.compare(brief.string()), "brief: has fewer than 3 frames to compare");
  const fs::path early = runs.scratch.path() / "early";
  (void)run_program("run " + runs.folder.string() + " --quiet --normals none --end 4 --out " +
                    early.string());
  require_refused(
      run_program("report " + early.string() + " " + later.string() + " -o " + runs.page.string()),
      "later: has no frames of the same times (stamps ");
  CHECK_FALSE(fs::exists(runs.page));
}

TEST_CASE("report -o writes the report of one run elsewhere") {
  const TwoRuns runs;
  REQUIRE(run_program("report " + runs.b.string() + " -o " + runs.page.string()).code == 0);
  CHECK(text_of(runs.page) == text_of(runs.b / "report.html"));
  CHECK_FALSE(fs::exists(runs.a / "report.html"));
}

}  // namespace compare_test
