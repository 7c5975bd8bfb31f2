// SPDX-License-Identifier: BSD-3-Clause
// Fuzz targets of the program's own readers.
#include "fuzz/replay.hpp"
#include "io/errors.hpp"
#include "support/catch.hpp"

#define LLVMFuzzerTestOneInput fuzz_camera_file
#include "fuzz/camera_file_fuzz.cpp"
#undef LLVMFuzzerTestOneInput
#define LLVMFuzzerTestOneInput fuzz_image_header
#include "fuzz/image_header_fuzz.cpp"
#undef LLVMFuzzerTestOneInput
#define LLVMFuzzerTestOneInput fuzz_bag
#define LLVMFuzzerCustomMutator seed_of_bag
#include "fuzz/bag_fuzz.cpp"
#undef LLVMFuzzerCustomMutator
#undef LLVMFuzzerTestOneInput
#define LLVMFuzzerTestOneInput fuzz_manifest
#define LLVMFuzzerCustomMutator seed_of_manifest
#include "fuzz/manifest_fuzz.cpp"
#undef LLVMFuzzerCustomMutator
#undef LLVMFuzzerTestOneInput
#define LLVMFuzzerTestOneInput fuzz_stream
#define LLVMFuzzerCustomMutator seed_of_stream
#include "fuzz/stream_fuzz.cpp"
#undef LLVMFuzzerCustomMutator
#undef LLVMFuzzerTestOneInput
#define LLVMFuzzerTestOneInput fuzz_video
#define LLVMFuzzerCustomMutator seed_of_video
#include "fuzz/video_fuzz.cpp"
#undef LLVMFuzzerCustomMutator
#undef LLVMFuzzerTestOneInput
#define LLVMFuzzerTestOneInput fuzz_toml
#include "fuzz/toml_fuzz.cpp"
#undef LLVMFuzzerTestOneInput

namespace {

using namespace std::string_literals;
using sslam::fuzzing::replay;

std::string many(const std::string& part, int times) {
  std::string text;
  for (int i = 0; i < times; ++i) text += part;
  return text;
}

}  // namespace

TEST_CASE("camera files that are spoilt") {
  replay(
      fuzz_camera_file,
      {"%YAML:1.0\n---\nCamera.fx: 260\nCamera.fy: 260\nCamera.cx: 159.5\nCamera.cy: 119.5\nCamera.k1: 0.1\n",
       "cameras:\n  - camera:\n      intrinsics: [260.0, 261.0, 160.0, 120.0]\n      resolution: [320, 240]\n"
       "      distortion_coeffs: [0.1, 0, 0, 0]\n",
       R"({"fl_x": 260, "fl_y": 260, "cx": 160, "cy": 120, "w": 320, "h": 240, "k1": 0.01})",
       "# CAMERA_ID, MODEL, WIDTH, HEIGHT, PARAMS[]\n1 OPENCV 320 240 260 260 160 120 0.1 0 0 0\n",
       "<?xml version=\"1.0\"?>\n<opencv_storage><camera_matrix type_id=\"opencv-matrix\"><rows>3</rows>"
       "<cols>3</cols><dt>d</dt><data>260 0 160 0 260 120 0 0 1</data></camera_matrix></opencv_storage>\n",
       // Found: a message of two lines, and elements in each other until the stack is full.
       R"({"fl_x": "a\nb", "fl_y\n": 2, "cx": 1, "cy": 1})", "\"Camera.fx\": \"2\\n6\"\n",
       "<?xml version=\"1.0\"?><opencv_storage>" + many("<a>", 5000),
       "<?xml version=\"1.0\"?><!--><opencv_storage>" + many("<a>", 5000)},
      3000);
}

TEST_CASE("TOML that is spoilt") {
  replay(fuzz_toml,
         {"name = \"a\"\nseeds = [1, 2]\n[[sequence]]\npath = 'room'\n[[method]]\nset = {a.b = 0.3, c = "
          "[1e3]}\n",
          "a = \"\"\"\n\\u00e9\"\"\" # c\nb = 1979-05-27T07:32:00Z\nc = 0x_1\n",
          "[^.c]",  // the last one was found
          "a = " + many("[", 3000), many("a.", 3000) + "a = 1"},
         4000);
}

TEST_CASE("headers of images that are spoilt") {
  using namespace std::string_literals;
  const std::string exif = "Exif\0\0MM\0*\0\0\0\x08\0\x01\x01\x12\0\x03\0\0\0\x01\0\x06\0\0\0\0\0\0"s;
  const std::string frame = "\xff\xc0\0\x11\x08\0\x18\0\x28\x03\x01\x22\0\x02\x11\x01\x03\x11\x01"s;
  replay(fuzz_image_header,
         {"\xff\xd8\xff\xe1"s + '\0' + static_cast<char>(exif.size() + 2) + exif + frame + "\xff\xd9",
          "\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\0\x28\0\0\0\x18\x08\x02\0\0\0"s,
          "RIFF\x24\0\0\0WEBPVP8 \x18\0\0\0\x30\x01\0\x9d\x01\x2a\x28\0\x18\0"s,
          "BM\x36\0\0\0\0\0\0\0\x36\0\0\0\x28\0\0\0\x28\0\0\0\x18\0\0\0\x01\0\x18\0"s,
          "II*\0\x08\0\0\0\x02\0\0\x01\x03\0\x01\0\0\0\x28\0\0\0\x01\x01\x03\0\x01\0\0\0\x18\0\0\0\0\0\0\0"s},
         20000);
}

TEST_CASE("bags that are spoilt") {
  using namespace sslam::made_bags;
  std::vector<std::string> inputs;
  for (unsigned seed = 0; seed < 18; ++seed) {
    std::string bag(8192, '\0');
    bag.resize(seed_of_bag(reinterpret_cast<std::uint8_t*>(bag.data()), 0, bag.size(), seed));
    inputs.push_back(bag);
  }
  // Found: a topic's name broke a message into lines.
  const std::string two = connection_1(1, "/i\nj", "sensor_msgs/Image") + message_1(1, image_1(1)) +
                          connection_1(2, "/k\n", "sensor_msgs/Image") + message_1(2, image_1(1));
  inputs.push_back('\0' + bag_1(two).substr(sslam::io::kRos1Magic.size()));
  replay(fuzz_bag, inputs, 3000);
}

TEST_CASE("manifests of networks that are spoilt") {
  std::vector<std::string> inputs = manifest_fuzz::seeds();
  std::string endless = inputs.front();  // found by hand: a number that is none
  inputs.push_back(endless.replace(endless.find("123.7"), 5, "1e999"));
  replay(fuzz_manifest, inputs, 2000);
}

TEST_CASE("streams of images that are spoilt") {
  replay(fuzz_stream, stream_fuzz::seeds(), 5000);
}

TEST_CASE("videos that are spoilt") {
  replay(fuzz_video, video_fuzz::seeds(), 100);
}

TEST_CASE("a list of videos is refused where it has the name of one") {
  for (const std::string& list : video_fuzz::seeds()) {
    if (!sslam::io::starts_as_playlist(list)) continue;
    const sslam::testing::ScratchFolder scratch;
    const std::filesystem::path file = scratch.write("a.mp4", list);
    const std::string why = sslam::testing::error_of([&] { const sslam::cli::VideoReader reader(file); });
    CHECK(sslam::testing::contains(why, "a.mp4: is a list of videos, not one"));
  }
}
