// SPDX-License-Identifier: BSD-3-Clause
// Bags by hand, whole and broken. Those of other programs are in tests/cli/bag.
#include <limits>
#include <string>

#include "io/bags/made_bags.hpp"
#include "io/errors.hpp"
#include "sslam/io/datasets/open_dataset.hpp"
#include "support/catch.hpp"
#include "support/scratch_folder.hpp"

using namespace sslam;
using namespace sslam::made_bags;
using sslam::testing::contains;
using sslam::testing::error_of;
using sslam::testing::is_one_line;
using sslam::testing::ScratchFolder;

namespace bag_tests {

const std::string kImage = "sensor_msgs/Image";

// The message of a frame.
std::string message_of(const io::Dataset& dataset, std::size_t frame) {
  const io::MessagePlace place = dataset.bag->images.places[frame];
  const io::ChunkPlace& chunk = dataset.bag->chunks[place.chunk];
  io::BagFile file(dataset.bag->files[chunk.file]);
  std::string scratch, bytes;
  REQUIRE(io::read_chunk(file, chunk, backwards(), scratch, bytes));
  return bytes.substr(place.begin, place.size);
}

std::string images_1(int count) {
  std::string records = connection_1(3, "/cam/image_raw", kImage);
  for (int i = 0; i < count; ++i) records += message_1(3, image_1(1 + i));
  return records;
}

}  // namespace bag_tests

using namespace bag_tests;

TEST_CASE("A bag of ROS 1 gives its images in the order of their stamps, packed or not") {
  const ScratchFolder scratch;
  const std::string later =
      connection_1(3, "/cam/image_raw", kImage) + message_1(3, image_1(2.5, "mono8", "cd"));
  const std::string earlier = message_1(3, image_1(1.25));
  for (const std::string packing : {"none", "lz4", "bz2"}) {
    const io::Dataset dataset =
        read(scratch.path() / "a.bag", bag_1(chunk_1(later, packing) + chunk_1(earlier, packing)));
    REQUIRE(dataset.frames.size() == 2);
    CHECK(dataset.frames[0].stamp == 1.25);
    CHECK(dataset.frames[1].stamp == 2.5);
    CHECK(dataset.frames[1].index == 1);
    CHECK(message_of(dataset, 0) == image_1(1.25));
    CHECK(message_of(dataset, 1) == image_1(2.5, "mono8", "cd"));
    REQUIRE(dataset.warnings.size() == 1);
    CHECK(contains(dataset.warnings[0], "stamps go backwards"));
  }
}

TEST_CASE("MCAP gives the same with and without chunks, and in either order of bytes") {
  const ScratchFolder scratch;
  const std::string head = channel(9, "/cam/image_raw", "sensor_msgs/msg/Image");
  const std::string records = message(9, image_2(1)) + message(9, image_2(2, true));
  const std::uint32_t crc = backwards().crc32(head + records);
  for (const std::string& body :
       {head + records, chunk(head + records, "", 0), chunk(head + records, "lz4", crc),
        chunk(head + records, "zstd", crc), head + chunk(records, "lz4", 0)}) {
    const io::Dataset dataset = read(scratch.path() / "a.mcap", mcap(body));
    REQUIRE(dataset.frames.size() == 2);
    CHECK(dataset.warnings.empty());
    CHECK(dataset.frames[0].stamp == 1.000000005);
    CHECK(message_of(dataset, 1) == image_2(2, true));
    const std::string bytes = image_2(2, true);  // the image is a view of it
    const auto image = io::read_image_message({io::Wire::kCdr, bytes});
    CHECK(image.width == 2);
    CHECK(image.data == "ab");
  }
}

