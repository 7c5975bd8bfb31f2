// SPDX-License-Identifier: BSD-3-Clause
// Lists as people's programs write them.
#include "sslam/io/datasets/file_list.hpp"

#include <string>

#include "io/errors.hpp"
#include "sslam/io/datasets/open_dataset.hpp"
#include "support/scratch_folder.hpp"

using namespace sslam;
using testing::contains;
using testing::error_of;
using testing::ScratchFolder;

namespace {

// The folder as rgb.txt says, whose five images are there.
io::Dataset open_list(const ScratchFolder& scratch, const std::string& list) {
  for (const char* name : {"rgb/0.png", "rgb/1.png", "rgb/2.png", "rgb/3.png", "rgb/4.png"})
    scratch.write(name);
  scratch.write("rgb.txt", list);
  return io::open_dataset(scratch.path());
}

std::string row_list(const std::string& between, const std::string& quote, const std::string& line_end) {
  std::string list;
  for (int i = 0; i < 5; ++i)
    list +=
        "0." + std::to_string(i) + between + quote + "rgb/" + std::to_string(i) + ".png" + quote + line_end;
  return list;
}

std::string as_utf16(const std::string& text, bool high_first) {
  std::string wide;
  for (const char c : text) {
    if (high_first) wide += '\0';
    wide += c;
    if (!high_first) wide += '\0';
  }
  return wide;
}

}  // namespace

TEST_CASE("A list reads the same in whatever encoding and with whatever separators it is written") {
  const ScratchFolder scratch;
  const std::string plain = row_list(" ", "", "\n");
  const auto list = GENERATE_COPY(
      as<std::string>{}, plain, "\xEF\xBB\xBF" + row_list(" ", "", "\r\n"), row_list("\t", "", "\r"),
      "\xFF\xFE" + as_utf16(plain, false), "\xFE\xFF" + as_utf16(plain, true), as_utf16(plain, false),
      "timestamp,filename\n" + row_list(",", "\"", "\n"), row_list(";", "", "\n"), row_list(" , ", "'", "\n"),
      row_list("; ", "\"", "\r\n"), row_list("|", "", "\n"), "stamp | file\n" + row_list(" | ", "", "\n"));
  const io::Dataset dataset = open_list(scratch, list);
  CHECK(dataset.warnings.empty());
  REQUIRE(dataset.frames.size() == 5);
  for (std::size_t i = 0; i < 5; ++i) {
    CHECK(dataset.frames[i].stamp == Approx(0.1 * static_cast<double>(i)));
    CHECK(dataset.frames[i].image == scratch.path() / ("rgb/" + std::to_string(i) + ".png"));
  }
}

TEST_CASE("Names in lists may hold blanks, commas and backslashes, and have columns behind them") {
  const ScratchFolder scratch;
  for (const char* name : {"my images/im 1.jpg", "my images/a, b.jpg", "my images/c.jpg (2).jpg"})
    scratch.write(name);
  const io::Dataset dataset = open_list(scratch,
                                        "0.1 my images/im 1.jpg\n0.2 my images/a, b.jpg\n0.3 rgb\\2.png\n"
                                        "0.4,rgb/3.png,0.012,17\n0.5 my images/c.jpg (2).jpg\n"
                                        "0.6 /home/somebody/recording/rgb/4.png\n0.7 C:\\data\\rgb\\1.png\n");
  CHECK(dataset.warnings.empty());
  REQUIRE(dataset.frames.size() == 7);
  const char* expected[] = {"my images/im 1.jpg",      "my images/a, b.jpg", "rgb/2.png", "rgb/3.png",
                            "my images/c.jpg (2).jpg", "rgb/4.png",          "rgb/1.png"};
  for (std::size_t i = 0; i < 7; ++i) CHECK(dataset.frames[i].image == scratch.path() / expected[i]);
}

TEST_CASE("A list names files in the folder of its own name, by addresses, or with capital letters") {
  const ScratchFolder scratch;
  const io::Dataset dataset = open_list(scratch, "0.1 1.png\n0.2 2.PNG\n0.3 file:///home/me/rgb/3.png\n");
  REQUIRE(dataset.frames.size() == 3);
  for (std::size_t i = 0; i < 3; ++i)
    CHECK(std::filesystem::path(dataset.frames[i].image).filename() == std::to_string(i + 1) + ".png");
  CHECK(dataset.warnings.empty());
}

TEST_CASE("A name with blanks that is not there is told whole") {
  const ScratchFolder scratch;
  CHECK(contains(error_of([&] { (void)open_list(scratch, "0.1 my images/im 1.jpg\n"); }),
                 "my images/im 1.jpg, which"));
}

TEST_CASE("Lists are sorted, and of equal stamps the first image is kept") {
  const ScratchFolder scratch;
  const io::Dataset dataset =
      open_list(scratch, "0.4 rgb/4.png\n0.1 rgb/1.png\n0.3 rgb/3.png\n0.1 rgb/0.png\n0.2 rgb/2.png\n");
  REQUIRE(dataset.frames.size() == 4);
  CHECK(dataset.frames[0].image == scratch.path() / "rgb/1.png");
  CHECK(dataset.frames[3].image == scratch.path() / "rgb/4.png");
  CHECK(dataset.frames[3].index == 3);
  REQUIRE(dataset.warnings.size() == 2);
  CHECK(contains(dataset.warnings[0], "rgb.txt: stamps go backwards at 0.100000: images sorted"));
  CHECK(contains(dataset.warnings[1], "rgb.txt: 1 repeated stamps, the first at 0.100000"));
}

