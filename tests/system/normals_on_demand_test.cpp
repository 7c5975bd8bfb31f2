// SPDX-License-Identifier: BSD-3-Clause
// Normals that are asked for where they can change something, from images on.
#include <algorithm>
#include <array>
#include <future>
#include <utility>
#include <vector>

#include "sslam/io/evaluation/evaluation.hpp"
#include "sslam/system/system.hpp"
#include "support/catch.hpp"
#include "support/rendered_room.hpp"

namespace normals_on_demand_test {

using namespace sslam;
using namespace sslam::testing;

// Normals of depth stand for those of a network, which an image of this size says little to.
Settings settings_of(const RenderedRoom& room, bool on_demand) {
  Settings settings;
  settings.camera = room.camera;
  settings.normals.source = DepthNormals{};
  settings.normals.on_demand = on_demand;
  return settings;
}

ImageInput input_of(const RenderedRoom& room, std::size_t i) {
  ImageInput input;
  input.index = static_cast<std::int64_t>(i);
  input.stamp = room.truth[i].stamp;
  input.image = room.images[i];
  input.depth = room.depth[i];
  return input;
}

struct Outcome {
  std::vector<FrameReport> frames;
  io::Trajectory trajectory;
  double ate = 0;  // metres

  [[nodiscard]] int asked() const {
    return static_cast<int>(std::count_if(frames.begin(), frames.end(), [](const FrameReport& frame) {
      return frame.normal_need != NormalNeed::kNotNeeded;
    }));
  }
};

Outcome finish(System& system, const RenderedRoom& room, std::vector<FrameReport> frames) {
  system.finish();
  const io::Trajectory trajectory = system.trajectory();
  return {std::move(frames), trajectory, io::evaluate(room.truth, trajectory).position.rmse};
}

Outcome track(const RenderedRoom& room, const Settings& settings) {
  System system(settings);
  std::vector<FrameReport> frames;
  for (std::size_t i = 0; i < room.images.size(); ++i) frames.push_back(system.track(input_of(room, i)));
  return finish(system, room, std::move(frames));
}

// The features of the next image are found while the last one is tracked, in buffers that the caller fills
// anew.
Outcome track_ahead(const RenderedRoom& room, const Settings& settings) {
  System system(settings);
  std::vector<FrameReport> frames;
  std::array<Extraction, 2> extraction;
  ImageInput input = input_of(room, 0);
  input.image = input.image.clone();
  system.extract(input, extraction[0]);
  for (std::size_t i = 0; i < room.images.size(); ++i) {
    const auto ahead = std::async(std::launch::async, [&] {
      if (i + 1 == room.images.size()) return;
      cv::Mat image = input.image;
      input = input_of(room, i + 1);
      input.image.copyTo(image);
      input.image = image;
      system.extract(input, extraction[(i + 1) % 2]);
    });
    frames.push_back(system.track(extraction[i % 2]));
    ahead.wait();
  }
  return finish(system, room, std::move(frames));
}

RenderedRoom rich_room(int frames) {
  synth::HouseOptions house;
  house.seed = 1;
  house.richness = synth::Richness::kRich;
  return render_room(house, frames);
}

TEST_CASE("Where lines show the room, normals are asked for rarely, and the result is as good") {
  const RenderedRoom room = rich_room(60);
  const Outcome every = track(room, settings_of(room, false)),
                on_demand = track(room, settings_of(room, true));
  Settings lines_alone;
  lines_alone.camera = room.camera;
  const Outcome none = track(room, lines_alone);
  INFO("asked " << on_demand.asked() << ", ATE " << every.ate << ", " << on_demand.ate << ", " << none.ate);
  CHECK(none.asked() == 0);
  CHECK(every.asked() == 60);
  CHECK(every.frames.back().normal_need == NormalNeed::kEveryFrame);
  CHECK(on_demand.frames.back().normal_need == NormalNeed::kNotNeeded);
  CHECK(on_demand.frames.back().normals == 0);
  CHECK(on_demand.asked() <= 6);
  CHECK(on_demand.trajectory.size() == none.trajectory.size());
  CHECK(on_demand.ate < 1.5 * none.ate + 1e-3);
}

TEST_CASE("Which frames are asked about does not depend on threads") {
  const RenderedRoom room = rich_room(40);
  Settings settings = settings_of(room, true);
  settings.parameters.push_back({"demand.max_sigma", 0.2});  // more to ask about
  settings.parameters.push_back({"demand.held_by", 1e6});
  const Outcome in_turn = track(room, settings), ahead = track_ahead(room, settings);
  CHECK(in_turn.asked() > 1);
  REQUIRE(in_turn.frames.size() == ahead.frames.size());
  for (std::size_t i = 0; i < in_turn.frames.size(); ++i) {
    REQUIRE(in_turn.frames[i].normal_need == ahead.frames[i].normal_need);
    REQUIRE(in_turn.frames[i].normals == ahead.frames[i].normals);
    const SE3<double>&a = in_turn.frames[i].cam_from_world, &b = ahead.frames[i].cam_from_world;
    REQUIRE(a.rotation.matrix() == b.rotation.matrix());
    REQUIRE(a.translation == b.translation);
  }
}

TEST_CASE("Without lines the normals are asked for in each frame that is tracked, and give the rotation") {
  const RenderedRoom room = rich_room(40);
  Settings settings = settings_of(room, true);
  settings.preset = "points";
  settings.parameters.push_back({"demand.held_by", 1e6});
  const Outcome outcome = track(room, settings);
  CHECK(outcome.asked() == 40);
  CHECK(outcome.frames.front().normal_need == NormalNeed::kNoManhattanFrame);
  CHECK(outcome.frames.front().normals > 0);
  CHECK(outcome.frames.back().axes_seen >= 2);
}

TEST_CASE("A preset without a Manhattan world asks for no normals") {
  const RenderedRoom room = rich_room(10);
  Settings settings = settings_of(room, true);
  settings.preset = "features";
  CHECK(track(room, settings).asked() == 0);
}

}  // namespace normals_on_demand_test
