// SPDX-License-Identifier: BSD-3-Clause
// Tables come back as they were written, and flawed ones say where.
#include <fstream>
#include <string>

#include "io/errors.hpp"
#include "sslam/io/files/csv_reader.hpp"
#include "sslam/io/files/csv_writer.hpp"
#include "support/scratch_folder.hpp"

using namespace sslam;
using testing::contains;
using testing::error_of;

namespace {

void write(const std::filesystem::path& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

}  // namespace

TEST_CASE("A table is read as it was written") {
  const testing::ScratchFolder scratch;
  const auto path = scratch.path() / "table.csv";
  io::CsvWriter csv(path, {"name", "value"});
  csv.row(std::string("a, \"b\"\nc"), 1.5);
  csv.row(std::string(), 2);
  csv.commit();
  io::Warnings warnings;
  const io::CsvTable table = io::read_csv(path, warnings);
  CHECK(warnings.empty());
  CHECK(table.column("value") == 1);
  CHECK(table.column("none") == 2);
  REQUIRE(table.rows() == 2);
  CHECK(table.cell(0, 0) == "a, \"b\"\nc");
  CHECK(table.cell(0, 1) == "1.5");
  CHECK(table.cell(1, 0).empty());
}

TEST_CASE("A table that is cut off keeps its whole rows and names the line") {
  const testing::ScratchFolder scratch;
  const auto path = scratch.path() / "table.csv";
  write(path, "a,b\n1,2\r\n\"3\n\",4\n5");
  io::Warnings warnings;
  const io::CsvTable table = io::read_csv(path, warnings);
  CHECK(table.rows() == 2);
  REQUIRE(warnings.size() == 1);
  CHECK(contains(warnings[0], "table.csv: line 5: has 1 of 2 cells: skipped"));
  write(path, "");
  CHECK(contains(error_of([&] { (void)io::read_csv(path, warnings); }), "table.csv: is empty"));
  write(path, "a,b\n1\n2\n3,4\n");
  CHECK(contains(error_of([&] { (void)io::read_csv(path, warnings); }),
                 "line 2: has 1 of 2 cells (and 1 more"));
  write(path, "a,b\n\"1,2\n3,4\n");
  CHECK(contains(error_of([&] { (void)io::read_csv(path, warnings); }), "line 2: has 1 of 2 cells"));
}
