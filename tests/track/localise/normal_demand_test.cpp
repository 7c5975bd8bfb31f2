// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/track/localise/normal_demand.hpp"

#include <cmath>
#include <vector>

#include "sslam/track/localise/normal_trust.hpp"
#include "support/catch.hpp"
#include "support/random_draws.hpp"
#include "track/simulation.hpp"

namespace normal_demand_test {

using namespace sslam;
using namespace sslam::testing;

using Structure = presets::Structure<double>;

// The axis of the room, by the truth, that the segment runs along; or none.
int axis_of(const LineFeature<double>& line, const Frame<double>& frame, const SO3<double>& cam_from_world) {
  const Vec3<double> normal = line_vote(line.segment, frame.pinhole, 1.0).plane_normal;
  int nearest = 0;
  (cam_from_world.matrix().transpose() * normal).cwiseAbs().minCoeff(&nearest);
  return nearest;
}

void keep_axis(Frame<double>& frame, const SO3<double>& cam_from_world, int axis) {
  std::erase_if(frame.lines, [&](const auto& line) { return axis_of(line, frame, cam_from_world) != axis; });
}

// Three walls as normals that are all turned alike from the truth, with the scatter of a network's.
void add_normals(Frame<double>& frame, const SO3<double>& cam_from_world, const SO3<double>& turn,
                 Random& random) {
  for (int k = 0; k < 3; ++k)
    for (int i = 0; i < 300; ++i) {
      const Vec3<double> axis = turn.matrix() * cam_from_world.matrix().col(k);
      const Vec3<double> towards = axis.z() < 0 ? axis : Vec3<double>(-axis);
      const Vec3<float> n =
          (towards + radians(5.0) * gaussian_vector<3>(random)).normalized().template cast<float>();
      frame.normals.push_back(n.x(), n.y(), n.z(), 1);
    }
  frame.normals.plane_sigma = static_cast<float>(radians(4.7));
}

// Asks as System does, and tracks; `turn` is what the normals lie by.
int track_on_demand(Structure& pipeline, Simulation& simulation, const SO3<double>& turn) {
  Random random(5);
  int asked = 0;
  for (std::size_t k = 0; k < simulation.size(); ++k) {
    Frame<double> frame = simulation.frame(k);
    if (pipeline.normal_need(frame) != NormalNeed::kNotNeeded) {
      ++asked;
      add_normals(frame, simulation.truth(k).rotation, turn, random);
    }
    pipeline.track(frame);
  }
  return asked;
}

NormalAxes<double> axes_seen(const SO3<double>& cam_from_manhattan, double sigma, Random& random) {
  NormalAxes<double> seen;
  for (int k = 0; k < 3; ++k)
    seen[static_cast<std::size_t>(k)] =
        Vec3<double>(cam_from_manhattan.matrix().col(k) + sigma * gaussian_vector<3>(random)).normalized();
  return seen;
}

TEST_CASE("Where lines show the room in every frame, normals are hardly asked for, and change nothing") {
  const auto path = walk(90);
  Simulation plain(path), asking(path);
  Structure lines_alone, on_demand;
  track_all(lines_alone, plain);
  CHECK(track_on_demand(on_demand, asking, {}) <= 3);
  CHECK(on_demand.trajectory().entries().size() == lines_alone.trajectory().entries().size());
  CHECK(position_error(on_demand, asking) < 1.2 * position_error(lines_alone, plain) + 1e-4);
}

TEST_CASE("What the lines leave open is why normals are asked for") {
  Simulation simulation(walk(60));
  Structure pipeline;
  CHECK(pipeline.normal_need(simulation.frame(0)) == NormalNeed::kNoManhattanFrame);
  track_first(pipeline, simulation, 59);
  REQUIRE(pipeline.trajectory().entries().size() > 40);
  const Frame<double> whole = simulation.frame(59);
  CHECK(pipeline.normal_need(simulation.dark_frame(59)) == NormalNeed::kNotNeeded);  // the map holds it
  pipeline.demand.options.held_by = 1000000;                                         // as if it did not
  CHECK(pipeline.normal_need(whole) == NormalNeed::kNotNeeded);
  Frame<double> bare = whole;
  bare.lines.clear();
  CHECK(pipeline.normal_need(bare) == NormalNeed::kNoAxis);
  Frame<double> upright = whole;
  keep_axis(upright, simulation.truth(59).rotation, 1);
  REQUIRE(upright.lines.size() > 5);
  CHECK(pipeline.normal_need(upright) == NormalNeed::kAxisOpen);
  pipeline.demand.options.max_sigma = 1e-6;
  CHECK(pipeline.normal_need(whole) == NormalNeed::kUncertain);
}

TEST_CASE("A lost frame is looked for by its features, and asks for no normals") {
  Simulation simulation(walk(80));
  Structure pipeline;
  track_first(pipeline, simulation, 60);
  for (std::size_t k = 60; k < 79; ++k) {
    Frame<double> dark = simulation.dark_frame(k);
    pipeline.track(dark);
  }
  CHECK(pipeline.normal_need(simulation.frame(79)) == NormalNeed::kNotNeeded);
}

TEST_CASE("To ask whether normals are needed leaves no trace") {
  const auto path = walk(60);
  Simulation first(path), second(path);
  Structure asked, unasked;
  for (std::size_t k = 0; k < path.size(); ++k) {
    Frame<double> a = first.frame(k), b = second.frame(k);
    if (k % 2 == 0) keep_axis(a, first.truth(k).rotation, 1), keep_axis(b, first.truth(k).rotation, 1);
    (void)asked.normal_need(a);
    const auto of_asked = asked.track(a), of_unasked = unasked.track(b);
    REQUIRE(of_asked.state == of_unasked.state);
    REQUIRE(of_asked.cam_from_world.rotation.matrix() == of_unasked.cam_from_world.rotation.matrix());
    REQUIRE(of_asked.cam_from_world.translation == of_unasked.cam_from_world.translation);
  }
}

TEST_CASE("Normals that are off by more than their source promises are taken for as good as they are") {
  Random random(3);
  const SO3<double> truth = SO3<double>::exp({0.3, -0.2, 0.5});
  const double promised = radians(4.7);
  NormalTrust<double> trust;
  for (int i = 0; i < 2; ++i) trust.learn(axes_seen(truth, radians(15.0), random), truth);
  CHECK(trust.plane_sigma(promised) == promised);  // six axes: too few to tell
  for (int i = 0; i < 40; ++i) trust.learn(axes_seen(truth, radians(12.0), random), truth);
  CHECK(trust.plane_sigma(promised) == Approx(radians(12.0)).epsilon(0.3));
  for (int i = 0; i < 40; ++i) trust.learn(axes_seen(truth, radians(2.0), random), truth);
  CHECK(trust.plane_sigma(promised) == promised);
  for (int i = 0; i < 40; ++i) trust.learn({}, truth);  // nothing seen, nothing learned
  CHECK(trust.plane_sigma(promised) == promised);
}

TEST_CASE("Normals that lie, in each frame and all alike, lose their weight to the map") {
  const auto path = walk(90);
  Simulation plain(path), told(path);
  Structure lines_alone, lied_to;
  track_all(lines_alone, plain);
  Random random(5);
  const SO3<double> lie = SO3<double>::exp(radians(20.0) * Vec3<double>(0.6, 0, 0.8));
  for (std::size_t k = 0; k < told.size(); ++k) {
    Frame<double> frame = told.frame(k);
    if (k > 20) keep_axis(frame, told.truth(k).rotation, 1);  // what is left open, the normals may say
    add_normals(frame, told.truth(k).rotation, lie, random);
    lied_to.track(frame);
  }
  CHECK(lied_to.trajectory().entries().size() == lines_alone.trajectory().entries().size());
  CHECK(lied_to.trust.plane_sigma(radians(4.7)) > radians(10.0));
  CHECK(position_error(lied_to, told) < 2 * position_error(lines_alone, plain) + 1e-3);
}

}  // namespace normal_demand_test
