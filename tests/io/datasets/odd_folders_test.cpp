// SPDX-License-Identifier: BSD-3-Clause
// Folders near a layout: lists with other columns, fewer poses than images, depth that is no image.
#include <cmath>
#include <string>
#include <utility>

#include "io/errors.hpp"
#include "sslam/io/datasets/open_dataset.hpp"
#include "support/scratch_folder.hpp"

namespace odd_folders_test {
namespace {

using namespace sslam;
using testing::contains;
using testing::error_of;
using testing::ScratchFolder;

std::string stamp(int i) {
  return std::to_string(1403636579763555584 + i * 50000000LL);
}

constexpr int kImages = 4;

// EuRoC's images, with rows as `row` makes them of a stamp.
template <class Row>
io::Dataset open_euroc(const ScratchFolder& scratch, Row row) {
  std::string list = "#timestamp [ns],filename\n";
  for (int i = 0; i < kImages; ++i) {
    scratch.write("mav0/cam0/data/" + stamp(i) + ".png");
    list += row(stamp(i));
  }
  scratch.write("mav0/cam0/data.csv", list);
  return io::open_dataset(scratch.path());
}

std::string moved(int x) {
  return "1 0 0 " + std::to_string(x) + " 0 1 0 0 0 0 1 0";
}

}  // namespace

TEST_CASE("A list names its files by a folder above, without extension, or by the stamp alone") {
  using Text = std::string;
  const ScratchFolder scratch;
  const int kind = GENERATE(0, 1, 2, 3, 4, 5);
  CAPTURE(kind);
  const io::Dataset dataset = open_euroc(scratch, [kind](const Text& s) -> Text {
    switch (kind) {
      case 0:
        return s + ",data/" + s + ".png\n";
      case 1:
        return s + ",mav0/cam0/data/" + s + ".png\n";
      case 2:
        return s + "," + s + "\n";
      case 3:
        return s + "\n";
      case 4:
        return s + ".png," + s + "\n";
      default:
        return s.substr(0, 10) + "," + s.substr(10) + ";" + s + ".png\n\n";
    }
  });
  REQUIRE(dataset.frames.size() == kImages);
  for (int i = 0; i < kImages; ++i) {
    CHECK(contains(dataset.frames[i].image, "data/" + stamp(i) + ".png"));
    CHECK(std::abs(dataset.frames[i].stamp - 1403636579.763555584 - 0.05 * i) < 1e-6);
  }
}

TEST_CASE("Two numbers before a file are refused, not guessed at") {
  const ScratchFolder scratch;
  scratch.write("rgb/a.png");
  const std::string row =
      GENERATE(as<std::string>(), "1305031102,175304 rgb/a.png", "0 1305031102.17 rgb/a.png");
  scratch.write("rgb.txt", row + "\n");
  const std::string error = error_of([&] { (void)io::open_dataset(scratch.path()); });
  CHECK(contains(error, "rgb.txt: line 1: has two numbers before the file; expected 'stamp file'"));
}

TEST_CASE("Associations of any name, with depth first") {
  const ScratchFolder scratch;
  std::string list;
  for (int i = 0; i < kImages; ++i) {
    const std::string number = std::to_string(i);
    scratch.write("rgb/" + number + ".png");
    scratch.write("depth/" + number + ".png");
    list += "130.1" + number + " depth/" + number + ".png 130.1" + number + " rgb/" + number + ".png\n";
  }
  scratch.write(GENERATE(as<std::string>(), "assoc.txt", "fr1_associated.txt"), list);
  const io::Dataset dataset = io::open_dataset(scratch.path());
  REQUIRE(dataset.frames.size() == kImages);
  CHECK(dataset.layout == io::Layout::kTum);
  CHECK(contains(dataset.frames[1].image, "rgb/1.png"));
  CHECK(contains(dataset.frames[1].depth, "depth/1.png"));
  CHECK(dataset.frames[1].stamp == 130.11);
}

TEST_CASE("Replica: fewer poses than images are told") {
  const ScratchFolder scratch;
  for (int i = 0; i < kImages; ++i) scratch.write("results/frame00000" + std::to_string(i) + ".jpg");
  scratch.write("traj.txt", moved(0) + " 0 0 0 1\n" + moved(1) + " 0 0 0 1\n");
  const io::Dataset dataset = io::open_dataset(scratch.path());
  CHECK(dataset.ground_truth.size() == 2);
  REQUIRE(dataset.warnings.size() == 1);
  CHECK(contains(dataset.warnings[0], "traj.txt: its 2 rows leave 2 of 4 images without ground truth"));
}

TEST_CASE("KITTI: more times than images do not cost the ground truth") {
  const ScratchFolder scratch;
  std::string poses;
  for (int i = 0; i < kImages; ++i) {
    scratch.write("image_0/00000" + std::to_string(i) + ".png");
    poses += moved(i) + "\n";
  }
  scratch.write("times.txt", "0\n0.1\n0.25\n0.3\n0.4\n0.5\n");
  scratch.write("poses.txt", poses);
  const io::Dataset dataset = io::open_dataset(scratch.path());
  CHECK(dataset.warnings.empty());
  REQUIRE(dataset.frames.size() == kImages);
  CHECK(dataset.frames[2].stamp == 0.25);
  CHECK(dataset.world_from_cam(dataset.frames[2])->translation.x() == 2);
}

TEST_CASE("Depth that is no image costs the depth, not the run") {
  const ScratchFolder scratch;
  const std::string colour = GENERATE(as<std::string>(), "color", "rgb");
  for (int i = 0; i < kImages; ++i) {
    scratch.write(colour + "/" + std::to_string(i) + ".png");
    scratch.write("depth/" + std::to_string(i) + ".npy");
  }
  const io::Dataset dataset = io::open_dataset(scratch.path());
  CHECK(dataset.frames.size() == kImages);
  CHECK(dataset.frames[0].depth.empty());
  REQUIRE(dataset.warnings.size() == 1);
  CHECK(contains(dataset.warnings[0], "depth: 0.npy is in no format that is read: depth left out"));
}

TEST_CASE("A sequence of images by the pattern of their numbers") {
  const ScratchFolder scratch;
  for (const char* name : {"img_0001.png", "img_0002.png", "img_0010.png", "img_0002_mask.png", "img_3.png"})
    scratch.write(name);
  CHECK(io::open_dataset(scratch.path() / "img_%04d.png").frames.size() == 3);
  CHECK(io::open_dataset(scratch.path() / "img_%d.png").frames.size() == 1);
  CHECK(contains(error_of([&] { (void)io::open_dataset(scratch.path() / "img_%05d.png"); }),
                 "img_%05d.png: no image matches"));
}

TEST_CASE("A folder of images that are not read is told by their format") {
  const ScratchFolder scratch;
  for (const char* name : {"1.heic", "2.HEIC", "3.heic"}) scratch.write(name);
  CHECK(contains(error_of([&] { (void)io::open_dataset(scratch.path()); }),
                 "no dataset here: 3 files such as 1.heic are in a format that is not read"));
}

TEST_CASE("A video is told by its content where its name does not tell") {
  using namespace std::string_literals;
  const ScratchFolder scratch;
  const std::string start = GENERATE(as<std::string>(),
                                     "\0\0\0\x20"
                                     "ftypisom"s,
                                     "\x1A\x45\xDF\xA3\1"s, "RIFF\0\0\0\0AVI LIST"s, "OggS\0"s,
                                     "\0\0\1\xBA\0"s, "\0\0\0\1\x67\x42"s, "YUV4MPEG2 W320"s);
  const auto file = scratch.write("recording", start + std::string(600, '.'));
  CHECK(io::open_dataset(file).layout == io::Layout::kVideo);
  const auto photo = scratch.write("photo",
                                   "\0\0\0\x20"
                                   "ftypheic"s);
  CHECK(contains(error_of([&] { (void)io::open_dataset(photo); }), "is neither a folder nor a video"));
}

TEST_CASE("Depth images have the names of colour images whatever their format") {
  const ScratchFolder scratch;
  for (const char* name : {"hall", "door"}) {
    scratch.write("color/" + std::string(name) + ".jpg");
    scratch.write("depth/" + std::string(name) + ".tiff");
  }
  const io::Dataset dataset = io::open_dataset(scratch.path());
  REQUIRE(dataset.frames.size() == 2);
  CHECK(contains(dataset.frames[0].depth, "depth/door.tiff"));
  CHECK(dataset.warnings.empty());
  scratch.write("depth/door.jpg");  // a picture of it
  scratch.write("depth/door.png");
  CHECK(contains(io::open_dataset(scratch.path()).frames[0].depth, "depth/door.png"));
}

TEST_CASE("Recordings in formats of their own are refused with the way to images") {
  const ScratchFolder scratch;
  for (const auto& [name, text] : {std::pair{"scene.sens", "extract it with ScanNet's SensReader"},
                                   {"walk.SVO2", "is a recording of the ZED SDK"},
                                   {"scan.r3d", "is a recording of Record3D"},
                                   {"room.tar.gz", "is an archive; unpack it"},
                                   {"list.txt", "a list of images is read as rgb.txt in a folder"}}) {
    INFO(name);
    const std::string file = scratch.write(name, "x").string();
    CHECK(contains(error_of([&] { (void)io::open_dataset(file); }), file + ": "));
    CHECK(contains(error_of([&] { (void)io::open_dataset(file); }), text));
  }
}

}  // namespace odd_folders_test
