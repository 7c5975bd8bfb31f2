// SPDX-License-Identifier: BSD-3-Clause
// Every run of a batch, written down in its folder, so that the folder alone tells what belongs in its
// tables.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "cli/batch/suite.hpp"

namespace sslam::cli {

struct PlannedRun {
  std::string sequence;
  std::string method;
  std::string folder;                  // below the batch's, such as runs/office/structure/seed-1
  std::vector<std::string> arguments;  // of sslam, without --out

  // For people: "office, structure, seed 1".
  std::string title;
  std::string frames;  // file of the stamps that it could have tracked, below the batch's folder
};

struct PlannedReference {
  std::string name;
  double min_tracked = 0;
  std::map<std::string, std::vector<std::string>>
      trajectories;  // by sequence; files below the batch's folder
};

struct Plan {
  std::string name;
  double min_tracked = 0;
  std::vector<std::string> sequences;
  std::vector<std::string> methods;
  std::vector<PlannedReference> references;
  std::vector<PlannedRun> runs;  // in an order that depends on the suite alone
  std::vector<std::string>
      parts;  // folders that hold the runs, relative to the batch's; "." but for merged ones
};

// Files of a batch's folder.
inline constexpr const char* kPlanFile = "batch.json";
[[nodiscard]] std::string truth_file_of(const std::string& sequence);  // below the batch's folder
// Stamps, one a row, of a run from the sequence's first frame; `start`: of an ensemble.
[[nodiscard]] std::string frames_file_of(const std::string& sequence,
                                         std::optional<std::int64_t> start = std::nullopt);

// What `sslam` is called with, but for the folder of the results.
[[nodiscard]] std::vector<std::string> run_arguments(const Suite& suite, const SuiteSequence& sequence,
                                                     const SuiteMethod& method, std::uint64_t seed,
                                                     std::optional<std::int64_t> start);

// The first frames of a sequence's runs; nothing in the place of the one that its options name.
[[nodiscard]] std::vector<std::optional<std::int64_t>> starts_of(const SuiteSequence& sequence);

// As --normals takes it, for this sequence.
[[nodiscard]] std::string normals_for(const SuiteMethod& method, const SuiteSequence& sequence);

[[nodiscard]] Plan make_plan(const Suite& suite);

void write_plan(const std::filesystem::path& folder, const Plan& plan);

// Throws Error when the folder holds none.
[[nodiscard]] Plan read_plan(const std::filesystem::path& folder);

// Part i of n, counted from 1: every n-th run, so that each part has its share of each sequence.
struct Shard {
  int index = 1;
  int count = 1;

  [[nodiscard]] bool holds(std::size_t run) const noexcept {
    return static_cast<int>(run % static_cast<std::size_t>(count)) == index - 1;
  }
  [[nodiscard]] std::string folder() const {
    return "shard-" + std::to_string(index) + "-of-" + std::to_string(count);
  }
};

}  // namespace sslam::cli
