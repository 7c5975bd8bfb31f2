// SPDX-License-Identifier: BSD-3-Clause
// The report of a run as a file: what it is made from, and what becomes of damaged runs. report/ looks at it
// in a browser.
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "cli/page_data.hpp"
#include "cli/program.hpp"
#include "cli/report/base64.hpp"
#include "support/catch.hpp"
#include "support/scratch_folder.hpp"

namespace report_test {

namespace {

namespace fs = std::filesystem;
using sslam::testing::Outcome;
using sslam::testing::run_program;
using sslam::testing::ScratchFolder;
using sslam::testing::text_of;

struct Room {
  ScratchFolder scratch;
  fs::path folder = scratch.path() / "a</script><b>\"room";  // a name that would end a script element
  fs::path run = scratch.path() / "run";

  Room() {
    const Outcome made =
        run_program("synth '" + folder.string() + "' --quiet --frames 40 --seed 3 --size 480x360");
    if (made.code != 0) throw std::runtime_error(made.text);
  }
  [[nodiscard]] Outcome track(const std::string& options = "") const {
    return run_program("run '" + folder.string() + "' --quiet --normals none --out " + run.string() + " " +
                       options);
  }
  [[nodiscard]] Outcome report() const { return run_program("report " + run.string()); }
  [[nodiscard]] std::string page() const { return text_of(run / "report.html"); }
  // The page's data.
  [[nodiscard]] nlohmann::json data() const { return sslam::testing::page_data(run / "report.html"); }
  [[nodiscard]] std::size_t views() const {
    const std::string text = page();
    const auto from = text.find("<script id=\"views\"");
    std::size_t count = 0;
    for (auto at = text.find('\n', from) + 1; text[at] != '<'; at = text.find('\n', at) + 1) ++count;
    return count;
  }
};

void write(const fs::path& file, const std::string& text) {
  std::ofstream(file, std::ios::binary) << text;
}

}  // namespace

TEST_CASE("bytes as base64") {
  using sslam::cli::base64;
  CHECK(base64("") == "");
  CHECK(base64("f") == "Zg==");
  CHECK(base64("fo") == "Zm8=");
  CHECK(base64("foobar") == "Zm9vYmFy");
  CHECK(base64(std::string("\xff\x00\xfe", 3)) == "/wD+");
}

TEST_CASE("a run leaves a report, and its files give the same report again") {
  const Room room;
  REQUIRE(room.track().code == 0);
  const std::string first = room.page();
  CHECK(room.views() == 40);
  const auto data = room.data();
  CHECK(data["problems"].empty());
  CHECK(data["metrics"]["settings"]["dataset"] == room.folder.string());
  CHECK(data.contains("errors"));
  CHECK(data["coloured"] == true);
  CHECK(data["point_colours"]["base64"].get<std::string>().size() > 1000);
  const std::string colours = text_of(room.run / "colours.bin");
  CHECK(first.find("</script><b>") == std::string::npos);
  CHECK(first.find("script-src 'sha256-") != std::string::npos);  // nothing else runs in it
  const Outcome again = room.report();
  INFO(again.text);
  CHECK(again.code == 0);
  CHECK(room.page() == first);

  const std::string trajectory = text_of(room.run / "trajectory.txt"),
                    views = text_of(room.run / "views.bin");
  REQUIRE(room.track().code == 0);
  CHECK(text_of(room.run / "views.bin") == views);
  REQUIRE(room.track("--no-report").code == 0);
  CHECK_FALSE(fs::exists(room.run / "report.html"));
  CHECK_FALSE(fs::exists(room.run / "views.bin"));
  CHECK(text_of(room.run / "trajectory.txt") == trajectory);
  CHECK(text_of(room.run / "colours.bin") == colours);
  CHECK(room.report().code == 0);
  CHECK(room.views() == 0);
}

TEST_CASE("a run that tracked nothing leaves a report that says why") {
  const Room room;
  CHECK(room.track("--end 2").code == 1);
  CHECK(room.data()["metrics"]["tracked"] == 0);
  CHECK(room.data()["problems"].empty());
  CHECK(room.views() == 2);
  CHECK(room.report().code == 0);
}

TEST_CASE("a report of damaged files names each of them and shows the others") {
  const Room room;
  REQUIRE(room.track().code == 0);
  const auto cut = [&](const char* name, double share) {
    const auto size = static_cast<double>(fs::file_size(room.run / name));
    fs::resize_file(room.run / name, static_cast<std::uintmax_t>(share * size));
  };
  cut("frames.csv", 0.5);
  cut("views.bin", 0.5);
  cut("colours.bin", 0.5);
  cut("trajectory.txt", 0.98);
  fs::remove(room.run / "keyframes.txt");
  const Outcome outcome = room.report();
  INFO(outcome.text);
  CHECK(outcome.code == 0);
  for (const char* problem :
       {"frames.csv: line ", "views.bin: is cut off after ", "colours.bin: ends too early",
        "trajectory.txt: line ", "keyframes.txt: is missing"})
    CHECK(outcome.text.find(problem) != std::string::npos);
  CHECK(room.data()["problems"].size() >= 5);
  CHECK(room.views() > 10);
  CHECK(room.data()["coloured"] == false);
  cut("map.sslam", 0.5);
  const Outcome mapless = room.report();
  CHECK(mapless.code == 0);
  CHECK(mapless.text.find("map.sslam: holds ") != std::string::npos);
  // Numbers that are none, and members of other kinds than they should be.
  write(room.run / "metrics.json", R"({"tracked": "all", "trajectory": 7, "settings": {"dataset": []}})");
  CHECK(room.report().code == 0);
  write(room.run / "metrics.json", "{\"tracked\": 4");
  const Outcome without = room.report();
  CHECK(without.code == 0);
  CHECK(without.text.find("metrics.json: is no JSON object") != std::string::npos);
}

TEST_CASE("a report of what is no run is refused with one line") {
  const ScratchFolder scratch;
  const auto refused = [](const fs::path& folder, const std::string& what) {
    const Outcome outcome = run_program("report " + folder.string());
    INFO(outcome.text);
    CHECK(outcome.code == 1);
    CHECK(outcome.text.find("sslam: error: ") == 0);
    CHECK(outcome.text.find(what) != std::string::npos);
    CHECK(outcome.text.find('\n') == outcome.text.size() - 1);
  };
  refused(scratch.path() / "none", "none: no such folder; expected the one that");
  refused(scratch.path(), "holds no run that can be read (");
  write(scratch.path() / "file", "");
  refused(scratch.path() / "file", "file: is no folder");
  write(scratch.path() / "frames.csv", "");
  refused(scratch.path(), "holds no run that can be read (");
}

}  // namespace report_test
