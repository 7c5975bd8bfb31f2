// SPDX-License-Identifier: BSD-3-Clause
// A fisheye of 180 degrees, through the view that its images are undistorted to. The bound is twice what was
// measured.
#include <numbers>

#include "sslam/io/evaluation/evaluation.hpp"
#include "sslam/opencv/camera/wide_view.hpp"
#include "sslam/system/system.hpp"
#include "support/catch.hpp"
#include "support/fisheye_room.hpp"

namespace wide_lens_test {
using namespace sslam;
using namespace sslam::testing;

TEST_CASE("A fisheye of 180 degrees is tracked through its pinhole view") {
  synth::HouseOptions house;
  house.seed = 1;
  constexpr int kFrames = 60;
  const FisheyeRoom room = render_fisheye_room(half_sphere_lens(), std::numbers::pi / 2, house, kFrames);
  REQUIRE(WideView::field_of(room.lens) > 170);
  const WideView view(room.lens, WideView::kUsual);
  Settings settings;
  settings.camera = view.camera();
  System system(settings);
  for (std::size_t i = 0; i < room.images.size(); ++i) {
    ImageInput input;
    input.image = view.of(room.images[i]);
    input.mask = view.seen();
    input.stamp = room.truth[i].stamp;
    input.index = static_cast<std::int64_t>(i);
    system.track(input);
  }
  system.finish();
  const io::Trajectory trajectory = system.trajectory();
  const io::Evaluation evaluation = io::evaluate(room.truth, trajectory);
  INFO("tracked " << trajectory.size() << ", ATE " << evaluation.position.rmse << " m, "
                  << degrees(evaluation.rotation_own_offset.rmse) << " degrees");
  CHECK(trajectory.size() == kFrames);
  CHECK(evaluation.position.rmse < 0.0023);
  CHECK(degrees(evaluation.rotation_own_offset.rmse) < 0.09);
}

}  // namespace wide_lens_test
