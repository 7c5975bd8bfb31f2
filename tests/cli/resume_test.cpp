// SPDX-License-Identifier: BSD-3-Clause
// Checkpoints of a run, and `sslam run --resume`, which goes on from one.
#include <algorithm>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "cli/room_copy.hpp"
#include "support/catch.hpp"

namespace resume_test {

namespace fs = std::filesystem;
using namespace sslam::testing;

namespace {

constexpr const char* kEachFrame = " --no-report --checkpoint 1e-6";
constexpr const char* kCheckpoint = ".sslam-checkpoint";

// Killed behind the frame of this number, so that the checkpoint is that of this frame or the next ones.
void kill_run(const RoomCopy& copy, int frame) {
  const std::string event = "\"done\":" + std::to_string(frame) + ",";
  const Outcome killed = interrupt_program(
      "run " + copy.folder.string() + " --out " + copy.out.string() + " --normals none" + kEachFrame, event,
      SIGKILL);
  INFO(killed.text);
  REQUIRE(killed.code != 0);
  REQUIRE(fs::exists(copy.out / kCheckpoint));
}

Outcome resume(const fs::path& out, const std::string& options = "") {
  return run_program("run --resume " + out.string() + " --quiet " + options);
}

void require_same(const fs::path& a, const fs::path& b) {
  for (const char* name :
       {"trajectory.txt", "trajectory_live.txt", "keyframes.txt", "map.ply", "map.sslam", "colours.bin"}) {
    INFO(name);
    REQUIRE(text_of(a / name) == text_of(b / name));
  }
}

nlohmann::json metrics_of(const fs::path& out) {
  return nlohmann::json::parse(text_of(out / "metrics.json"));
}

}  // namespace

TEST_CASE("a run gives the same bits with a checkpoint behind each frame") {
  const RoomCopy copy;
  REQUIRE(copy.run("--no-report --checkpoint 0").code == 0);
  const fs::path without = copy.scratch.path() / "without";
  fs::rename(copy.out, without);
  REQUIRE(copy.run(kEachFrame).code == 0);
  require_same(copy.out, without);
  REQUIRE(metrics_of(without)["checkpoints"]["count"] == 0);
  REQUIRE(metrics_of(copy.out)["checkpoints"]["count"] == kFrames);
  REQUIRE(metrics_of(copy.out)["resumed_at"].empty());
  REQUIRE_FALSE(fs::exists(copy.out / kCheckpoint));
  require_refused(resume(copy.out),
                  "holds no checkpoint of a run that stopped; it holds the results of a finished run");
}

TEST_CASE("a run that was killed goes on, twice alike, to results that are complete") {
  const RoomCopy copy;
  kill_run(copy, 40);
  const fs::path twin = copy.scratch.path() / "twin";
  fs::copy(copy.out, twin);
  REQUIRE_FALSE(fs::exists(copy.out / "metrics.json"));
  require_misused(resume(copy.out, "--stride 2"), "leave --stride out");
  require_misused(resume(copy.out, copy.folder.string()), "leave dataset out");
  require_misused(resume(copy.out, "--out other"), "leave --out out");
  for (const fs::path& out : {copy.out, twin}) {
    const Outcome outcome = resume(out);
    INFO(outcome.text);
    REQUIRE(outcome.code == 0);
    REQUIRE_FALSE(fs::exists(out / kCheckpoint));
  }
  require_same(copy.out, twin);
  const auto metrics = copy.metrics();
  REQUIRE(metrics["frames"] == kFrames);
  REQUIRE(metrics["share_tracked"].get<double>() > 0.9);
  REQUIRE(metrics["interrupted"] == false);
  REQUIRE(metrics["resumed_at"].size() == 1);
  REQUIRE(metrics["resumed_at"][0].get<int>() >= 39);
  REQUIRE(metrics["health"]["degraded"] == true);
  REQUIRE(metrics["health"]["reasons"] == nlohmann::json{"resumed"});
  REQUIRE(metrics["trajectory"]["ate_m"]["rmse"].get<double>() < 0.1);
  const std::string table = text_of(copy.out / "frames.csv");
  REQUIRE(std::count(table.begin(), table.end(), '\n') == kFrames + 1);
}

TEST_CASE("a run that was interrupted leaves results, and goes on from there") {
  const RoomCopy copy;
  const Outcome outcome = interrupt_program("run " + copy.folder.string() + " --out " + copy.out.string() +
                                            " --normals none --no-report");
  INFO(outcome.text);
  REQUIRE(outcome.code == 130);
  REQUIRE(outcome.text.find("--resume " + copy.out.string() + " continues it") != std::string::npos);
  REQUIRE(copy.metrics()["interrupted"] == true);
  const Outcome fresh = copy.run("--end 5 --no-report");
  REQUIRE(fresh.text.find("holds the checkpoint of a run that stopped") != std::string::npos);
}

TEST_CASE("a checkpoint that fits nothing is refused") {
  const RoomCopy copy;
  require_refused(resume(copy.scratch.path()), "holds no checkpoint of a run that stopped\n");
  require_misused(copy.run("--checkpoint 5 --live"), "--checkpoint: not with --live");
  kill_run(copy, 12);
  const fs::path file = copy.out / kCheckpoint;
  const std::string whole = text_of(file);
  write(file, whole.substr(0, whole.size() / 2));
  require_refused(resume(copy.out), "cut off, or written to since");
  write(file, whole);
  std::string list = text_of(copy.folder / "rgb.txt");
  write(copy.folder / "rgb.txt", list.substr(0, list.rfind('\n', list.size() - 2) + 1));
  require_refused(resume(copy.out), "the dataset has changed");
  write(copy.folder / "rgb.txt", list);
  std::string camera = text_of(copy.folder / "camera.yaml");
  write(copy.folder / "camera.yaml", camera.replace(camera.find("Camera.k1:"), 10, "Camera.k1: 0.01 #"));
  require_refused(resume(copy.out), "the calibration has changed");
}

}  // namespace resume_test
