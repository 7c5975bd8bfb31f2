// SPDX-License-Identifier: BSD-3-Clause
// Options in a file: what is read, and what is said about what cannot be.
#include "cli/shell/config_file.hpp"

#include <map>
#include <string>
#include <vector>

#include "cli/shell/choice_option.hpp"
#include "io/errors.hpp"
#include "support/catch.hpp"
#include "support/scratch_folder.hpp"

namespace config_file_test {

using namespace sslam;
using testing::contains;

namespace {

// A command with an option of each kind.
struct Command {
  testing::ScratchFolder scratch;
  CLI::App app{"", "sslam"};
  int end = -1, level = 0;
  double fps = 30;
  bool live = false;
  std::string out, port;
  std::vector<std::string> set, topics;
  std::map<std::string, std::string> places;
  const std::map<std::string, int> levels{{"low", 1}, {"high", 2}};

  Command() {
    CLI::App* const run = app.add_subcommand("run", "");
    cli::add_config_option(*run, &places);
    run->add_option("--end", end, "");
    run->add_option("--fps", fps, "")->check(CLI::PositiveNumber);
    run->add_flag("--live", live, "");
    run->add_option("--out", out, "")->type_name("DIR");
    run->add_option("--foxglove", port, "")->type_name("PORT");
    run->add_option("--topics", topics, "");
    run->add_option("--undistort-fov", fps, "")->type_name("DEGREES");
    run->add_option("--set", set, "");
    cli::add_choice(*run, "--level", level, levels, "");
  }

  // The message, without the file's name; empty: none.
  std::string read(const std::string& text, const std::string& words = {}) {
    const std::string file = scratch.write("run.toml", text).string();
    const std::string message = testing::error_of([&] { app.parse("run --config " + file + " " + words); });
    return message.starts_with(file + ": ") ? message.substr(file.size() + 2) : message;
  }
};

}  // namespace

TEST_CASE("options in a file: each kind of value, and the command line wins") {
  Command command;
  CHECK(command
            .read("end = 40\nfps = 12.5\nlive = true\nout = \"a b\"\nfoxglove = 8765\nlevel = \"high\"\n"
                  "topics = [\"a\", \"b\"]\n[set]\nkeyframes.max_turn = 9\nkeyframes.min_gap = 0.25\n",
                  "--set keyframes.max_turn=10")
            .empty());
  CHECK(command.end == 40);
  CHECK(command.fps == 12.5);
  CHECK(command.live);
  CHECK(command.out == "a b");
  CHECK(command.port == "8765");
  CHECK(command.level == 2);
  CHECK(command.topics == std::vector<std::string>{"a", "b"});
  REQUIRE(command.set.size() == 3);
  CHECK(command.places.size() == 2);
  CHECK(command.places["keyframes.max_turn=9"].ends_with("run.toml: line 9: "));
  CHECK(command.set.back() == "keyframes.max_turn=10");
  Command other;
  CHECK(other.read("end = 40\nlive = false\nfps = 12\n", "--end 3").empty());
  CHECK(other.end == 3);
  CHECK_FALSE(other.live);
  CHECK(other.fps == 12);
}

TEST_CASE("options in a file: a value of a wrong type names line, key, what was found and what is right") {
  const std::vector<std::pair<const char*, const char*>> cases{
      {"\nend = \"many\"\n", "line 2: end is the text \"many\"; expected a whole number"},
      {"end = \"4\"\n", "line 1: end is the text \"4\"; expected a whole number"},
      {"end = 4.5\n", "line 1: end is the number 4.5; expected a whole number"},
      {"end = true\n", "line 1: end is true; expected a whole number"},
      {"end = [1, 2]\n", "line 1: end is a list; expected a whole number"},
      {"end = 2024-05-01\n", "line 1: end is a date or a time; expected a whole number"},
      {"fps = \"fast\"\n", "line 1: fps is the text \"fast\"; expected a number"},
      {"live = \"yes\"\n", "line 1: live is the text \"yes\"; expected true or false"},
      {"live = 1\n", "line 1: live is the number 1; expected true or false"},
      {"out = 5\n", "line 1: out is the number 5; expected text in quotes"},
      {"out = true\n", "line 1: out is true; expected text in quotes"},
      {"out = \"\"\n", "line 1: out is empty"},
      {"out = {a = 1}\n", "line 1: out is a table; expected text in quotes"},
      {"level = 2\n", "line 1: level is the number 2; expected text in quotes"},
      {"topics = [\"a\", 3]\n", "line 1: topics is the number 3; expected text in quotes"},
      {"set = \"a.b=1\"\n", "line 1: set is the text \"a.b=1\"; expected a table: [set] with rows"},
      {"[set]\na.b = \"x\"\n", "line 2: set.a.b is the text \"x\"; expected a number"},
      {"[set]\na.b = [1, 2]\n", "line 2: set.a.b is a list; expected a number"}};
  for (const auto& [text, message] : cases) {
    INFO(text);
    CHECK(contains(Command().read(text), message));
  }
  CHECK(Command().read("end = 1e2\n").empty());
}

TEST_CASE("options in a file: values that an option refuses, unknown keys, and what is no TOML") {
  const std::vector<std::pair<const char*, const char*>> cases{
      {"fps = -3\n", "line 1: fps: "},
      {"level = \"hihg\"\n", "line 1: level: 'hihg' is not one of high, low"},
      {"\nennd = 4\n", "line 2: 'ennd' is not an option of sslam run; did you mean 'end'?"},
      {"undistort_fov = 90\n", "did you mean 'undistort-fov'?"},
      {"[sett]\na.b = 1\n",
       "line 1: 'sett' is not an option of sslam run; the only table is [set], for parameters; did you mean "
       "'set'?"},
      {"a.b = 1\n", "the only table is [set], for parameters"},
      {"[run]\nend = 1\n", "line 1: 'run' is not an option of sslam run; the only table is [set]"},
      {"config = \"x\"\n", "line 1: config: a file of options cannot name another one"},
      {"help = true\n", "line 1: 'help' is not an option"},
      {"end = \n", "line 1: is not TOML: "},
      {"out = none\n", "line 1: is not TOML: "},
      {"end: 3\n", "line 1: is not TOML: "},
      {"end = 3\nend = 4\n", "line 2: is not TOML: "}};
  for (const auto& [text, message] : cases) {
    INFO(text);
    const std::string said = Command().read(text);
    INFO(said);
    CHECK(contains(said, message));
    CHECK(testing::is_one_line(said));
  }
}

}  // namespace config_file_test
