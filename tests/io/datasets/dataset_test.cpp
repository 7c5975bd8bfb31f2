// SPDX-License-Identifier: BSD-3-Clause
// Each layout read from a folder made for the test, and the recordings where they are at hand.
#include <cstdio>
#include <string>

#include "io/errors.hpp"
#include "io/shared_data.hpp"
#include "sslam/io/datasets/known_cameras.hpp"
#include "sslam/io/datasets/open_dataset.hpp"
#include "support/scratch_folder.hpp"

using namespace sslam;
using testing::contains;
using testing::error_of;
using testing::ScratchFolder;

namespace {

constexpr const char* kIdentity = " 0 0 0 0 0 0 1\n";

// rgb.txt with `count` frames at 30 Hz from second 100 on, their files, and a ground truth at 100 Hz.
void make_tum(const ScratchFolder& scratch, int count) {
  std::string list = "# file: 'rgbd_dataset_freiburg2_desk.bag'\n";
  std::string truth;
  for (int i = 0; i < count; ++i) {
    const std::string name = "rgb/" + std::to_string(i) + ".png";
    scratch.write(name);
    list += io::exact_decimal(100 + i / 30.0) + " " + name + "\n";
  }
  for (int i = 0; i < 4 * count; ++i)
    truth += io::exact_decimal(100.003 + i / 100.0) + " " + std::to_string(i) + " 0 0 0 0 0 1\n";
  scratch.write("rgb.txt", list);
  scratch.write("groundtruth.txt", truth);
}

void append(const std::filesystem::path& path, const std::string& text) {
  std::ofstream(path, std::ios::app) << text;
}

std::string error_opening(const std::filesystem::path& path) {
  const std::string text = error_of([&] { (void)io::open_dataset(path); });
  CHECK(testing::is_one_line(text));
  return text;
}

}  // namespace

TEST_CASE("TUM layout: images with depth and truth by nearest stamp") {
  const ScratchFolder scratch;
  make_tum(scratch, 12);
  scratch.write("depth/a.png");
  scratch.write("depth.txt",
                "100.004 depth/a.png\n100.055 depth/a.png\n");  // the second is 22 ms from any image
  const io::Dataset dataset = io::open_dataset(scratch.path());
  CHECK(dataset.layout == io::Layout::kTum);
  CHECK(dataset.warnings.empty());
  REQUIRE(dataset.frames.size() == 12);
  CHECK(dataset.frames[3].index == 3);
  CHECK(dataset.frames[3].stamp == 100 + 3 / 30.0);
  CHECK(dataset.frames[3].image == scratch.path() / "rgb/3.png");
  CHECK(dataset.frames[0].depth == scratch.path() / "depth/a.png");
  CHECK(dataset.frames[3].depth.empty());
  REQUIRE(dataset.world_from_cam(dataset.frames[3]) != nullptr);
  CHECK(dataset.world_from_cam(dataset.frames[3])->translation.x() == 10);  // 100.103 is nearest to 100.1
  CHECK(dataset.ground_truth.size() == 48);
  CHECK(io::known_camera_for(dataset)->name == "tum_fr2");
}

TEST_CASE("TUM layout: a single bad frame in the middle is skipped with its name") {
  const ScratchFolder scratch;
  make_tum(scratch, 30);
  SECTION("its file is not there") {
    std::filesystem::remove(scratch.path() / "rgb/7.png");
    const io::Dataset dataset = io::open_dataset(scratch.path());
    CHECK(dataset.frames.size() == 29);
    CHECK(dataset.frames[7].index == 7);
    REQUIRE(dataset.warnings.size() == 1);
    CHECK(contains(dataset.warnings[0], "rgb/7.png, which is not there: skipped"));
  }
  SECTION("its stamp goes backwards") {
    append(scratch.path() / "rgb.txt", "100.51 rgb/5.png\n");
    const io::Dataset dataset = io::open_dataset(scratch.path());
    REQUIRE(dataset.frames.size() == 31);
    CHECK(dataset.frames[16].image == scratch.path() / "rgb/5.png");
    CHECK(dataset.frames[16].index == 16);
    REQUIRE(dataset.warnings.size() == 1);
    CHECK(contains(dataset.warnings[0], "stamps go backwards at 100.510000: images sorted by stamp"));
  }
  SECTION("its stamp repeats") {
    append(scratch.path() / "rgb.txt", io::exact_decimal(100 + 29 / 30.0) + " rgb/3.png\n");
    const io::Dataset dataset = io::open_dataset(scratch.path());
    CHECK(dataset.frames.back().image == scratch.path() / "rgb/29.png");
    REQUIRE(dataset.warnings.size() == 1);
    CHECK(contains(dataset.warnings[0], "1 repeated stamps, the first at 100.96"));
  }
  SECTION("its row is cut off") {
    append(scratch.path() / "rgb.txt", "101.2\n");
    const io::Dataset dataset = io::open_dataset(scratch.path());
    REQUIRE(dataset.warnings.size() == 1);
    CHECK(contains(dataset.warnings[0], "rgb.txt: line 32: expected 'stamp file'"));
  }
  SECTION("its depth is not there") {
    scratch.write("depth.txt", "100.0 depth/gone.png\n");
    const io::Dataset dataset = io::open_dataset(scratch.path());
    CHECK(dataset.frames.size() == 30);
    REQUIRE(dataset.warnings.size() == 1);
    CHECK(contains(dataset.warnings[0], "1 of 1 depth images are missing"));
  }
}

