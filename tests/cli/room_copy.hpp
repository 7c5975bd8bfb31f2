// SPDX-License-Identifier: BSD-3-Clause
// A rendered room to track, for tests of `sslam run` and of what follows it.
#pragma once

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>

#include "cli/program.hpp"
#include "support/catch.hpp"
#include "support/scratch_folder.hpp"

namespace sslam::testing {

inline constexpr int kFrames = 60;

// One rendered room for all tests of this program; each works on links to it, so that it can spoil a file.
inline const std::filesystem::path& room() {
  static const ScratchFolder scratch;
  static const std::filesystem::path folder = [] {
    const std::filesystem::path path = scratch.path() / "room";
    const Outcome outcome = run_program("synth " + path.string() + " --quiet --frames " +
                                        std::to_string(kFrames) + " --seed 3 --size 480x360");
    if (outcome.code != 0) throw std::runtime_error(outcome.text);
    return path;
  }();
  return folder;
}

struct RoomCopy {
  ScratchFolder scratch;
  std::filesystem::path folder = scratch.path() / "room";
  std::filesystem::path out = scratch.path() / "out";

  RoomCopy() { std::filesystem::copy(room(), folder, std::filesystem::copy_options::recursive); }

  // With lines alone, unless the options name a source of normals.
  [[nodiscard]] Outcome run(const std::string& options = "") const {
    const bool named = options.find("--normals") != std::string::npos;
    return run_by_default(options + (named ? "" : " --normals none"));
  }
  [[nodiscard]] Outcome run_by_default(const std::string& options = "") const {
    return run_program("run " + folder.string() + " --quiet --out " + out.string() + " " + options);
  }
  [[nodiscard]] nlohmann::json metrics() const {
    std::ifstream file(out / "metrics.json");
    return nlohmann::json::parse(file);
  }
};

inline void write(const std::filesystem::path& file, const std::string& text) {
  std::ofstream(file, std::ios::binary) << text;
}

// Exit code 1 and one line that names what is wrong.
inline void require_refused(const Outcome& outcome, const std::string& what, int code = 1) {
  INFO(outcome.text);
  REQUIRE(outcome.code == code);
  REQUIRE(outcome.text.find("sslam: error: ") == 0);
  REQUIRE(outcome.text.find(what) != std::string::npos);
  REQUIRE(outcome.text.find('\n') == outcome.text.size() - 1);
}

// The same for a wrong command line: exit code 2.
inline void require_misused(const Outcome& outcome, const std::string& what) {
  require_refused(outcome, what, 2);
}

}  // namespace sslam::testing
