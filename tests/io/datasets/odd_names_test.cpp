// SPDX-License-Identifier: BSD-3-Clause
// Names of images that hold stamps behind other text, dates with short years, and four numbers.
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "io/errors.hpp"
#include "io/image_names.hpp"
#include "sslam/io/datasets/name_stamps.hpp"
#include "support/catch.hpp"

namespace odd_names_test {
namespace {

using namespace sslam;
using testing::contains, testing::kHalfPastNoon;

using Names = std::vector<std::string>;
using Stamps = std::vector<double>;

io::NameStamps stamps_of(const Names& names) {
  return io::stamps_of_names(testing::images_named(names));
}

}  // namespace

TEST_CASE("A stamp since 1970 may stand within the names") {
  const Names names = GENERATE(Names{"frame_1700000000250000", "frame_1700000000750000"},
                               Names{"img-1700000000250", "img-1700000000750"},
                               Names{"1700000000250000000_left", "1700000000750000000_left"},
                               Names{"cam0_1700000000.25", "cam0_1700000000.75"},
                               Names{"cam0_1700000000_250000000", "cam0_1700000000_750000000"},
                               Names{"1700000000 250000000", "1700000000 750000000"});
  CAPTURE(names.front());
  const Stamps seconds = stamps_of(names).seconds;
  REQUIRE(seconds.size() == 2);
  CHECK(std::abs(seconds[0] - 1700000000.25) < 1e-6);
  CHECK(std::abs(seconds[1] - 1700000000.75) < 1e-6);
}

TEST_CASE("What the stamp within a name is, is told") {
  CHECK(contains(stamps_of({"img-1700000000250", "img-1700000000750"}).note,
                 "1700000000250 of img-1700000000250: stamps in milliseconds"));
}

TEST_CASE("Numbers within names that are no stamps, and stamps behind two texts, are left alone") {
  const Names names =
      GENERATE(Names{"frame_000001", "frame_000002"}, Names{"a_1700000000250", "b_1700000000750"},
               Names{"cam_123456789", "cam_123456790"}, Names{"photo_1234567890", "photo_1234567891"},
               Names{"1700000000250_a1", "1700000000750_a2"});
  CAPTURE(names.front());
  CHECK(stamps_of(names).seconds.empty());
}

TEST_CASE("Dates with years of two digits, where the time alone does not tell") {
  const Names names = GENERATE(Names{"240501123015", "240501123017"}, Names{"240501_123015", "240501_123017"},
                               Names{"cam_240501-123015_1", "cam_240501-123017_2"},
                               Names{"IMG_240501 123015", "IMG_240501 123017"});
  CAPTURE(names.front());
  const io::NameStamps stamps = stamps_of(names);
  CHECK(stamps.seconds == Stamps{kHalfPastNoon, kHalfPastNoon + 2});
  CHECK(contains(stamps.note, "names are dates and times, such as " + names.front()));
  CHECK(stamps_of({"240501123059", "240501123100", "240501123102"}).seconds ==
        Stamps{kHalfPastNoon + 44, kHalfPastNoon + 45, kHalfPastNoon + 47});
}

TEST_CASE("Numbers behind a date with a short year are no time if they count") {
  const Names names = GENERATE(Names{"240501_000001", "240501_000002"}, Names{"240501000001", "240501000002"},
                               Names{"100101000000", "100101000061"}, Names{"241301123015", "241301123016"});
  CAPTURE(names.front());
  CHECK(stamps_of(names).seconds.empty());
}

TEST_CASE("Of four numbers the last is a second, unless it counts within one") {
  const double half_past = (12 * 60 + 30) * 60, two = (2 * 60 + 12) * 60;
  CHECK(stamps_of({"02_12_30_58", "02_12_30_59", "02_12_31_00"}).seconds ==
        Stamps{half_past + 58, half_past + 59, half_past + 60});
  CHECK(stamps_of({"02_12_30_03", "02_12_30_21", "02_12_31_17"}).seconds ==
        Stamps{half_past + 3, half_past + 21, half_past + 77});
  CHECK(stamps_of({"02_12_30_00", "02_12_30_01", "02_12_31_00", "02_12_31_01"}).seconds ==
        Stamps{two + 30, two + 30.5, two + 31, two + 31.5});
  CHECK(stamps_of({"02_12_30_07", "02_12_30_08", "02_12_31_09", "02_12_31_10"}).seconds ==
        Stamps{two + 30, two + 30.5, two + 31, two + 31.5});
}

}  // namespace odd_names_test