TEST_CASE("TUM layout: a list that is wrong as a whole is an error") {
  const ScratchFolder scratch;
  make_tum(scratch, 30);
  SECTION("no image of it is there") {
    std::filesystem::remove_all(scratch.path() / "rgb");
    const std::string text = error_opening(scratch.path());
    CHECK(contains(text, "rgb.txt: names "));
    CHECK(contains(text, "which is not there (and 29 more bad entries of 30)"));
  }
  SECTION("it is empty") {
    scratch.write("rgb.txt", "# nothing\n");
    CHECK(contains(error_opening(scratch.path()), "rgb.txt: names no image"));
  }
  SECTION("its stamps all repeat") {
    std::string list;
    for (int i = 0; i < 30; ++i) list += "1.0 rgb/0.png\n";
    scratch.write("rgb.txt", list);
    CHECK(contains(error_opening(scratch.path()),
                   "all 30 images have the stamp 1.000000; stamps must increase"));
  }
}

TEST_CASE("A sequence is not refused for a ground truth that cannot be used") {
  const ScratchFolder scratch;
  make_tum(scratch, 30);
  const auto problem = [&](const std::string& truth) {
    scratch.write("groundtruth.txt", truth);
    const io::Dataset dataset = io::open_dataset(scratch.path());
    CHECK(dataset.frames.size() == 30);
    CHECK(dataset.ground_truth.empty());
    CHECK(dataset.world_from_cam(dataset.frames[3]) == nullptr);
    REQUIRE_FALSE(dataset.warnings.empty());
    CHECK(contains(dataset.warnings.back(), "ground truth left out"));
    return dataset.truth_problem;
  };
  const std::string other_clock = problem("1" + std::string(kIdentity) + "2" + kIdentity);
  CHECK(contains(other_clock, "groundtruth.txt: no overlap with the images"));
  CHECK(contains(other_clock, "from 1.000000 to 2.000000, theirs from 100.000000 to 100.966"));
  CHECK(contains(problem(""), "holds no pose"));
  CHECK(contains(problem("an odd file\nof words\n"), "line 2: has 2 columns"));
  CHECK(contains(problem("100.1 nan nan nan nan nan nan nan\n"), "all 1 rows say that there is none"));
}

TEST_CASE("A ground truth in another unit than the images is brought to their clock") {
  const ScratchFolder scratch;
  make_tum(scratch, 30);
  std::string truth;  // milliseconds at 100 Hz: too small for a clock's time, too regular for a choice
  for (int i = 0; i < 100; ++i)
    truth += std::to_string(100000 + 10 * i) + ' ' + std::to_string(i) + " 0 0 0 0 0 1\n";
  scratch.write("groundtruth.txt", truth);
  const io::Dataset dataset = io::open_dataset(scratch.path());
  REQUIRE(dataset.warnings.size() == 1);
  CHECK(contains(dataset.warnings[0], "groundtruth.txt: stamps in milliseconds"));
  CHECK(dataset.world_from_cam(dataset.frames[3])->translation.x() == 10);
}

