// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/io/datasets/increasing.hpp"

#include <vector>

#include "io/errors.hpp"
#include "sslam/io/files/bad_entries.hpp"

using namespace sslam;

namespace {

std::vector<bool> keep(const std::vector<double>& stamps) {
  return io::keep_increasing(stamps);
}

}  // namespace

TEST_CASE("Increasing stamps are all kept") {
  CHECK(keep({}).empty());
  CHECK(keep({1, 2, 3}) == std::vector<bool>{true, true, true});
}

TEST_CASE("One stray stamp costs itself alone whether high or low") {
  CHECK(keep({1, 2, 90, 3, 4}) == std::vector<bool>{true, true, false, true, true});
  CHECK(keep({1, 2, 0, 3, 4}) == std::vector<bool>{true, true, false, true, true});
}

TEST_CASE("Of repeated stamps the first is kept") {
  CHECK(keep({1, 2, 2, 3}) == std::vector<bool>{true, true, false, true});
  CHECK(keep({2, 2}) == std::vector<bool>{true, false});
}

TEST_CASE("A few bad entries are warned of and many are an error") {
  io::Warnings warnings;
  io::BadEntries few("list.txt");
  few.add(7, "no stamp");
  few.settle(20, warnings);
  REQUIRE(warnings.size() == 1);
  CHECK(warnings[0] == "list.txt: line 7: no stamp: skipped");

  io::BadEntries many("list.txt");
  for (int i = 0; i < 3; ++i) many.add(i, "no stamp");
  const std::string text = testing::error_of([&] { many.settle(20, warnings); });
  CHECK(text == "list.txt: line 0: no stamp (and 2 more bad entries of 20)");

  io::BadEntries all("list.txt");
  all.add("no stamp");
  CHECK(testing::error_of([&] { all.settle(1, warnings); }) == "list.txt: no stamp");
}
