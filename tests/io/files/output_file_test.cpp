// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/io/files/output_file.hpp"

#include <string>
#include <vector>

#include "io/errors.hpp"
#include "sslam/io/files/csv_writer.hpp"
#include "support/scratch_folder.hpp"

using namespace sslam;
using testing::contains;
using testing::error_of;

TEST_CASE("A file keeps its old contents until the new ones are complete") {
  const testing::ScratchFolder scratch;
  const auto path = scratch.write("a.txt", "old");
  {
    io::OutputFile file(path);
    file.stream() << "half";
  }
  CHECK(testing::text_of(path) == "old");
  CHECK(std::distance(std::filesystem::directory_iterator(scratch.path()), {}) == 1);
  io::OutputFile file(path);
  file.stream() << "new";
  CHECK(testing::text_of(path) == "old");
  file.commit();
  CHECK(testing::text_of(path) == "new");
}

TEST_CASE("A link stays a link and a device stays a device") {
  const testing::ScratchFolder scratch;
  const auto target = scratch.write("target.txt", "old");
  const auto link = scratch.path() / "link.txt";
  std::filesystem::create_symlink("target.txt", link);
  io::OutputFile file(link);
  file.stream() << "new";
  file.commit();
  CHECK(std::filesystem::is_symlink(link));
  CHECK(testing::text_of(target) == "new");

  io::OutputFile null("/dev/null");
  null.stream() << "gone";
  null.commit();
  CHECK(std::filesystem::is_character_file("/dev/null"));
}

TEST_CASE("A full disk is noticed at the latest when the file is completed") {
  if (!std::filesystem::exists("/dev/full")) return;
  io::OutputFile file("/dev/full");
  file.stream() << "text";
  CHECK(contains(error_of([&] { file.commit(); }), "/dev/full: cannot write"));
}

TEST_CASE("An output folder is made with its parents or refused") {
  const testing::ScratchFolder scratch;
  io::prepare_output_folder(scratch.path() / "a/b");
  CHECK(std::filesystem::is_empty(scratch.path() / "a/b"));
  io::prepare_output_folder(scratch.path() / "a/b");
  scratch.write("file", "x");
  const std::string text = error_of([&] { io::prepare_output_folder(scratch.path() / "file/out"); });
  CHECK(testing::is_one_line(text));
  CHECK(contains(text, "file/out: cannot make this folder"));
  CHECK(contains(error_of([&] { io::prepare_output_folder(scratch.path() / "file"); }),
                 "cannot make this folder"));
}

TEST_CASE("Rows of a table are written as readers split them") {
  const testing::ScratchFolder scratch;
  const auto path = scratch.path() / "t.csv";
  io::CsvWriter csv(path, {"index", "state", "seconds", "ok"});
  csv.row(3, "lost, \"again\"", 0.125, true);
  csv.row(std::size_t{4}, std::string("tracking"), 1e-7, false);
  csv.row(std::vector<std::string>{"5", "a, b", "2", "1"});
  csv.commit();
  CHECK(
      testing::text_of(path) ==
      "index,state,seconds,ok\n3,\"lost, \"\"again\"\"\",0.125,1\n4,tracking,0.0000001,0\n5,\"a, b\",2,1\n");
}