TEST_CASE("ICL-NUIM layout: numbers are stamps and poses are turned to y down") {
  const ScratchFolder scratch;
  for (int i = 1; i <= 11; ++i) scratch.write("rgb/" + std::to_string(i) + ".png");
  scratch.write("depth/2.png");
  std::string truth;
  for (int i = 2; i <= 20; ++i)
    truth += std::to_string(i) + " 0.1 0.2 " + std::to_string(i) + " 0.6 0 0 0.8\n";
  scratch.write("traj0.gt.freiburg", truth);
  const io::Dataset dataset = io::open_dataset(scratch.path());
  CHECK(dataset.layout == io::Layout::kIclNuim);
  CHECK(dataset.seconds_per_stamp == Approx(1 / 30.0));
  REQUIRE(dataset.frames.size() == 11);
  CHECK(dataset.frames[1].stamp == 2);
  CHECK(dataset.frames[10].image == scratch.path() / "rgb/11.png");
  CHECK(dataset.frames[1].depth == scratch.path() / "depth/2.png");
  CHECK(dataset.world_from_cam(dataset.frames[0]) == nullptr);
  REQUIRE(dataset.world_from_cam(dataset.frames[3]) != nullptr);
  const SE3<double> pose = *dataset.world_from_cam(dataset.frames[3]);
  CHECK((pose.translation - Vec3<double>(0.1, -0.2, 4)).norm() < 1e-12);
  CHECK(pose.rotation.quaternion().x() == Approx(-0.6));
  CHECK(io::known_camera_for(dataset)->camera.pinhole.fy == 480);
}

TEST_CASE("Numbered images are ICL-NUIM's where something says so") {
  const ScratchFolder scratch;
  for (int i = 0; i < 3; ++i) scratch.write("rgb/" + std::to_string(i) + ".png");
  const auto refused = [&] {
    return contains(error_opening(scratch.path()), ": nothing says what its rgb/N.png are; expected rgb.txt");
  };
  SECTION("nothing does") {
    CHECK(refused());
    CHECK(contains(error_opening(scratch.path()), "name " + (scratch.path() / "rgb").string()));
    CHECK(io::open_dataset(scratch.path() / "rgb").layout == io::Layout::kImages);
  }
  SECTION("a ground truth in seconds is TUM RGB-D's without its rgb.txt") {
    scratch.write("groundtruth.txt", "# stamps\n0" + std::string(kIdentity) + "0.5" + kIdentity);
    CHECK(refused());
    scratch.write("associations.txt", "0.5 rgb/1.png 0.52 depth/1.png\n");
    CHECK(io::open_dataset(scratch.path()).layout == io::Layout::kTum);
    scratch.write("rgb.txt", "0 rgb/0.png\n0.5 rgb/1.png\n");
    CHECK(io::open_dataset(scratch.path()).layout == io::Layout::kTum);
  }
  SECTION("a ground truth that counts frames") {
    scratch.write("groundtruth.txt", "0" + std::string(kIdentity) + "1" + kIdentity);
    CHECK(io::open_dataset(scratch.path()).layout == io::Layout::kIclNuim);
  }
  SECTION("the list of the published images") {
    scratch.write("associations.txt", "0 depth/0.png 0 rgb/0.png\n1 depth/1.png 1 rgb/1.png\n");
    CHECK(io::open_dataset(scratch.path()).layout == io::Layout::kIclNuim);
  }
}

TEST_CASE("7-Scenes layout: matrices are poses") {
  const ScratchFolder scratch;
  for (int i = 0; i < 3; ++i) {
    char stem[32];
    std::snprintf(stem, sizeof stem, "frame-%06d", i);
    scratch.write(stem + std::string(".color.png"));
    scratch.write(stem + std::string(".depth.png"));
    scratch.write(stem + std::string(".pose.txt"),
                  " 0 -1 0 1.5\t\n1 0 0 " + std::to_string(i) + "\n0 0 1 -2\n0 0 0 1\n");
  }
  SECTION("as published") {
    const io::Dataset dataset = io::open_dataset(scratch.path());
    CHECK(dataset.layout == io::Layout::kSevenScenes);
    REQUIRE(dataset.frames.size() == 3);
    CHECK(dataset.frames[2].stamp == Approx(2 / 30.0));
    CHECK(dataset.frames[2].depth == scratch.path() / "frame-000002.depth.png");
    const SE3<double>* const pose = dataset.world_from_cam(dataset.frames[2]);
    REQUIRE(pose != nullptr);
    CHECK(pose->translation.y() == 2);
    CHECK((pose->rotation * Vec3<double>(1, 0, 0) - Vec3<double>(0, 1, 0)).norm() < 1e-12);
    CHECK(dataset.ground_truth.size() == 3);
    CHECK(io::known_camera_for(dataset)->depth_factor == 1000);
  }
  SECTION("with a pose that is no rigid motion") {
    scratch.write("frame-000001.pose.txt", "2 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n");
    const io::Dataset dataset = io::open_dataset(scratch.path());
    CHECK(dataset.frames.size() == 3);
    CHECK(dataset.world_from_cam(dataset.frames[1]) == nullptr);
    CHECK(dataset.world_from_cam(dataset.frames[2])->translation.y() == 2);
    REQUIRE(dataset.warnings.size() == 1);
    CHECK(contains(dataset.warnings[0], "frame-000001.pose.txt: its upper left 3x3 part is not a rotation"));
  }
}

