// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/io/files/text.hpp"

#include <sys/stat.h>

#include <chrono>
#include <cmath>
#include <csignal>
#include <fstream>
#include <limits>
#include <thread>

#include "io/errors.hpp"
#include "sslam/io/files/files.hpp"
#include "support/scratch_folder.hpp"

using namespace sslam;

TEST_CASE("Cells are split at blanks tabs commas semicolons and carriage returns") {
  const auto cells = io::split_cells("  1.5,2\t foo \r");
  REQUIRE(cells.size() == 3);
  CHECK(cells[0] == "1.5");
  CHECK(cells[1] == "2");
  CHECK(cells[2] == "foo");
  CHECK(io::split_cells("1,5;\"a; b\" ; 'c'") == std::vector<std::string_view>{"1,5", "a; b", "c"});
  CHECK(io::split_cells("").empty());
  CHECK(io::split_cells(" \r").empty());
}

TEST_CASE("Rows keep their line numbers past comments and empty lines") {
  const auto rows = io::split_rows("# head\n\n1 2\n  # no\n3 4");
  REQUIRE(rows.size() == 2);
  CHECK(rows[0].line == 3);
  CHECK(rows[1].line == 5);
  CHECK(rows[1].cells[1] == "4");
}

TEST_CASE("A number is the whole text or nothing") {
  CHECK(io::parse_number<double>("-1.5e3").value() == -1500);
  CHECK(io::parse_number<double>("+2").value() == 2);
  CHECK(std::isnan(io::parse_number<double>("nan").value()));
  CHECK_FALSE(io::parse_number<double>("1.5x").has_value());
  CHECK_FALSE(io::parse_number<double>("").has_value());
  CHECK_FALSE(io::parse_number<int>("1.5").has_value());
}

TEST_CASE("Decimals read back as the same double and as published") {
  CHECK(io::exact_decimal(1341836537.655662) == "1341836537.655662");
  CHECK(io::exact_decimal(1341836537.8070) == "1341836537.807000");
  CHECK(io::exact_decimal(2) == "2.000000");
  CHECK(io::exact_decimal(0.02, 0) == "0.02");
  CHECK(io::exact_decimal(3, 0) == "3");
  CHECK(io::exact_decimal(-0.0333333333333, 3) == "-0.0333333333333");
  for (const double value : {1.0 / 3, 1403636579.763555527, 1e-9, 0.1 + 0.2}) {
    CHECK(io::parse_number<double>(io::exact_decimal(value)).value() == value);
  }
  CHECK(io::exact_decimal(std::numeric_limits<double>::infinity()) == "inf");
}

TEST_CASE("Reading what is not there says so in one line") {
  const testing::ScratchFolder scratch;
  const std::string missing = testing::error_of([&] { (void)io::read_text(scratch.path() / "none.txt"); });
  CHECK(testing::is_one_line(missing));
  CHECK(testing::contains(missing, "none.txt: cannot open: No such file"));
  const std::string folder = testing::error_of([&] { (void)io::read_text(scratch.path()); });
  CHECK(testing::contains(folder, "is a folder"));
}

TEST_CASE("Numbers in names sort as numbers") {
  CHECK(io::natural_less("9.png", "10.png"));
  CHECK_FALSE(io::natural_less("10.png", "9.png"));
  CHECK(io::natural_less("a2b10", "a2b9x") == false);
  CHECK(io::natural_less("a", "ab"));
  CHECK(io::natural_less("frame-000009", "frame-000010"));
  CHECK(io::natural_less("01.png", "1.png"));
  CHECK_FALSE(io::natural_less("1.png", "1.png"));
}

TEST_CASE("Wildcards") {
  CHECK(io::matches_wildcards("left_12.png", "left_*.png"));
  CHECK(io::matches_wildcards("left_12.png", "*1?.p*g"));
  CHECK_FALSE(io::matches_wildcards("right_12.png", "left_*.png"));
  CHECK_FALSE(io::matches_wildcards("left_.pn", "left_*.png"));
  CHECK(io::matches_wildcards("", "*"));
  CHECK_FALSE(io::matches_wildcards("", "?"));
}

TEST_CASE("A file without an end is refused") {
  CHECK(sslam::testing::error_of([] { (void)io::read_text("/dev/zero", 1 << 20); }) ==
        "/dev/zero: is longer than 1048576 bytes, or has no end");
  const sslam::testing::ScratchFolder scratch;
  const auto file = scratch.write("a.txt", std::string(100'000, 'a'));
  CHECK(io::read_text(file, 100'000).size() == 100'000);
  CHECK_THROWS_AS(io::read_text(file, 99'999), Error);
}

TEST_CASE("A named pipe is read to its end, and refused where nobody writes") {
  using namespace std::chrono_literals;
  const testing::ScratchFolder scratch;
  const std::filesystem::path pipe = scratch.path() / "pipe";
  REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
  const std::string why = testing::error_of([&] { (void)io::read_pipe(pipe, 100, 20ms); });
  CHECK(testing::is_one_line(why));
  CHECK(testing::contains(why, "pipe: is a named pipe, and nothing has come through it"));
  const std::string text(200'000, 'x');  // more than a pipe holds
  const auto give = [&] { std::ofstream(pipe) << text; };
  std::thread writer(give);
  CHECK(io::read_text(pipe) == text);
  writer.join();
  const auto before = std::signal(SIGPIPE, SIG_IGN);  // of the writer, once nobody reads
  writer = std::thread(give);
  CHECK(testing::contains(testing::error_of([&] { (void)io::read_pipe(pipe, 10, 10s); }),
                          "is longer than 10 bytes"));
  writer.join();
  std::signal(SIGPIPE, before);
}
