// SPDX-License-Identifier: BSD-3-Clause
// Names of images that hold a date and a time, and those that only look like it.
#include <string>
#include <vector>

#include "io/errors.hpp"
#include "io/image_names.hpp"
#include "sslam/io/datasets/name_dates.hpp"
#include "sslam/io/datasets/open_dataset.hpp"
#include "support/catch.hpp"
#include "support/scratch_folder.hpp"

namespace name_dates_test {
namespace {

using namespace sslam;
using testing::contains, testing::kHalfPastNoon;

using Names = std::vector<std::string>;
using Stamps = std::vector<double>;

io::NameDates dates_of(const Names& names) {
  return io::dates_of_names(testing::images_named(names));
}

TEST_CASE("A date and a time in a name are seconds since 1970, however they are written") {
  const std::string name =
      GENERATE(as<std::string>(), "2024-05-01_12-30-15", "2024-05-01 12:30:15", "2024.05.01-12.30.15",
               "2024_5_1_12_30_15", "IMG_20240501_123015", "20240501T123015Z", "20240501123015",
               "01-20240501123015-00", "2024-05-01T12:30:15z", "2024-05-01T14:30:15+02:00",
               "20240501T143015+0200", "20240501T143015+02", "20240501T070015-0530",
               "2024-05-01T07:00:15-05:30", "2024-05-02 00-30-15+12", "Screenshot from 2024-05-01 12-30-15",
               "Screenshot 2024-05-01 at 12.30.15", "Screenshot 2024-05-01 at 12.30.15 PM",
               "vlcsnap-2024-05-01-12h30m15s", "WhatsApp Image 2024-05-01 at 12.30.15 (1)",
               "20240501_123015_HDR", "192.168.1.64_01_20240501123015_MOTION");
  CAPTURE(name);
  const io::NameDates dates = dates_of({name});
  CHECK(dates.note.starts_with("names are dates and times, such as " + name +
                               ": stamps are seconds since 1970"));
  CHECK(dates.seconds == Stamps{kHalfPastNoon});
}

TEST_CASE("Half days, leap days and leap seconds of a name") {
  CHECK(dates_of({"Screenshot 2024-05-01 at 12.30.15\xe2\x80\xaf"
                  "AM"})
            .seconds == Stamps{kHalfPastNoon - 43200});
  CHECK(dates_of({"Screenshot 2024-05-01 at 1.30.15 pm"}).seconds == Stamps{kHalfPastNoon + 3600});
  CHECK(dates_of({"2024-02-29_00-00-00"}).seconds == Stamps{1709164800});
  CHECK(dates_of({"2016-12-31_23-59-60"}).seconds == Stamps{1483228800});
}

TEST_CASE("Parts of a second in a name, behind a point, another mark or nothing") {
  const Names names = GENERATE(Names{"2024-05-01_12-30-15.250", "2024-05-01_12-30-15.750"},
                               Names{"2024-05-01T12:30:15.25Z", "2024-05-01T12:30:15.75Z"},
                               Names{"20240501_123015_250", "20240501_123015_750"},
                               Names{"2024_05_01_12_30_15_250000", "2024_05_01_12_30_15_750000"},
                               Names{"PXL_20240501_123015250.MP", "PXL_20240501_123015750"},
                               Names{"20240501123015250", "20240501123015750"},
                               Names{"vlcsnap-2024-05-01-12h30m15s250", "vlcsnap-2024-05-01-12h30m15s750"});
  CAPTURE(names.front());
  CHECK(dates_of(names).seconds == Stamps{kHalfPastNoon + 0.25, kHalfPastNoon + 0.75});
}

TEST_CASE("A date without parts of a second beside others is at the full second") {
  const io::NameDates dates = dates_of({"2024-05-01T12:30:15.500000", "2024-05-01T12:30:15"});
  CHECK(dates.seconds == Stamps{kHalfPastNoon + 0.5, kHalfPastNoon});
}

TEST_CASE("Images of one second are spread over it, and those at both ends keep the step") {
  const Names names{"20240501_123015_001", "20240501_123015_002", "20240501_123016_001",
                    "20240501_123016_002", "20240501_123016_003", "20240501_123016_004",
                    "20240501_123017_001"};
  const io::NameDates dates = dates_of(names);
  const double t = kHalfPastNoon;
  CHECK(dates.seconds == Stamps{t + 0.5, t + 0.75, t + 1, t + 1.25, t + 1.5, t + 1.75, t + 2});
  CHECK(contains(dates.note, "; images of one second are spread evenly over it"));
  const io::NameDates phone = dates_of({"20240501_123015(0)", "20240501_123015", "20240501_123018"});
  CHECK(phone.seconds == Stamps{t + 0.5, t, t + 3});
}

TEST_CASE("Dates that are no stamps are told in one note") {
  struct Case {
    Names names;
    std::string why;
  };
  const Case c = GENERATE(
      Case{{"2024-13-01_12-30-15", "2024-13-01_12-30-16"}, "there is no such time as in 2024-13-01_12-30-15"},
      Case{{"20240501_123015", "20240501_126015"}, "there is no such time as in 20240501_126015"},
      Case{{"2023-02-28_00-00-00", "2023-02-29_00-00-00"}, "there is no such time as in 2023-02-29_00-00-00"},
      Case{{"2024-05-01", "2024-05-02"}, "no time to the second, such as 2024-05-01"},
      Case{{"2024-05-01_12-30", "2024-05-01_12-31"}, "no time to the second, such as 2024-05-01_12-30"},
      Case{{"IMG-20240501-WA0001", "IMG-20240501-WA0002"},
           "no time to the second, such as IMG-20240501-WA0001"},
      Case{{"20240501_123015", "frame_7"}, "not all of them, such as frame_7"},
      Case{{"2024-05-01_12-30-15", "20240501_123016"},
           "they have more than one form, such as 2024-05-01_12-30-15 and 20240501_123016"},
      Case{{"20240501_123015_left", "20240501_123015_right"}, "they have more than one form, such as"},
      Case{{"IMG_20240501_123015", "VID_20240501_123016"}, "they have more than one form, such as"},
      Case{{"20240501T123015", "20240501T123016Z"}, "some have a time zone and others have none"},
      Case{{"cam0_20240501_123015", "cam0_20240501_123016", "cam1_20240501_123015"},
           "they go back in time from cam0_20240501_123016 to cam1_20240501_123015"},
      Case{{"20240501_123015.500", "20240501_123015.5"},
           "some are of the same time, such as 20240501_123015.500.png and 20240501_123015.5.png"},
      Case{{"20240501_123015", "20240501_123015"}, "some are of the same time"});
  CAPTURE(c.names);
  const io::NameDates dates = dates_of(c.names);
  CHECK(dates.seconds.empty());
  CHECK(contains(dates.note, "names hold dates, but " + c.why));
}

TEST_CASE("Numbers of other names are no dates, and nothing is said of them") {
  const Names names = GENERATE(Names{"frame_00000001", "frame_00000002"}, Names{"20100101", "20109999"},
                               Names{"1341836537.655662", "1341836537.687415"},
                               Names{"1341836537655662000", "1341836537687415000"},
                               Names{"0001_000001", "0001_000002"}, Names{"a", "b"}, Names{});
  const io::NameDates dates = dates_of(names);
  CHECK(dates.seconds.empty());
  CHECK(dates.note.empty());
}

TEST_CASE("A time of day without a date is seconds since midnight, however it is written") {
  const Names names =
      GENERATE(Names{"12-30-15", "12-30-17"}, Names{"12:30:15.0", "12:30:17.0"},
               Names{"cam0_12_30_15", "cam0_12_30_17"}, Names{"12h30m15s", "12h30m17s"},
               Names{"12-30-15_000", "12-30-17_000"}, Names{"Screen 9.30.15 AM", "Screen 9.30.17 AM"},
               Names{"240501_12-30-15", "240501_12-30-17"}, Names{"01-05-24_12-30-15", "01-05-24_12-30-17"},
               Names{"001_12-30-15", "002_12-30-17"});
  CAPTURE(names.front());
  const double start = names.front().find('9') == std::string::npos ? 45015 : 34215;
  const io::NameDates times = dates_of(names);
  CHECK(times.seconds == Stamps{start, start + 2});
  CHECK(times.note ==
        "names are times of day, such as " + names.front() + ": stamps are seconds since midnight");
}

TEST_CASE("Digits alone are a time of day where a minute ends as on a clock") {
  CHECK(dates_of({"123058", "123059", "123100", "123101"}).seconds == Stamps{45058, 45059, 45060, 45061});
  CHECK(dates_of({"123059.750", "123100.250"}).seconds.empty());  // two numbers have but one step
  CHECK(dates_of({"123059.750", "123100.250", "123100.500"}).seconds == Stamps{45059.75, 45060.25, 45060.5});
  CHECK(dates_of({"22-05-01_12-30-15_250", "22-05-01_12-30-15_500"}).seconds == Stamps{45015.25, 45015.5});
  CHECK(dates_of({"123059750", "123100250", "123100500"}).seconds == Stamps{45059.75, 45060.25, 45060.5});
  CHECK(dates_of({"230501_123059", "230501_123100", "230501_123102"}).seconds == Stamps{45059, 45060, 45062});
  const Names counters =
      GENERATE(Names{"000058", "000059", "000100"}, Names{"120058", "120060", "120100"},
               Names{"120000", "120100", "120200", "120300"}, Names{"123001.5", "123002.5", "123004.5"});
  CAPTURE(counters.front());
  const io::NameDates none = dates_of(counters);
  CHECK(none.seconds.empty());
  CHECK(none.note.empty());
}

TEST_CASE("Times of day may go over midnight") {
  const io::NameDates sorted = dates_of({"00-00-01", "23-59-58", "23-59-59"});
  CHECK(sorted.seconds == Stamps{86401, 86398, 86399});
  CHECK(contains(sorted.note, "; those of the morning are of the next day"));
  CHECK(dates_of({"1_23-59-59", "2_00-00-01"}).seconds == Stamps{86399, 86401});
  CHECK(contains(dates_of({"1_12-30-15", "2_12-30-14"}).note,
                 "names hold times, but they go back in time from 1_12-30-15 to 2_12-30-14"));
}

TEST_CASE("The one date in the names of a video's frames is the video's") {
  const io::NameDates dates = dates_of({"VID_20240501_123015_0001", "VID_20240501_123015_0002"});
  CHECK(dates.seconds.empty());
  CHECK(contains(dates.note, "names hold dates, but too many are of one second"));
  CHECK(dates_of({"12-30-15_0001", "12-30-15_0002"}).note.empty());
  Names two;
  for (int i = 0; i < 600; ++i)
    two.push_back((i < 300 ? "20240501_123015_" : "20240501_124500_") + std::to_string(1000 + i));
  CHECK(dates_of(two).seconds.empty());
}

TEST_CASE("A folder of images with dates for names has these stamps, and says how it reads them") {
  const testing::ScratchFolder scratch;
  SECTION("every image has one") {
    for (const char* name : {"IMG_20240501_123015.jpg", "IMG_20240501_123017.jpg"}) scratch.write(name);
    const io::Dataset dataset = io::open_dataset(scratch.path());
    CHECK(dataset.frames[0].stamp == kHalfPastNoon);
    CHECK(dataset.frames[1].stamp == kHalfPastNoon + 2);
    REQUIRE(dataset.warnings.size() == 1);
    CHECK(dataset.warnings[0] == scratch.path().string() +
                                     ": names are dates and times, such as IMG_20240501_123015: stamps are "
                                     "seconds since 1970, as if in UTC");
  }
  SECTION("one has none") {
    for (const char* name : {"IMG_20240501_123015.jpg", "frame.jpg"}) scratch.write(name);
    const io::Dataset dataset = io::open_dataset(scratch.path(), {.frame_rate = 10});
    CHECK(dataset.frames[1].stamp == 0.1);
    REQUIRE(dataset.warnings.size() == 1);
    CHECK(dataset.warnings[0] ==
          scratch.path().string() +
              ": names hold dates, but not all of them, such as frame: images are counted, "
              "at the frame rate");
  }
  SECTION("one image alone needs no clock") {
    scratch.write("IMG_20240501_123015.jpg");
    CHECK(io::open_dataset(scratch.path()).warnings.empty());
  }
}

}  // namespace
}  // namespace name_dates_test
