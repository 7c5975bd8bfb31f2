// SPDX-License-Identifier: BSD-3-Clause
// What the folders of batches hold, evaluated: every trajectory by itself, and on the frames that all have in
// common.
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "cli/batch/plan.hpp"
#include "sslam/io/trajectories/trajectory.hpp"

namespace sslam::cli {

// One run of a method, or one file of another system.
struct Estimate {
  std::string title;
  bool done = false;                      // false: nobody has run it yet
  bool failed = false;                    // lost, or tracked too little
  bool broken = false;                    // failed for another reason than what it saw
  std::string reason;                     // of a failure
  double seconds = 0;                     // wall clock; 0: not known
  double share = 0;                       // of the frames that have a pose
  std::optional<double> ate, common_ate;  // RMSE in metres; nothing where there is no ground truth
  std::optional<double> rotation;         // RMSE in degrees after the best constant turn
  std::optional<double> frame_rate;       // frames a second of a run of ours
  std::filesystem::path report;           // below the folder of the results; empty: it has none
  std::string frames;                     // file of the stamps that it could have tracked; empty: not known
  io::Trajectory trajectory;
};

struct ResultColumn {
  std::string name;
  double min_tracked = 0;  // share below which tracking has failed
  std::map<std::string, std::vector<Estimate>> by_sequence{};
};

// The frames of a sequence from one of its starts.
struct ResultFrames {
  std::string file;
  std::vector<double> stamps;
  std::size_t common = 0;  // frames in which every estimate from there that has not failed has a pose
};

struct ResultSequence {
  std::string name;
  io::Trajectory truth;              // empty: none
  std::vector<ResultFrames> starts;  // one, but for an ensemble

  // What an estimate could have tracked: another system's begins with the sequence.
  [[nodiscard]] const ResultFrames& frames_of(const Estimate& estimate) const {
    for (const ResultFrames& start : starts)
      if (start.file == estimate.frames) return start;
    return starts.front();
  }
};

struct Results {
  std::string name;
  double min_tracked = 0;
  std::vector<ResultSequence> sequences;
  std::vector<ResultColumn> columns;
};

// Of a batch and, in columns of their own, of earlier ones. Throws Error when a folder is none of a
// batch.
[[nodiscard]] Results read_results(const std::filesystem::path& folder,
                                   const std::vector<std::filesystem::path>& earlier);

}  // namespace sslam::cli
