// SPDX-License-Identifier: BSD-3-Clause
// A suite file: which sequences are tracked, by which methods, how often, and what they are compared with.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace sslam::cli {

// An option of `sslam run` by its long name.
struct SuiteOption {
  std::string key;
  std::string value;  // of a flag "true" or "false"
  bool flag = false;
  int line = 0;  // in the suite file
};

struct SuiteSequence {
  std::string name;
  std::string dataset;  // as `sslam run` takes it
  std::vector<SuiteOption> options;
  std::vector<std::int64_t> starts;  // first frames of an ensemble; empty: one run, by the options
  std::filesystem::path truth;       // empty: the dataset's own
  int line = 0;                      // of its path in the suite file
};

struct SuiteMethod {
  std::string name;
  std::string preset = "structure";
  std::string normals;           // as --normals takes it; "{sequence}" in it stands for the sequence's name
  std::vector<std::string> set;  // stage.parameter=value
  std::vector<SuiteOption> options;
  std::vector<std::uint64_t> seeds;
  int repeats = 1;
  int line = 0;  // of its heading in the suite file, and of what it may say
  int preset_line = 0, normals_line = 0, set_line = 0;
};

// Trajectories that another system has made.
struct SuiteReference {
  std::string name;
  std::map<std::string, std::vector<std::filesystem::path>> trajectories;  // by the sequence's name
  double min_tracked = 0;
  int line = 0;
};

struct Suite {
  std::filesystem::path file;
  std::string name;
  std::filesystem::path out;
  double min_tracked = 0.5;  // share of frames with a pose, below which tracking has failed
  bool report = false;       // each run writes its report.html
  std::vector<SuiteSequence> sequences;
  std::vector<SuiteMethod> methods;
  std::vector<SuiteReference> references;
  std::vector<std::filesystem::path> against;  // folders of earlier batches
  int against_line = 0;
};

// Paths in the file are relative to its folder. Throws Error that names file, line and key.
[[nodiscard]] Suite read_suite(const std::filesystem::path& file);

// The name as a part of a path: letters, digits, '.', '_', '=' and '-'.
[[nodiscard]] std::string folder_name(const std::string& name);

}  // namespace sslam::cli
