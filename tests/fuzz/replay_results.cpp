// SPDX-License-Identifier: BSD-3-Clause
// Fuzz targets of archives, settings, and what runs leave.
#include "fuzz/replay.hpp"
#include "io/errors.hpp"
#include "support/catch.hpp"

#define LLVMFuzzerTestOneInput fuzz_archive
#define LLVMFuzzerCustomMutator seed_of_archive
#include "fuzz/archive_fuzz.cpp"
#undef LLVMFuzzerCustomMutator
#undef LLVMFuzzerTestOneInput
#define LLVMFuzzerTestOneInput fuzz_result_files
#define LLVMFuzzerCustomMutator seed_of_result_files
#include "fuzz/result_files_fuzz.cpp"
#undef LLVMFuzzerCustomMutator
#undef LLVMFuzzerTestOneInput
#define LLVMFuzzerTestOneInput fuzz_config
#define LLVMFuzzerCustomMutator seed_of_config
#include "fuzz/config_fuzz.cpp"
#undef LLVMFuzzerCustomMutator
#undef LLVMFuzzerTestOneInput
#define LLVMFuzzerTestOneInput fuzz_suite
#define LLVMFuzzerCustomMutator seed_of_suite
#include "fuzz/suite_fuzz.cpp"
#undef LLVMFuzzerCustomMutator
#undef LLVMFuzzerTestOneInput
#define LLVMFuzzerTestOneInput fuzz_run_folder
#define LLVMFuzzerCustomMutator seed_of_run_folder
#include "fuzz/run_folder_fuzz.cpp"
#undef LLVMFuzzerCustomMutator
#undef LLVMFuzzerTestOneInput
#define LLVMFuzzerTestOneInput fuzz_checkpoint
#define LLVMFuzzerCustomMutator seed_of_checkpoint
#include "fuzz/checkpoint_fuzz.cpp"
#undef LLVMFuzzerCustomMutator
#undef LLVMFuzzerTestOneInput

namespace {

using namespace sslam;
using fuzzing::replay;

// What is said of an archive of these entries; empty: nothing.
std::string refusal(const std::string& tar) {
  const testing::ScratchFolder scratch;
  const std::string end(2 * archive_fuzz::kBlock, '\0');
  const std::filesystem::path file = scratch.write("a.tar.gz", archive_fuzz::gzipped(tar + end));
  return testing::error_of([&] { cli::unpack(file, scratch.path() / "out", "room"); });
}

std::string entry(const std::string& name, const std::string& content) {
  std::string tar = archive_fuzz::tar_entry(name, '0', content);
  archive_fuzz::mend_sums(tar);
  return tar;
}

}  // namespace

TEST_CASE("archives that are spoilt") {
  replay(fuzz_archive, archive_fuzz::seeds(), 1500);
}

TEST_CASE("an archive that does not fit together, or unpacks to far more than its size, is refused") {
  using testing::contains;
  const std::string file = entry("room/a", "text"), below = entry("room/a/b", "text");
  CHECK(refusal(file).empty());
  CHECK(contains(refusal(file + below), "holds 'b' both as a file and as a folder"));
  CHECK(contains(refusal(below + file), "holds 'a' both as a file and as a folder"));
  const std::string zeros(101U << 20U, '\0');
  CHECK(contains(refusal(entry("room/a", zeros)), "unpacks to more than a hundred times its size"));
}

TEST_CASE("views, colours and models that are spoilt") {
  replay(fuzz_result_files, result_files_fuzz::seeds(), 4000);
}

TEST_CASE("files of options that are spoilt") {
  replay(fuzz_config, config_fuzz::seeds(), 1000);
}

TEST_CASE("suites that are spoilt") {
  replay(fuzz_suite, suite_fuzz::seeds(), 1000);
}

TEST_CASE("folders of runs that are spoilt") {
  replay(fuzz_run_folder, run_folder_fuzz::seeds(), 300);
}

TEST_CASE("checkpoints that are spoilt") {
  replay(fuzz_checkpoint, {checkpoint_fuzz::seed_file()}, 1000, seed_of_checkpoint);
}
