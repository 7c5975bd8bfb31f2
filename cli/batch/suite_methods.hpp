// SPDX-License-Identifier: BSD-3-Clause
// The methods of a suite: lists in a [[method]] stand for every combination of their elements.
#pragma once

#include <cstdint>
#include <vector>

#include "cli/batch/suite.hpp"

namespace sslam::cli {

class SuiteTable;

struct MethodDefaults {
  std::vector<std::uint64_t> seeds{1};
  int repeats = 1;
};

// The seeds and repeats that a table names, those of `otherwise` where it names none.
[[nodiscard]] MethodDefaults read_defaults(SuiteTable& table, const MethodDefaults& otherwise);

// Adds the methods that one [[method]] names.
void read_methods(SuiteTable& table, const MethodDefaults& defaults, std::vector<SuiteMethod>& methods);

// Where the suite names none: what `sslam run` does by itself.
[[nodiscard]] std::vector<SuiteMethod> default_methods(const MethodDefaults& defaults);

}  // namespace sslam::cli
