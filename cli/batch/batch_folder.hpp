// SPDX-License-Identifier: BSD-3-Clause
// The folder of a batch: held by one process at a time, and with all in it that its tables need.
#pragma once

#include <filesystem>
#include <vector>

#include "cli/batch/plan.hpp"
#include "cli/batch/suite_check.hpp"

namespace sslam::cli {

class BatchFolder {
 public:
  // Makes it. Throws Error when it holds something else, or another process has it.
  explicit BatchFolder(std::filesystem::path folder);
  BatchFolder(const BatchFolder&) = delete;
  BatchFolder& operator=(const BatchFolder&) = delete;
  ~BatchFolder();

  // Writes the plan, the sequences' ground truth and stamps, and copies of the references.
  void prepare(const Suite& suite, const Plan& plan, const std::vector<SequenceFacts>& facts) const;

 private:
  std::filesystem::path folder_;
  int lock_ = -1;
};

// One plan with the runs of all these folders, for tables in `out`. Throws Error when they are not of one
// suite.
[[nodiscard]] Plan merge_plans(const std::vector<std::filesystem::path>& folders,
                               const std::filesystem::path& out);

}  // namespace sslam::cli
