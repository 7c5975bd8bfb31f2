// SPDX-License-Identifier: BSD-3-Clause
// Files that mean harm, and folders that others have been in: one line, and nothing lost.
#include <filesystem>
#include <string>

#include "cli/results/folder_lock.hpp"
#include "cli/room_copy.hpp"
#include "cli/shell/toml_text.hpp"

namespace hostile_test {

namespace fs = std::filesystem;
using namespace sslam::testing;

namespace {

std::string many(const std::string& part, std::size_t times) {
  std::string text;
  for (std::size_t i = 0; i < times; ++i) text += part;
  return text;
}

}  // namespace

TEST_CASE("dots of a TOML key are counted outside of strings and comments") {
  using sslam::cli::toml_detail::most_dots;
  CHECK(most_dots("a.b.c = 1.5") == 2);
  CHECK(most_dots("a = [1.5, 2.5, 3.5, 4.5]\nb = 0.5") == 1);
  CHECK(most_dots("a = \"../../..\" # and ...\nb = 'c.d.e'") == 0);
  CHECK(most_dots("a = \"\"\"\n...\"...\n\"\"\"\nb.c = 1") == 1);
  CHECK(most_dots("a = '''\n...'...\n'''\nb.c = 1") == 1);
  CHECK(most_dots("a = \"\\\"...\"") == 0);
  CHECK(most_dots("\"a.b\".'c'.d = 1") == 2);
  CHECK(most_dots("[a.b.c.d]") == 3);
  CHECK(most_dots("a = \"not closed\n...") == 3);
  CHECK(most_dots("a = '''never closed ...") == 0);
}

TEST_CASE("a TOML file that is deep is refused with one line") {
  const ScratchFolder scratch;
  const auto file = [&](const std::string& text) { return scratch.write("deep.toml", text).string(); };
  const std::string dotted = many("a.", 100000) + "a";
  require_refused(run_program("batch " + file(dotted + " = 1")), "deep.toml: a key has more than 17 parts");
  require_refused(run_program("batch " + file("[" + dotted + "]")),
                  "deep.toml: a key has more than 17 parts");
  require_refused(run_program("run nowhere --config " + file(dotted + " = 1")), "deep.toml: a key has more");
  require_refused(run_program("batch " + file("a = " + many("[", 100000) + "\n")), "deep.toml");
  require_refused(run_program("batch " + file("a = " + many("{b = ", 100000) + "\n")), "deep.toml");
}

TEST_CASE("a run whose numbers are nested without end is refused with one line") {
  const ScratchFolder scratch;
  scratch.write("metrics.json", "{\"tracked\": " + many("[", 100000) + many("]", 100000) + "}");
  require_refused(run_program("report " + scratch.path().string()),
                  "metrics.json: is nested more than 64 levels deep");
}

TEST_CASE("what cannot be printed is an error") {
  for (const char* arguments : {"--help", "--version", "run --list-parameters"}) {
    const Outcome outcome = run_command(std::string(SSLAM_COMMAND) + " " + arguments + " 2>&1 >/dev/full");
    INFO(arguments << ": " << outcome.text);
    CHECK(outcome.code == 1);
    CHECK(outcome.text == "sslam: error: standard output: cannot write: No space left on device\n");
  }
}

TEST_CASE("a name with line breaks gives a message of one line") {
  const Outcome outcome = run_program("report 'no\nsuch\033[1mfolder'");
  INFO(outcome.text);
  CHECK(outcome.code == 1);
  CHECK(outcome.text.find("no?such?[1mfolder: no such folder") != std::string::npos);
}

TEST_CASE("a name that is not UTF-8 costs no results") {
  const ScratchFolder scratch;
  std::string poses;
  for (int i = 0; i < 5; ++i) poses += std::to_string(i) + " " + std::to_string(i * i) + " 1 2 0 0 0 1\n";
  const std::string file = scratch.write("caf\xe9.txt", poses).string();
  const fs::path json = scratch.path() / "eval.json";
  const Outcome outcome = run_program("eval " + file + " " + file + " --json " + json.string());
  INFO(outcome.text);
  REQUIRE(outcome.code == 0);
  CHECK(nlohmann::json::parse(text_of(json)).dump().find("caf\xef\xbf\xbd.txt") != std::string::npos);
}

TEST_CASE("two runs into one folder: the second is told") {
  const RoomCopy copy;
  fs::create_directories(copy.out);
  const auto first = sslam::cli::FolderLock::demand(copy.out);
  require_refused(copy.run("--end 2"), "out: another sslam is writing its results into this folder");
  CHECK(fs::is_empty(copy.out));
}

TEST_CASE("files of two runs in one folder are recognised by all who read it") {
  const RoomCopy copy;
  REQUIRE(copy.run("--end 40").code == 0);
  CHECK_FALSE(fs::exists(copy.out / ".sslam-new"));
  CHECK_FALSE(fs::exists(copy.out / ".sslam-ready"));
  const fs::path first = copy.scratch.path() / "first";
  fs::copy(copy.out, first);
  REQUIRE(copy.run().code == 0);
  const std::string out = copy.out.string(),
                    what = ": is not the file that belongs to metrics.json beside it";
  CHECK(run_program("report " + out).text.find(what) == std::string::npos);
  for (const char* name : {"map.sslam", "keyframes.txt"})
    fs::copy_file(first / name, copy.out / name, fs::copy_options::overwrite_existing);
  for (const std::string command : {"report ", "export --format tum "}) {
    const Outcome outcome = run_program(command + out);
    INFO(outcome.text);
    CHECK(outcome.code == 0);
    for (const std::string name : {"map.sslam", "keyframes.txt"})
      CHECK(outcome.text.find(name + what) != std::string::npos);
    CHECK(outcome.text.find("trajectory.txt" + what) == std::string::npos);
  }
  const Outcome goes_on =
      run_program("run " + copy.folder.string() + " --quiet --normals none --end 40 --map " + out +
                  "/map.sslam --out " + (copy.scratch.path() / "further").string());
  INFO(goes_on.text);
  CHECK(goes_on.code == 0);
  CHECK(goes_on.text.find("map.sslam" + what) != std::string::npos);
}

}  // namespace hostile_test