TEST_CASE("A bag that lost its end, or was never closed, gives what there is") {
  const ScratchFolder scratch;
  const auto path = scratch.path() / "a.bag";
  const std::string whole = bag_1(chunk_1(images_1(2)) + chunk_1(images_1(4)));
  const io::Dataset cut = read(path, whole.substr(0, whole.size() - 10));
  CHECK(cut.frames.size() == 3);
  REQUIRE(cut.warnings.size() >= 1);
  CHECK(contains(cut.warnings[0], "a record without its end at byte"));
  CHECK(is_one_line(cut.warnings[0]));

  const io::Dataset open = read(path, bag_1(chunk_1(images_1(2)) + message_1(3, image_1(5)), false));
  CHECK(open.frames.size() == 3);
  REQUIRE(open.warnings.size() == 1);
  CHECK(contains(open.warnings[0], "no index"));

  const std::string head = channel(9, "/i", "sensor_msgs/msg/Image");
  const std::string mcap_open = mcap(head + message(9, image_2(1)) + message(9, image_2(2)), false);
  CHECK(contains(read(scratch.path() / "a.mcap", mcap_open).warnings.at(0), "no index"));
  const io::Dataset mcap_cut = read(scratch.path() / "a.mcap", mcap_open.substr(0, mcap_open.size() - 3));
  CHECK(mcap_cut.frames.size() == 1);
  CHECK(contains(mcap_cut.warnings.at(0), "without its end"));
}

TEST_CASE("A damaged chunk of a bag costs what is in it, and one line") {
  const ScratchFolder scratch;
  const std::string images = images_1(2);
  const std::string bad_inside = chunk_1(images.substr(0, images.size() - 1));
  std::string bad_size = chunk_1(images, "lz4");
  bad_size[bad_size.find("size=") + 5] ^= 1;
  for (const std::string& bad : {bad_size, bad_inside}) {
    const std::string good = connection_1(3, "/cam/image_raw", kImage) + message_1(3, image_1(9));
    const io::Dataset dataset = read(scratch.path() / "a.bag", bag_1(bad + chunk_1(good)));
    CHECK(dataset.frames.back().stamp == 9);
    REQUIRE(dataset.warnings.size() == 1);
    CHECK(contains(dataset.warnings[0], "a damaged chunk at byte"));
  }
  const std::string head = channel(9, "/i", "sensor_msgs/msg/Image");
  const std::string broken = chunk(message(9, image_2(1)), "lz4", 12345);
  const io::Dataset mcap_file = read(scratch.path() / "a.mcap", mcap(head + broken + message(9, image_2(2))));
  CHECK(mcap_file.frames.size() == 1);
  CHECK(contains(mcap_file.warnings.at(0), "a damaged chunk at byte"));
}

TEST_CASE("A packing or an encoding that is not read is named, with what is read") {
  const ScratchFolder scratch;
  const auto bag = scratch.path() / "a.bag";
  const std::string good = connection_1(3, "/cam/image_raw", kImage) + message_1(3, image_1(9));
  const std::string rar = chunk_1(images_1(2), "rar");
  const io::Dataset dataset = read(bag, bag_1(rar + rar + chunk_1(good)));
  REQUIRE(dataset.warnings.size() == 1);
  CHECK(contains(dataset.warnings[0],
                 "a.bag: chunks that are packed as rar are left out; read are lz4, zstd, bz2 and none"));
  CHECK(contains(error_of([&] { (void)read(bag, bag_1(rar)); }), "holds no images"));
  CHECK(contains(error_of([&] { (void)read(bag, bag_1(rar)); }), "packed as rar"));

  const auto file = scratch.path() / "a.mcap";
  const std::string head = channel(9, "/i", "sensor_msgs/msg/Image");
  const std::string records = head + message(9, image_2(1));
  CHECK(contains(read(file, mcap(records + chunk(records, "brotli", 0))).warnings.at(0),
                 "a.mcap: chunks that are packed as brotli are left out"));

  const std::string video =
      bag_1(connection_1(1, "/cam/video", "ffmpeg_msgs/Packet") + message_1(1, image_1(1)));
  CHECK(contains(error_of([&] {
                   (void)read(bag, video, {"/cam/video", {}});
                 }),
                 "--topic /cam/video names no topic with images (sensor_msgs/Image, CompressedImage), it has "
                 "ffmpeg_msgs/Packet; there are none"));
}

