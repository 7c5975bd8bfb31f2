// SPDX-License-Identifier: BSD-3-Clause
// Checkpoints of runs, with a mended checksum.
#include "cli/run/checkpoint.hpp"

#include "cli/results/run_folder.hpp"
#include "fuzz/made_folder.hpp"
#include "fuzz/sealed_input.hpp"
#include "fuzz/worked_map.hpp"
#include "support/map_scene.hpp"
#include "support/scratch_folder.hpp"

namespace checkpoint_fuzz {

using namespace sslam;

// As checkpoint.cpp has it.
inline constexpr io::SealedKind kKind{"SSLAMRUN", 1, "checkpoint", ""};

// Two frames, and a world with a small map.
inline std::string small_checkpoint() {
  const testing::ScratchFolder scratch;
  cli::CheckpointHead head = cli::begun_checkpoint({"run", "room"}, {}, {});
  head.frames = 3;
  head.next = 2;
  head.camera_warnings = {"none"};
  cli::RunOutcome outcome;
  outcome.frames.resize(2);
  outcome.views = {"abc"};
  testing::MapSceneOptions options;
  options.points = 6;
  options.lines = 2;
  World<double> world;
  world.map = testing::MapScene(options, {testing::look({0, 0, -2}, 0, 0), testing::look({0.3, 0, -2}, 0, 0)})
                  .make_map();
  TrajectoryEntry<double> first;
  first.index = 0;
  first.reference = 0;
  world.log.add(first);
  cli::write_checkpoint(scratch.path(), head, outcome, {}, {&world});
  return testing::text_of(scratch.path() / cli::kCheckpointFile);
}

inline const std::string& seed_file() {
  static const std::string kFile = small_checkpoint();
  return kFile;
}

}  // namespace checkpoint_fuzz

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most,
                                               unsigned seed) {
  using namespace checkpoint_fuzz;
  if (size > 2) return sslam::fuzzing::mutate_sealed(kKind, data, size, most, seed);
  const std::size_t kept = std::min(most, seed_file().size());
  std::copy_n(seed_file().begin(), kept, data);
  return kept;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace checkpoint_fuzz;
  const std::filesystem::path folder = fuzzing::empty_folder();
  fuzzing::write_bytes(folder / cli::kCheckpointFile, {reinterpret_cast<const char*>(data), size});
  fuzzing::expect_message([&] {
    cli::Checkpoint checkpoint = cli::read_checkpoint(folder);
    if (checkpoint.worlds.empty() || checkpoint.next > checkpoint.frames) std::abort();
    for (World<double>& world : checkpoint.worlds)
      if (!world.map.empty()) fuzzing::take_apart(world.map);
  });
  return 0;
}
