// SPDX-License-Identifier: BSD-3-Clause
// How commands tell of their progress: for people, on a terminal and elsewhere, and for programs.
#include <pty.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "cli/room_copy.hpp"
#include "sslam/io/files/csv_reader.hpp"
#include "support/catch.hpp"

namespace progress_test {

namespace fs = std::filesystem;
using namespace sslam::testing;

namespace {

struct Streams {
  int code;
  std::string out, err;
};

// The two streams apart.
Streams run_apart(const std::string& arguments) {
  const ScratchFolder scratch;
  const fs::path err = scratch.path() / "err";
  const Outcome outcome = run_program(arguments + " 2>" + err.string() + " || exit $?; :");
  return {outcome.code, outcome.text, text_of(err)};
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

std::vector<nlohmann::json> events_of(const std::string& text) {
  std::vector<nlohmann::json> events;
  for (const std::string& line : lines_of(text)) events.push_back(nlohmann::json::parse(line));
  return events;
}

std::string track(const RoomCopy& copy, const std::string& options) {
  return "run " + copy.folder.string() + " --normals none --no-report --out " + copy.out.string() + " " +
         options;
}

void darken(const RoomCopy& copy, int from, int to) {
  for (int i = from; i < to; ++i) {
    char name[32];
    std::snprintf(name, sizeof name, "rgb/%06d.jpg", i);
    REQUIRE(cv::imwrite((copy.folder / name).string(), cv::Mat::zeros(360, 480, CV_8UC3)));
  }
}

// All that the program writes to a terminal of so many columns.
std::string on_terminal(const std::string& arguments, unsigned short columns) {
  winsize size{};
  size.ws_col = columns;
  size.ws_row = 24;
  int terminal = -1;
  const pid_t child = forkpty(&terminal, nullptr, nullptr, &size);
  REQUIRE(child >= 0);
  if (child == 0) {
    const std::string command = std::string(SSLAM_COMMAND) + " " + arguments;
    execl("/bin/sh", "sh", "-c", command.c_str(), static_cast<char*>(nullptr));
    _exit(127);
  }
  std::string text;
  std::array<char, 512> buffer{};
  for (ssize_t got = 0; (got = read(terminal, buffer.data(), buffer.size())) > 0;)
    text.append(buffer.data(), static_cast<std::size_t>(got));
  int status = 0;
  waitpid(child, &status, 0);
  close(terminal);
  REQUIRE(WIFEXITED(status));
  REQUIRE(WEXITSTATUS(status) == 0);
  return text;
}

}  // namespace

TEST_CASE("a program reads a run's progress as JSON, and its summary as ever") {
  const RoomCopy copy;
  fs::resize_file(copy.folder / "rgb/000030.jpg", 1000);
  const Streams plain = run_apart(track(copy, "--quiet")), told = run_apart(track(copy, "--json-progress"));
  INFO(told.err);
  REQUIRE(told.code == 0);
  const auto first = [](const std::string& text) { return text.substr(0, text.find('\n')); };
  REQUIRE(first(told.out) == first(plain.out));
  REQUIRE(plain.err.find("sslam: warning: ") == 0);
  const auto events = events_of(told.err);
  REQUIRE(events.front() == nlohmann::json{{"event", "start"}, {"task", "run"}, {"total", kFrames}});
  std::size_t frames = 0, keyframes = 0, warnings = 0;
  for (const auto& event : events) {
    if (event["event"] == "warning") {
      ++warnings;
      REQUIRE(event["text"].get<std::string>().find("000030.jpg: truncated image") != std::string::npos);
    }
    if (event["event"] != "frame") continue;
    REQUIRE(event["done"] == ++frames);
    REQUIRE(event["state"].is_string());
    REQUIRE(event["frame_ms"] > 0);
    keyframes += event["keyframe"].get<bool>() ? 1U : 0U;
  }
  REQUIRE(frames == kFrames - 1);
  REQUIRE(keyframes > 0);
  REQUIRE(warnings == 1);
  const auto end =
      std::find_if(events.begin(), events.end(), [](const auto& e) { return e["event"] == "end"; });
  REQUIRE(end != events.end());
  REQUIRE((*end)["done"] == frames);
}

TEST_CASE("a program reads what went wrong as JSON") {
  const Streams streams = run_apart("run /nowhere/at/all --json-progress");
  REQUIRE(streams.code == 1);
  REQUIRE(streams.out.empty());
  const auto events = events_of(streams.err);
  REQUIRE(events.size() == 1);
  REQUIRE(events[0]["event"] == "error");
  REQUIRE(events[0]["text"] == "/nowhere/at/all: no such file or folder");
  for (const char* other : {"--quiet", "--verbose"}) {
    const Streams both = run_apart(std::string("run /nowhere --json-progress ") + other);
    INFO(both.err);
    REQUIRE(both.code == 2);
    REQUIRE(events_of(both.err).at(0)["event"] == "error");
  }
}

TEST_CASE("verbose runs tell of each change of state and each keyframe, with the reason") {
  const RoomCopy copy;
  darken(copy, 30, 40);
  const Streams streams = run_apart(track(copy, "--verbose"));
  INFO(streams.err);
  REQUIRE(streams.code == 0);
  std::vector<std::string> problems;
  const auto table = sslam::io::read_csv(copy.out / "frames.csv", problems);
  const std::size_t state = table.column("state"), keyframe = table.column("keyframe");
  std::string_view last;
  std::size_t wanted = 0, told = 0;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    wanted += table.cell(row, state) != last || table.cell(row, keyframe) == "1" ? 1U : 0U;
    last = table.cell(row, state);
  }
  for (const std::string& line : lines_of(streams.err)) told += line.starts_with("frame ") ? 1U : 0U;
  REQUIRE(told == wanted);
  REQUIRE(streams.err.find("frame 0: initialising, ") != std::string::npos);
  REQUIRE(streams.err.find(" -> lost, too few ") != std::string::npos);
  REQUIRE(streams.err.find("frame 40: lost -> fallback, ") != std::string::npos);
  REQUIRE(streams.err.find("relocalised (") != std::string::npos);
}

TEST_CASE("a terminal shows one line that is written over and never wraps") {
  const RoomCopy copy;
  const std::string text = on_terminal(track(copy, "--end 40 >/dev/null"), 50);
  INFO(text);
  REQUIRE(text.find("\rrun 40/40 [############]") != std::string::npos);
  REQUIRE(std::count(text.begin(), text.end(), '\n') == 1);
  std::istringstream shown(text.substr(0, text.find('\n')));
  for (std::string line; std::getline(shown, line, '\r');)
    REQUIRE(line.size() <= 49 + std::string("\033[K").size());
  // Lines of events take the bar's place, and it comes back below.
  const std::string verbose = on_terminal(track(copy, "--end 40 --verbose >/dev/null"), 120);
  INFO(verbose);
  REQUIRE(verbose.find("\r\033[Kframe ") != std::string::npos);
  REQUIRE(verbose.find("]frame ") == std::string::npos);
}

TEST_CASE("without a terminal there are plain lines, and none where quiet is asked for") {
  const RoomCopy copy;
  const Streams plain = run_apart(track(copy, "--end 30")),
                quiet = run_apart(track(copy, "--end 30 --quiet"));
  REQUIRE(plain.err.find("run 30/30 [############]") != std::string::npos);
  REQUIRE(plain.err.find('\r') == std::string::npos);
  REQUIRE(quiet.err.empty());
  REQUIRE(quiet.out.find("tracked ") == 0);
}

TEST_CASE("a demo tells a program of both its parts") {
  const ScratchFolder scratch;
  const Streams streams =
      run_apart("demo " + (scratch.path() / "demo").string() + " --frames 30 --normals none --json-progress");
  INFO(streams.err);
  REQUIRE(streams.code == 0);
  std::vector<std::string> tasks;
  for (const auto& event : events_of(streams.err))
    if (event["event"] == "end") tasks.push_back(event["task"]);
  REQUIRE(tasks == std::vector<std::string>{"synth", "run"});
}

TEST_CASE("help fits the terminal, and the line of progress 80 columns elsewhere") {
  for (const unsigned short columns : {std::uint16_t{75}, std::uint16_t{100}}) {
    std::size_t longest = 0;
    for (const std::string& line : lines_of(on_terminal("run --help", columns)))
      longest = std::max(longest, line.find_last_not_of(" \r") + 1);
    INFO(longest);
    CHECK((longest > columns * 3U / 4 && longest <= columns));
  }
  const RoomCopy copy;
  for (const std::string& line : lines_of(run_apart(track(copy, "--end 20")).err))
    if (line.starts_with("run ")) CHECK(line.size() < 80);
}

}  // namespace progress_test