TEST_CASE("Sizes that a bag claims are not believed") {
  const ScratchFolder scratch;
  const auto path = scratch.path() / "a.bag";
  const std::string huge = bytes_of(std::numeric_limits<std::uint32_t>::max());
  const std::string good = chunk_1(images_1(1));
  for (const std::string& tail : {huge, huge + huge, bytes_of(std::uint32_t{0}) + huge, std::string("abc")}) {
    const io::Dataset dataset = read(path, bag_1(good + tail));
    CHECK(dataset.frames.size() == 1);
    CHECK(contains(dataset.warnings.at(0), "what stands before is used"));
  }
  std::string lying = chunk_1(images_1(1), "lz4");
  lying.replace(lying.find("size=") + 5, 4, huge);
  CHECK(contains(error_of([&] { (void)read(path, bag_1(lying)); }), "a damaged chunk"));
  std::string long_mcap = mcap(channel(9, "/i", "sensor_msgs/msg/Image") + message(9, image_2(1)), false);
  long_mcap += '\x06' + bytes_of(std::numeric_limits<std::uint64_t>::max());
  CHECK(read(scratch.path() / "a.mcap", long_mcap).frames.size() == 1);
}

TEST_CASE("Where several topics have images, nobody guesses") {
  const ScratchFolder scratch;
  const auto path = scratch.path() / "a.bag";
  const std::string left = connection_1(1, "/left/image_raw", kImage) + message_1(1, image_1(1));
  const std::string right =
      connection_1(2, "/right/image_raw", kImage) + message_1(2, image_1(2)) + message_1(2, image_1(3));
  const std::string error = error_of([&] { (void)read(path, bag_1(chunk_1(left + right))); });
  CHECK(is_one_line(error));
  CHECK(
      contains(error, "2 topics with images, say which with --topic: /left/image_raw (2x1 mono8, 1 images)"));
  CHECK(read(path, bag_1(chunk_1(left + right)), {"/right/image_raw", {}}).frames.size() == 2);
  CHECK(contains(error_of([&] {
                   (void)read(path, bag_1(left), {"/none", {}});
                 }),
                 "--topic /none names no topic"));

  const std::string packed = connection_1(4, "/left/image_raw/compressed", "sensor_msgs/CompressedImage") +
                             message_1(4, header_1(1) + with_length("jpeg") + with_length("..."));
  const std::string depth =
      connection_1(5, "/left/depth/image_raw", kImage) + message_1(5, image_1(1.01, "16UC1", "abcd"));
  const io::Dataset dataset = read(path, bag_1(chunk_1(packed + depth + left)));
  CHECK(dataset.bag->images.topic == "/left/image_raw");
  CHECK(dataset.frames.at(0).depth == "/left/depth/image_raw");
  CHECK(dataset.depth_factor == 1000);
  CHECK(read(path, bag_1(packed)).bag->images.topic == "/left/image_raw/compressed");
  CHECK(contains(error_of([&] { (void)read(path, bag_1(depth)); }), "holds no images but depth"));
  CHECK(contains(error_of([&] { (void)read(path, bag_1(connection_1(1, "/imu", "sensor_msgs/Imu"))); }),
                 "its topics are /imu (sensor_msgs/Imu)"));
}

TEST_CASE("The camera of a bag is the one of the images, and poses are those of its own frame") {
  const ScratchFolder scratch;
  const auto path = scratch.path() / "a.bag";
  const std::string camera = connection_1(7, "/cam/camera_info", "sensor_msgs/CameraInfo");
  const std::string poses = connection_1(8, "/mocap", "geometry_msgs/TransformStamped") +
                            message_1(8, pose_1(1, 0.5)) + message_1(8, pose_1(1, 0.7, "robot"));
  const std::string other = connection_1(6, "/other/camera_info", "sensor_msgs/CameraInfo") +
                            message_1(6, camera_1(300, "elsewhere"));
  const io::Dataset dataset =
      read(path, bag_1(chunk_1(other + images_1(2) + camera + message_1(7, camera_1(200)) + poses)));
  CHECK(contains(dataset.camera_text, "K: [200.0, 0.0, 1.0, 0.0, 200.0, 0.5, 0.0, 0.0, 1.0]"));
  CHECK(contains(dataset.camera_text, "D: [0.25]"));
  CHECK(contains(dataset.camera_source, "/cam/camera_info"));
  REQUIRE(dataset.world_from_cam(dataset.frames[0]) != nullptr);
  CHECK(dataset.world_from_cam(dataset.frames[0])->translation.x() == 0.5);
  CHECK(dataset.world_from_cam(dataset.frames[1]) == nullptr);

  const std::string rectified = connection_1(3, "/cam/image_rect", kImage) + message_1(3, image_1(1)) +
                                camera + message_1(7, camera_1(200));
  CHECK(contains(read(path, bag_1(rectified)).camera_text, "K: [201.0,"));
  CHECK_FALSE(contains(read(path, bag_1(rectified)).camera_text, "D:"));
  const io::Dataset without = read(path, bag_1(images_1(1) + camera + message_1(7, camera_1(0))));
  CHECK(without.camera_text.empty());
  CHECK(contains(without.warnings.at(0), "was not calibrated"));
  CHECK(read(path, bag_1(other + images_1(1))).camera_text.empty());
}

