// SPDX-License-Identifier: BSD-3-Clause
// Bags of ROS 1, MCAP and ROS 2 in SQLite, with the packings that the command line has. Each frame's message
// is read as its type says. The search begins at small whole bags.
#include <sqlite3.h>

#include <array>
#include <vector>

#include "cli/input/bag_database.hpp"
#include "cli/input/chunk_codec.hpp"
#include "fuzz/fuzz_input.hpp"
#include "io/bags/made_bags.hpp"

namespace {

using namespace sslam;

// So that the fuzzer need not find the magic: the first byte says which it is.
std::string whole_file(std::string_view input) {
  if (input.empty()) return {};
  constexpr std::array kMagics{io::kRos1Magic, io::kMcapMagic, io::kSqliteMagic};
  return std::string(kMagics[static_cast<unsigned char>(input[0]) % kMagics.size()]) +
         std::string(input.substr(1));
}

// Into `bytes`. What has been read before is there again; but a database may hold two messages of one id.
void read_place(const std::filesystem::path& path, const io::ChunkPlace& chunk, std::string& bytes) {
  std::string scratch;
  if (chunk.in_database) {
    const auto database = cli::open_bag_database(path);
    if (!io::read_database_message(*database, static_cast<std::int64_t>(chunk.begin), cli::chunk_codec(),
                                   scratch, bytes))
      bytes.clear();
    return;
  }
  io::BagFile file(path);
  if (!io::read_chunk(file, chunk, cli::chunk_codec(), scratch, bytes)) std::abort();
}

void read_messages(const io::BagFrames& bag, const io::BagFrames::Stream& stream) {
  std::string bytes;
  for (const io::MessagePlace& place : stream.places) {
    if (place.size == 0) continue;
    const io::ChunkPlace& chunk = bag.chunks.at(place.chunk);
    read_place(bag.files.at(chunk.file), chunk, bytes);
    const bool there = place.begin <= bytes.size() && place.size <= bytes.size() - place.begin;
    if (!there && chunk.in_database) continue;
    if (!there) std::abort();
    const io::MessageFields fields(stream.wire, std::string_view(bytes).substr(place.begin, place.size));
    try {
      if (stream.kind == io::BagKind::kImage) (void)io::read_image_message(fields);
      if (stream.kind == io::BagKind::kCompressedImage) (void)io::read_compressed_image(fields);
    } catch (const Error&) {
    }
  }
}

// Of two topics, by the tables that rosbag2 documents; `packed`: each message by itself.
std::string database_bag(bool packed) {
  using namespace sslam::made_bags;
  sqlite3* database = nullptr;
  sqlite3_open(":memory:", &database);
  sqlite3_exec(database,
               "PRAGMA page_size = 512; CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT, type TEXT, "
               "serialization_format TEXT); CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER, "
               "timestamp INTEGER, data BLOB); INSERT INTO topics VALUES (1, '/i', 'sensor_msgs/msg/Image', "
               "'cdr'), (2, '/d', 'sensor_msgs/msg/CompressedImage', 'cdr')",
               nullptr, nullptr, nullptr);
  for (int i = 0; i < 4; ++i) {
    std::string message = image_2(i + 1);
    if (packed) message = cli::chunk_codec().pack(io::Packing::kZstd, message);
    sqlite3_stmt* insert = nullptr;
    sqlite3_prepare_v2(database, "INSERT INTO messages(topic_id, timestamp, data) VALUES (?, ?, ?)", -1,
                       &insert, nullptr);
    sqlite3_bind_int(insert, 1, 1 + i % 2);
    sqlite3_bind_int(insert, 2, i);
    sqlite3_bind_blob(insert, 3, message.data(), static_cast<int>(message.size()), nullptr);
    sqlite3_step(insert);
    sqlite3_finalize(insert);
  }
  sqlite3_int64 size = 0;
  unsigned char* const bytes = sqlite3_serialize(database, "main", &size, 0);
  std::string bag(reinterpret_cast<const char*>(bytes), static_cast<std::size_t>(size));
  sqlite3_free(bytes);
  sqlite3_close(database);
  return bag;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string bytes = whole_file({reinterpret_cast<const char*>(data), size});
  return fuzzing::read_as_file(
      reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size(), [](const auto& path) {
        io::Dataset dataset = io::unread_bag(path);
        io::fill_bag_frames(dataset, {}, cli::chunk_codec(), cli::open_bag_database);
        if (dataset.frames.empty() || dataset.frames.size() != dataset.bag->images.places.size())
          std::abort();
        for (const std::string& warning : dataset.warnings)
          if (warning.find('\n') != std::string::npos) std::abort();
        read_messages(*dataset.bag, dataset.bag->images);
        read_messages(*dataset.bag, dataset.bag->depth);
      });
}

// Small whole bags, as long as there is nothing else to begin with.
extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most);
extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most,
                                               unsigned seed) {
  using namespace sslam::made_bags;
  if (size > 8) return LLVMFuzzerMutate(data, size, most);
  const std::string ros1 =
      connection_1(1, "/i", "sensor_msgs/Image") + message_1(1, image_1(1)) +
      connection_1(2, "/camera_info", "sensor_msgs/CameraInfo") + message_1(2, camera_1(200)) +
      connection_1(3, "/p", "geometry_msgs/TransformStamped") + message_1(3, pose_1(1, 0));
  const std::string ros2 = channel(1, "/i", "sensor_msgs/msg/Image") + message(1, image_2(1)) +
                           channel(2, "/d", "sensor_msgs/msg/CompressedImage", "ros1") +
                           message(2, header_1(1));
  const io::Packing packing = seed % 3 == 0 ? io::Packing::kLz4 : io::Packing::kBzip2;
  const std::vector<std::string> seeds{
      '\0' + bag_1(ros1).substr(io::kRos1Magic.size()),
      '\0' + bag_1(chunk_1(ros1)).substr(io::kRos1Magic.size()),
      '\0' + bag_1(record_1({{"op", "\x05"},
                             {"compression", seed % 3 == 0 ? "lz4" : "bz2"},
                             {"size", bytes_of(static_cast<std::uint32_t>(ros1.size()))}},
                            cli::chunk_codec().pack(packing, ros1)))
                 .substr(io::kRos1Magic.size()),
      '\1' + mcap(ros2).substr(io::kMcapMagic.size()),
      '\1' + mcap(chunk(ros2, "", 0)).substr(io::kMcapMagic.size()),
      '\2' + database_bag(seed % 3 == 0).substr(io::kSqliteMagic.size()),
  };
  const std::string& chosen = seeds[seed / 3 % seeds.size()];
  const std::size_t kept = std::min(most, chosen.size());
  std::copy_n(chosen.begin(), kept, data);
  return kept;
}