TEST_CASE("Image folders and globs: natural order and stamps") {
  const ScratchFolder scratch;
  for (const char* name : {"10.png", "9.PNG", "notes.txt", "8.jpg"}) scratch.write(name);
  SECTION("counters become stamps by the frame rate") {
    const io::Dataset dataset = io::open_dataset(scratch.path(), {.frame_rate = 20});
    CHECK(dataset.layout == io::Layout::kImages);
    REQUIRE(dataset.frames.size() == 3);
    CHECK(dataset.frames[0].image == scratch.path() / "8.jpg");
    CHECK(dataset.frames[2].image == scratch.path() / "10.png");
    CHECK(dataset.frames[2].stamp == Approx(0.1));
    CHECK_FALSE(io::known_camera_for(dataset).has_value());
  }
  SECTION("a glob picks some") {
    CHECK(io::open_dataset(scratch.path() / "*.png").frames.size() == 1);
    CHECK(contains(error_opening(scratch.path() / "x*.png"), "x*.png: no image matches"));
    CHECK(contains(error_opening(scratch.path() / "*/a.png"), "in the last part of the path only"));
  }
  SECTION("names that are stamps are kept") {
    const ScratchFolder stamped;
    stamped.write("1341836537.655662.png");
    stamped.write("1341836537.687415.png");
    CHECK(io::open_dataset(stamped.path()).frames[1].stamp == 1341836537.687415);
  }
}

TEST_CASE("Videos are told by their name and filled in by who opens them") {
  const ScratchFolder scratch;
  const auto path = scratch.write("walk.MP4");
  io::Dataset dataset = io::open_dataset(path);
  CHECK(dataset.layout == io::Layout::kVideo);
  CHECK(dataset.frames.empty());
  io::fill_video_frames(dataset, 5, 25);
  REQUIRE(dataset.frames.size() == 5);
  CHECK(dataset.frames[4].stamp == Approx(0.16));
  CHECK(contains(error_of([&] { io::fill_video_frames(dataset, 0, 25); }), "holds no frame"));
  CHECK(contains(error_of([&] { io::fill_video_frames(dataset, 5, 0); }), "neither times nor a frame rate"));

  const std::vector<double> times{4, 4.5, 4.5, 6};
  io::fill_video_frames(dataset, times);
  REQUIRE(dataset.frames.size() == 3);
  CHECK(dataset.frames[0].stamp == 0);
  CHECK(dataset.frames[2].stamp == 2);
  CHECK(dataset.frames[2].index == 3);
  CHECK(dataset.video_start == 4);
  REQUIRE(dataset.warnings.size() == 1);
  CHECK(contains(dataset.warnings[0], "1 frames have the time of the frame before: left out"));
  for (const char* name : {"a.3gp", "a.ts", "a.m2ts", "a.gif"}) CHECK(io::is_video_name(name));
}

TEST_CASE("A video is told by its content, whatever its name says") {
  const ScratchFolder scratch;
  for (const char* name : {"walk.jpg", "walk.dat", "walk.bag"})
    CHECK(io::open_dataset(scratch.write(name, std::string("\0\0\0\x18", 4) + "ftypmp42")).layout ==
          io::Layout::kVideo);
  CHECK(contains(error_of([&] { (void)io::open_dataset(scratch.write("one.jpg", "\xff\xd8\xff\xe0")); }),
                 "is one image"));
}

TEST_CASE("Links to images that are not there are told, not passed over") {
  const ScratchFolder scratch;
  for (int i = 0; i < 3; ++i)
    std::filesystem::create_symlink(scratch.path() / "gone", scratch.path() / (std::to_string(i) + ".png"));
  CHECK(contains(error_opening(scratch.path()), "0.png, which is not there (and 2 more bad entries of 3)"));
  std::filesystem::create_symlink(scratch.write("there/3"), scratch.path() / "3.png");
  for (const char* name : {"0.png", "1.png"}) std::filesystem::remove(scratch.path() / name);
  const io::Dataset dataset = io::open_dataset(scratch.path());
  CHECK(dataset.frames.size() == 1);
  REQUIRE(dataset.warnings.size() == 1);
  CHECK(contains(dataset.warnings[0], "2.png, which is not there: skipped"));
}