TEST_CASE("Images of a bag without stamps have those of the recorder") {
  const ScratchFolder scratch;
  const io::Dataset dataset =
      read(scratch.path() / "a.bag", bag_1(connection_1(3, "/i", kImage) + message_1(3, image_1(0))));
  CHECK(dataset.frames.at(0).stamp == 7);
  CHECK(contains(dataset.warnings.at(0), "have no stamps"));
}

TEST_CASE("What is no bag, or one of another kind, gets one line") {
  const ScratchFolder scratch;
  const auto error = [&](const std::string& name, const std::string& bytes) {
    return error_of([&] { (void)read(scratch.path() / name, bytes); });
  };
  CHECK(contains(error("a.bag", "hello"), "neither a ROS 1 bag"));
  CHECK(contains(error("b.bag", ""), "neither a ROS 1 bag"));
  CHECK(contains(error("c.bag", "#ROSBAG V1.2\n"), "rosbag fix"));
  CHECK(contains(error("d.db3", std::string(io::kSqliteMagic)), "ros2 bag convert"));
  std::filesystem::create_directory(scratch.path() / "folder");
  std::ofstream(scratch.path() / "folder/metadata.yaml") << "rosbag2_bagfile_information:\n";
  std::ofstream(scratch.path() / "folder/a.mcap.zstd") << "?";
  CHECK(io::open_dataset(scratch.path() / "folder").layout == io::Layout::kBag);
  CHECK(contains(error_of([&] {
                   io::Dataset dataset = io::open_dataset(scratch.path() / "folder");
                   io::fill_bag_frames(dataset, {}, backwards());
                 }),
                 "a.mcap.zstd: is packed as a whole; unpack it first"));
}

TEST_CASE("Parts that metadata.yaml lists and that are not there are told") {
  const ScratchFolder scratch;
  const auto folder = scratch.path() / "walk";
  std::filesystem::create_directory(folder);
  const auto told = [&](const std::string& list) {
    std::ofstream(folder / "metadata.yaml")
        << "rosbag2_bagfile_information:\n  version: 9\n  relative_file_paths:\n" + list + "  duration:\n";
    return io::missing_parts(folder);
  };
  std::ofstream(folder / "walk_0.mcap") << "?";
  std::ofstream(folder / "walk _1.mcap") << "?";
  CHECK(told("    - walk_0.mcap\n    - \"walk _1.mcap\"\n").empty());
  CHECK(
      told("  - walk/walk_0.mcap.zstd\n  - walk _1.mcap\n").empty());  // that was unpacked; as old ones write
  CHECK(contains(told("    - walk_0.mcap\n    - walk_2.mcap\n"),
                 "metadata.yaml: lists walk_2.mcap, not there"));
  CHECK(contains(told("    - a.mcap\n    - b.mcap\n    - c.mcap\n"), "lists a.mcap and 2 more, not there"));
  CHECK(io::missing_parts(scratch.path()).empty());
}

TEST_CASE("Names in a bag cannot break a message into lines") {
  const ScratchFolder scratch;
  const std::string bad = connection_1(1, "/a\nb", kImage) + message_1(1, image_1(1, "x\ny")) +
                          connection_1(2, "/c\n", kImage) + message_1(2, image_1(1));
  CHECK(is_one_line(error_of([&] { (void)read(scratch.path() / "a.bag", bag_1(bad)); })));
}
