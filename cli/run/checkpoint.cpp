// SPDX-License-Identifier: BSD-3-Clause
#include "cli/run/checkpoint.hpp"

#include <utility>

#include "cli/results/run_folder.hpp"
#include "cli/run/checkpoint_fields.hpp"
#include "sslam/io/maps/map_file.hpp"
#include "sslam/opencv/camera/same_camera.hpp"
#include "sslam/version.hpp"

namespace sslam::cli {
namespace {

namespace fs = std::filesystem;

constexpr io::SealedKind kCheckpoint{"SSLAMRUN", 1, "checkpoint", "one that `sslam run` has written"};

void put_world(io::ByteWriter& out, const World<double>& world) {
  out(world.number);
  out(static_cast<std::uint8_t>(world.map.empty() ? 0 : 1));
  if (world.map.empty()) return;
  io::MapFields(out).walk(const_cast<Map<double>&>(world.map));  // a writer only reads
  out(static_cast<std::uint64_t>(world.log.entries().size()));
  CheckpointFields fields(out);
  for (TrajectoryEntry<double> entry : world.log.entries()) fields.walk(entry, world.map.keyframes.size());
}

World<double> take_world(io::ByteReader& in, int last_number) {
  World<double> world;
  std::uint8_t mapped = 0;
  in(world.number, {"the number of a world", 0, last_number});
  in(mapped, {"whether there is a map", 0, 1});
  if (mapped == 0) return world;
  world.map = io::read_map(in);
  std::uint64_t entries = 0;
  in(entries, {"the length of a list", 0, in.left().size()});
  CheckpointFields fields(in);
  for (std::uint64_t i = 0; i < entries; ++i) {
    TrajectoryEntry<double> entry;
    fields.walk(entry, world.map.keyframes.size());
    world.log.add(entry);
  }
  return world;
}

}  // namespace

CheckpointHead begun_checkpoint(const std::vector<std::string>& words, const io::Dataset& dataset,
                                const Camera<double>& camera) {
  CheckpointHead head;
  head.version = SSLAM_VERSION;
  head.words = words;
  head.given = camera;
  io::ByteWriter list;
  for (const io::FrameEntry& frame : dataset.frames) {
    list(frame.index);
    list(frame.stamp);
    list(frame.image);
  }
  head.frames = dataset.frames.size();
  head.frame_list = io::checksum(list.bytes);
  return head;
}

void check_resumed(const Checkpoint& checkpoint, const io::Dataset& dataset, const Camera<double>& camera,
                   const fs::path& folder) {
  const CheckpointHead now = begun_checkpoint({}, dataset, camera);
  const std::string begin = "--resume " + folder.string() + ": ";
  if (now.frames != checkpoint.frames || now.frame_list != checkpoint.frame_list)
    throw Error(begin + "the dataset has changed: " + dataset.root.string() + " had " +
                std::to_string(checkpoint.frames) + " frames and has " + std::to_string(now.frames) +
                (now.frames == checkpoint.frames ? ", with other names or stamps" : "") +
                "; run it from the beginning");
  if (!same_camera(camera, checkpoint.given))
    throw Error(begin + "the calibration has changed since the run began; run it from the beginning");
}

void write_checkpoint(const fs::path& folder, const CheckpointHead& head, const RunOutcome& outcome,
                      const FeatureColours& colours, const std::vector<const World<double>*>& worlds) {
  io::ByteWriter out;
  CheckpointFields fields(out);
  fields.walk(const_cast<CheckpointHead&>(head));  // a writer only reads
  fields.walk(const_cast<RunOutcome&>(outcome));
  colours.put(out);
  out(static_cast<std::uint64_t>(worlds.size()));
  for (const World<double>* world : worlds) put_world(out, *world);
  io::write_sealed(folder / kCheckpointFile, kCheckpoint, out.bytes);
}

bool has_checkpoint(const fs::path& folder) {
  std::error_code ignored;
  return fs::is_regular_file(folder / kCheckpointFile, ignored);
}

Checkpoint read_checkpoint(const fs::path& folder) {
  if (!has_checkpoint(folder)) {
    std::error_code ignored;
    throw Error(
        "--resume " + folder.string() + ": holds no checkpoint of a run that stopped" +
        (fs::exists(folder / "metrics.json", ignored) ? "; it holds the results of a finished run" : ""));
  }
  const fs::path file = folder / kCheckpointFile;
  const std::string bytes = io::read_sealed(file, kCheckpoint);
  try {
    io::ByteReader in{bytes};
    CheckpointFields fields(in);
    Checkpoint checkpoint;
    io::ByteReader version{bytes};
    version(checkpoint.version);
    if (checkpoint.version != SSLAM_VERSION)
      throw Error("is of sslam " + checkpoint.version + "; this is " + SSLAM_VERSION);
    fields.walk(static_cast<CheckpointHead&>(checkpoint));
    fields.walk(checkpoint.outcome);
    checkpoint.colours.take(in);
    std::uint64_t worlds = 0;
    in(worlds, {"the count of worlds", 1, in.left().size()});
    for (std::uint64_t i = 0; i < worlds; ++i)
      checkpoint.worlds.push_back(take_world(in, checkpoint.last_world));
    if (!in.left().empty()) throw Error("is longer than its parts");
    return checkpoint;
  } catch (const Error& error) {
    throw Error(file.string() + ": " + error.what());
  }
}

}  // namespace sslam::cli