TEST_CASE("A list that names an image again says so") {
  const ScratchFolder scratch;
  for (const char* name : {"rgb/1.png", "rgb/2.png"}) scratch.write(name);
  scratch.write("rgb.txt", "1.5 rgb/1.png\n1.6 rgb/1.png\n1.7 rgb/2.png\n");
  const io::Dataset dataset = io::open_dataset(scratch.path());
  CHECK(dataset.frames.size() == 3);
  REQUIRE(dataset.warnings.size() == 1);
  CHECK(
      contains(dataset.warnings[0], "rgb.txt: 1 frames have an image that another one has, too, the first "));
}

TEST_CASE("What is no dataset is told what was looked for") {
  const ScratchFolder scratch;
  CHECK(contains(error_opening(scratch.path() / "none"), "no such file or folder"));
  const std::string empty = error_opening(scratch.path());
  CHECK(contains(
      empty,
      "the folder is empty; looked for rgb.txt (TUM RGB-D), frame-NNNNNN.color.png (7-Scenes), mav0/"));
  scratch.write("notes.txt");
  CHECK(contains(error_opening(scratch.path()), "no dataset here; looked for"));
  CHECK(contains(error_opening(scratch.path() / "notes.txt"), "neither a folder nor a video"));
  scratch.write("one.png", "?");
  CHECK(contains(error_opening(scratch.path() / "one.png"), "is one image; a run needs many"));
}

TEST_CASE("Slices keep places in the whole sequence") {
  const ScratchFolder scratch;
  make_tum(scratch, 12);
  io::Dataset dataset = io::open_dataset(scratch.path());
  SECTION("start end stride") {
    io::apply_slice(dataset, {.start = 2, .end = 9, .stride = 3});
    REQUIRE(dataset.frames.size() == 3);
    CHECK(dataset.frames[0].index == 2);
    CHECK(dataset.frames[2].index == 8);
    CHECK(dataset.ground_truth.size() == 48);
  }
  SECTION("everything") {
    io::apply_slice(dataset, {});
    CHECK(dataset.frames.size() == 12);
  }
  SECTION("nothing is an error") {
    CHECK(contains(error_of([&] { io::apply_slice(dataset, {.start = 12}); }),
                   "no frame from 12 up to 12; the sequence has 12"));
    CHECK(contains(error_of([&] { io::apply_slice(dataset, {.stride = 0}); }), "stride at least 1"));
  }
}

TEST_CASE("Calibrations are found by name and by words of the recording") {
  CHECK(io::find_known_camera("tum_fr1")->camera.distortion.k3 == 1.1633);
  CHECK_FALSE(io::find_known_camera("nikon").has_value());
  CHECK(io::freiburg_number("# file: 'rgbd_dataset_freiburg3_structure.bag'") == 3);
  CHECK(io::freiburg_number("my_fr1") == 1);
  CHECK(io::freiburg_number("TUM_Fr2_desk") == 2);
  CHECK(io::freiburg_number("afr1 fr12 fr4 freiburg") == 0);
}

TEST_CASE("The recordings are read whole and without a warning") {
  if (!testing::has_shared_data("tum_fr3_structure_notexture_far")) return;
  const io::Dataset tum = io::open_dataset(testing::shared_data("tum_fr3_structure_notexture_far"));
  CHECK(tum.warnings.empty());
  CHECK(tum.frames.size() == 258);
  std::size_t with_depth = 0;
  for (const io::FrameEntry& frame : tum.frames) with_depth += frame.depth.empty() ? 0 : 1;
  CHECK(with_depth == 250);  // the other two are more than 20 ms from any image
  CHECK(io::known_camera_for(tum)->name == "tum_fr3");

  const io::Dataset icl = io::open_dataset(testing::shared_data("icl_nuim_of_kt0"));
  CHECK(icl.layout == io::Layout::kIclNuim);
  CHECK(icl.warnings.empty());
  CHECK(icl.frames.size() == 101);
  CHECK(icl.frames[99].stamp == 100);
  CHECK(icl.world_from_cam(icl.frames[0]) == nullptr);
  CHECK(icl.world_from_cam(icl.frames[1])->translation.y() == Approx(-0.00897074));

  const io::Dataset office = io::open_dataset(testing::shared_data("office_kt2"));
  CHECK(office.layout == io::Layout::kTum);
  CHECK(office.warnings.empty());
  CHECK(office.frames.size() == 440);
  CHECK_FALSE(io::known_camera_for(office).has_value());
}