TEST_CASE("Stamps of a list are turned into seconds and their unit is named") {
  const ScratchFolder scratch;
  struct Case {
    std::string start;  // before the two digits of tenths of seconds
    std::string unit;
    double first;
  };
  const Case c = GENERATE(Case{"13418365370", "milliseconds", 1341836537.0},
                          Case{"13418365370", "microseconds", 1341836537.0},
                          Case{"13418365370", "nanoseconds", 1341836537.0}, Case{"", "milliseconds", 0.0},
                          Case{"", "microseconds", 0.0}, Case{"", "nanoseconds", 0.0});
  const std::size_t zeros = c.unit == "milliseconds" ? 2 : (c.unit == "microseconds" ? 5 : 8);
  std::string list;
  for (int i = 0; i < 5; ++i) {
    const std::string second = c.start.empty() ? "" : c.start.substr(0, 10);
    list += second + std::to_string(i) + std::string(zeros, '0') + " rgb/" + std::to_string(i) + ".png\n";
  }
  const io::Dataset dataset = open_list(scratch, list);
  REQUIRE(dataset.warnings.size() == 1);
  CHECK(contains(dataset.warnings[0], "rgb.txt: stamps in " + c.unit));
  REQUIRE(dataset.frames.size() == 5);
  for (std::size_t i = 0; i < 5; ++i)
    CHECK(dataset.frames[i].stamp ==
          Approx(c.first + 0.1 * static_cast<double>(i)).epsilon(1e-13).margin(1e-9));
}

TEST_CASE("A gap of an hour does not change the unit of a list") {
  const ScratchFolder scratch;
  const io::Dataset dataset =
      open_list(scratch, "0 rgb/0.png\n0.1 rgb/1.png\n0.2 rgb/2.png\n3600.3 rgb/3.png\n3600.4 rgb/4.png\n");
  CHECK(dataset.warnings.empty());
  CHECK(dataset.frames[4].stamp == 3600.4);
}

TEST_CASE("Associations alone are a dataset, with the depth image first or last") {
  const ScratchFolder scratch;
  std::string list, truth;
  const bool depth_first = GENERATE(false, true);
  for (int i = 0; i < 5; ++i) {
    const std::string n = std::to_string(i), stamp = "100." + n + " ", later = "100." + n + "04 ";
    const std::string rgb = "rgb/" + n + ".png", depth = "depth/" + n + ".png";
    scratch.write(rgb);
    scratch.write(depth);
    list += depth_first ? later + depth + ' ' + stamp + rgb + '\n' : stamp + rgb + ' ' + later + depth + '\n';
    truth += stamp + n + " 0 0 0 0 0 1\n";
  }
  scratch.write("associations.txt", list);
  scratch.write("groundtruth.txt", truth);
  const io::Dataset dataset = io::open_dataset(scratch.path());
  CHECK(dataset.layout == io::Layout::kTum);
  CHECK(dataset.warnings.empty());
  REQUIRE(dataset.frames.size() == 5);
  CHECK(dataset.frames[2].stamp == 100.2);
  CHECK(dataset.frames[2].image == scratch.path() / "rgb/2.png");
  CHECK(dataset.frames[2].depth == scratch.path() / "depth/2.png");
  CHECK(dataset.world_from_cam(dataset.frames[2])->translation.x() == 2);
}

TEST_CASE("Names of images are stamps in the unit that they can only have") {
  struct Case {
    std::vector<std::string> names;
    double first, second;
  };
  const Case c =
      GENERATE(Case{{"1341836537033332992", "1341836537100000000"}, 1341836537.033333, 1341836537.1},
               Case{{"1341836537033333", "1341836537100000"}, 1341836537.033333, 1341836537.1},
               Case{{"1341836537033", "1341836537100"}, 1341836537.033, 1341836537.1},
               Case{{"1341836537.033333", "1341836537.1"}, 1341836537.033333, 1341836537.1},
               Case{{"1341836537_033332992", "1341836537_100000000"}, 1341836537.033333, 1341836537.1},
               Case{{"1341836537_33332992", "1341836537_100000000"}, 1341836537.033333, 1341836537.1},
               Case{{"1341836537-033333", "1341836537-100000"}, 1341836537.033333, 1341836537.1},
               Case{{"0", "33000000", "66000000", "99000000"}, 0, 0.033},
               Case{{"10", "20", "30", "40"}, 0, 0.1},                              // counters
               Case{{"20230815093012", "20230815093013"}, 1692091812, 1692091813},  // dates
               Case{{"0001_000001", "0001_000002"}, 0, 0.1},                        // a run and a counter
               Case{{"0000000001", "0000000002"}, 0, 0.1});
  const ScratchFolder scratch;
  for (const std::string& name : c.names) {
    scratch.write(name + ".png");
    scratch.write("._" + name + ".png");     // as macOS leaves them
    scratch.write("." + name + ".tmp.jpg");  // as other programs do
  }
  const io::Dataset dataset = io::open_dataset(scratch.path(), {.frame_rate = 10});
  REQUIRE(dataset.frames.size() == c.names.size());
  CHECK(std::abs(dataset.frames[0].stamp - c.first) < 1e-6);
  CHECK(std::abs(dataset.frames[1].stamp - c.second) < 1e-6);
}
