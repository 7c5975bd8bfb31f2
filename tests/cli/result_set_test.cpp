// SPDX-License-Identifier: BSD-3-Clause
// Results as one: whatever happens while they are written, a folder holds the old files or the new ones.
#include "cli/results/result_set.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "cli/results/folder_lock.hpp"
#include "io/errors.hpp"
#include "sslam/core/random.hpp"
#include "sslam/io/files/output_file.hpp"
#include "support/catch.hpp"
#include "support/scratch_folder.hpp"

namespace result_set_test {

namespace {

namespace fs = std::filesystem;
using namespace sslam::cli;
using namespace sslam::testing;
using Names = std::vector<std::string>;

constexpr const char* kNames[] = {"a", "b", "c", "d", "e", "odd", "even"};

// Set number n: each file holds n, and of the last two names it has one.
void write_set(const fs::path& folder, int n) {
  ResultSet results(folder);
  for (const std::string name : {"a", "b", "c", "d", "e", n % 2 == 0 ? "even" : "odd"})
    sslam::io::write_text(results.stage() / name, std::to_string(n));
  results.commit(kNames);
}

Names names_in(const fs::path& folder) {
  Names names;
  for (const auto& entry : fs::directory_iterator(folder)) names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace

TEST_CASE("a set of results takes the place of an older one as a whole") {
  const ScratchFolder scratch;
  const fs::path folder = scratch.path() / "out";
  write_set(folder, 1);
  CHECK(names_in(folder) == Names{"a", "b", "c", "d", "e", "odd"});
  scratch.write("out/of_somebody_else", "kept");
  write_set(folder, 2);
  CHECK(names_in(folder) == Names{"a", "b", "c", "d", "e", "even", "of_somebody_else"});
  CHECK(text_of(folder / "c") == "2");
  {
    const ResultSet given_up(folder);
    sslam::io::write_text(given_up.stage() / "a", "3");
  }
  CHECK(text_of(folder / "a") == "2");
  CHECK(names_in(folder).size() == 7);
}

TEST_CASE("a folder of a set takes the place of an older one with all that is in it") {
  const ScratchFolder scratch;
  const fs::path folder = scratch.path() / "out";
  constexpr const char* kParts[] = {"images", "depth", "list"};
  const auto put = [&](const std::string& n, const Names& images, bool depth) {
    ResultSet results(folder);
    fs::create_directory(results.stage() / "images");
    for (const std::string& image : images) sslam::io::write_text(results.stage() / "images" / image, n);
    if (depth) fs::create_directory(results.stage() / "depth");
    sslam::io::write_text(results.stage() / "list", n);
    results.commit(kParts);
  };
  put("1", {"a", "b", "c"}, true);
  CHECK(names_in(folder) == Names{"depth", "images", "list"});
  put("2", {"a", "b"}, false);
  CHECK(names_in(folder) == Names{"images", "list"});
  CHECK(names_in(folder / "images") == Names{"a", "b"});
  CHECK(text_of(folder / "images/b") == "2");
  CHECK(checksums_of(folder).size() == 1);  // of files alone
  // As if killed between the two names.
  fs::create_directories(folder / ".sslam-ready");
  fs::rename(folder / "images", folder / ".sslam-ready/images");
  scratch.write("out/images/c", "1");
  settle_results(folder);
  CHECK(names_in(folder / "images") == Names{"a", "b"});
}

TEST_CASE("a folder that has gone is made again for the results") {
  const ScratchFolder scratch;
  write_set(scratch.path() / "gone" / "out", 1);
  CHECK(text_of(scratch.path() / "gone" / "out" / "e") == "1");
}

TEST_CASE("results that cannot take their places change nothing") {
  const ScratchFolder scratch;
  const fs::path folder = scratch.path() / "out";
  write_set(folder, 1);
  fs::remove(folder / "d");
  fs::create_directories(folder / "d");
  CHECK(contains(error_of([&] { write_set(folder, 2); }), "out/d: cannot write: is a folder"));
  CHECK(text_of(folder / "a") == "1");
  CHECK(names_in(folder) == Names{"a", "b", "c", "d", "e", "odd"});
  scratch.write("file");
  CHECK(contains(error_of([&] { write_set(scratch.path() / "file", 1); }), "file: cannot write: "));
}

TEST_CASE("who is killed while results are written leaves the old set or the new one") {
  const ScratchFolder scratch;
  const fs::path folder = scratch.path() / "out";
  write_set(folder, 1);
  sslam::Random random(5);
  int renewed = 0;
  for (int round = 0; round < 40; ++round) {
    const std::string before = text_of(folder / "a");
    const pid_t child = fork();
    if (child == 0) {
      for (int n = 2;; ++n) write_set(folder, n);
    }
    while (round % 4 == 0 && text_of(folder / "a") == before) usleep(100);  // a busy machine is no excuse
    usleep(2000 + random.below(8000));
    kill(child, SIGKILL);
    int status = 0;
    waitpid(child, &status, 0);
    REQUIRE(WIFSIGNALED(status));
    settle_results(folder);
    const std::string n = text_of(folder / "a");
    REQUIRE_FALSE(n.empty());
    for (const char* name : {"b", "c", "d", "e"}) REQUIRE(text_of(folder / name) == n);
    const bool even = std::stoi(n) % 2 == 0;
    REQUIRE(fs::exists(folder / "even") == even);
    REQUIRE(fs::exists(folder / "odd") == !even);
    renewed += n != "1" ? 1 : 0;
  }
  CHECK(renewed > 0);
}

TEST_CASE("results that were whole when their writer was killed are brought to their names") {
  const ScratchFolder scratch;
  const fs::path folder = scratch.path() / "out";
  write_set(folder, 1);
  scratch.write("kept", "1");
  scratch.write("out/a", "2");  // as if killed between two of the names
  for (const char* name : {"b", "c", "d", "e", "even"})
    scratch.write("out/.sslam-ready/" + std::string(name), "2");
  scratch.write("out/.sslam-ready/.obsolete", "odd\n../kept\n..\n.\n");
  settle_results(folder);
  CHECK(names_in(folder) == Names{"a", "b", "c", "d", "e", "even"});
  for (const char* name : {"a", "b", "c", "d", "e", "even"}) CHECK(text_of(folder / name) == "2");
  CHECK(fs::exists(scratch.path() / "kept"));
}

TEST_CASE("a folder is written to by one process at a time") {
  const ScratchFolder scratch;
  {
    const FolderLock mine = FolderLock::demand(scratch.path());
    CHECK_FALSE(FolderLock::take(scratch.path()).has_value());
    const std::string why = error_of([&] { (void)FolderLock::demand(scratch.path()); });
    CHECK(contains(why, "another sslam is writing its results into this folder"));
    CHECK(is_one_line(why));
  }
  CHECK(FolderLock::take(scratch.path()).has_value());
  CHECK(names_in(scratch.path()).empty());
}

TEST_CASE("a file of another run is told from those of this one") {
  const ScratchFolder scratch;
  write_set(scratch.path(), 1);
  const nlohmann::ordered_json checksums = checksums_of(scratch.path());
  CHECK(foreign_files(scratch.path(), checksums).empty());
  scratch.write("c", "2");
  fs::remove(scratch.path() / "d");  // which is for others to say
  const std::vector<std::string> foreign = foreign_files(scratch.path(), checksums);
  REQUIRE(foreign.size() == 1);
  CHECK(contains(foreign[0], "/c: is not the file that belongs to metrics.json beside it"));
  CHECK(foreign_files(scratch.path(), {{"../x", 7}, {"a", nullptr}}).size() == 1);
  CHECK(foreign_files(scratch.path(), "no list").empty());
}

}  // namespace result_set_test
