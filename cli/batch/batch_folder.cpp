// SPDX-License-Identifier: BSD-3-Clause
#include "cli/batch/batch_folder.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <utility>

#include "sslam/io/files/output_file.hpp"
#include "sslam/io/files/text.hpp"

namespace sslam::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* kLockFile = ".lock";

void refuse_foreign(const fs::path& folder) {
  std::error_code ignored;
  if (!fs::is_directory(folder, ignored) || fs::is_empty(folder, ignored)) return;
  if (fs::exists(folder / kPlanFile, ignored) || fs::exists(folder / kLockFile, ignored)) return;
  throw Error(folder.string() + ": holds files that sslam batch did not write; choose an empty folder");
}

void write_facts(const fs::path& folder, const SuiteSequence& sequence, const SequenceFacts& facts) {
  const fs::path truth = folder / truth_file_of(sequence.name);
  fs::create_directories(truth.parent_path());
  const auto starts = starts_of(sequence);
  for (std::size_t i = 0; i < starts.size(); ++i)
    io::write_stamps(folder / frames_file_of(sequence.name, starts[i]), facts.frames[i]);
  fs::remove(truth);  // an earlier suite may have had one
  if (!facts.truth.empty()) io::write_trajectory(truth, facts.truth);
}

// Where they come from may change, or not be there where shards are merged.
void copy_references(const fs::path& folder, const Suite& suite, const Plan& plan) {
  for (std::size_t r = 0; r < plan.references.size(); ++r) {
    for (const auto& [sequence, copies] : plan.references[r].trajectories) {
      const auto& originals = suite.references[r].trajectories.at(sequence);
      for (std::size_t i = 0; i < copies.size(); ++i) {
        fs::create_directories((folder / copies[i]).parent_path());
        fs::copy_file(originals[i], folder / copies[i], fs::copy_options::overwrite_existing);
      }
    }
  }
}

bool same_runs(const Plan& a, const Plan& b) {
  if (a.sequences != b.sequences || a.methods != b.methods || a.runs.size() != b.runs.size()) return false;
  for (std::size_t i = 0; i < a.runs.size(); ++i)
    if (a.runs[i].folder != b.runs[i].folder || a.runs[i].arguments != b.runs[i].arguments) return false;
  return true;
}

}  // namespace

BatchFolder::BatchFolder(fs::path folder) : folder_(std::move(folder)) {
  refuse_foreign(folder_);
  io::prepare_output_folder(folder_);
  lock_ = open((folder_ / kLockFile).c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (lock_ >= 0 && flock(lock_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
    close(lock_);
    throw Error(folder_.string() +
                ": another sslam batch is writing there; wait for it, or choose another --out");
  }
}

BatchFolder::~BatchFolder() {
  if (lock_ >= 0) close(lock_);
}

void BatchFolder::prepare(const Suite& suite, const Plan& plan,
                          const std::vector<SequenceFacts>& facts) const {
  for (std::size_t i = 0; i < plan.sequences.size(); ++i) write_facts(folder_, suite.sequences[i], facts[i]);
  copy_references(folder_, suite, plan);
  write_plan(folder_, plan);
}

Plan merge_plans(const std::vector<fs::path>& folders, const fs::path& out) {
  Plan merged = read_plan(folders.front());
  merged.parts.clear();
  for (const fs::path& folder : folders) {
    const Plan plan = read_plan(folder);
    std::error_code ignored;
    if (fs::equivalent(folder, out, ignored))
      throw Error("--out " + out.string() + ": is one of the folders to merge; choose another");
    if (!same_runs(merged, plan))
      throw Error(folder.string() + ": is not a shard of the same suite as " + folders.front().string());
    for (const std::string& part : plan.parts)
      merged.parts.push_back(fs::absolute(folder / part)
                                 .lexically_normal()
                                 .lexically_relative(fs::absolute(out).lexically_normal()));
  }
  return merged;
}

}  // namespace sslam::cli
