// SPDX-License-Identifier: BSD-3-Clause
// From a map and its keyframes' images to planes with extent. Bounds are twice what was measured.
#include "sslam/dense/dense_model.hpp"

#include "dense/filmed_room.hpp"
#include "support/catch.hpp"

using namespace sslam;
using namespace sslam::testing;

TEST_CASE("a filmed room becomes its walls, floor and ceiling, with a hole where the door is open") {
  const FilmedRoom room;
  const dense::DenseModel model = room.model();
  REQUIRE(model.planes.size() >= 6);
  const std::vector<double> off = distances(room, model);
  const double median = off[off.size() / 2], most = off[off.size() * 9 / 10];
  const double complete = completeness(room, model, 0.05);
  INFO("median " << median << " m, 90 % " << most << " m, complete " << complete << ", planes "
                 << model.planes.size());
  CHECK(median < 0.0014);
  CHECK(most < 0.42);  // patches that fit by chance, beyond the door
  CHECK(1 - complete < 2 * 0.11);

  constexpr double kTolerance = 0.05;
  for (const double x : {-0.3, 0.0, 0.3})
    for (const double z : {0.4, 1.0, 1.6}) {
      INFO("in the doorway at " << x << ", " << z);
      CHECK_FALSE(covers(model, {x, FilmedRoom::kNear, z}, kTolerance));
    }
  CHECK(covers(model, {-1.0, FilmedRoom::kNear, 1.2}, kTolerance));
  CHECK(covers(model, {1.0, FilmedRoom::kNear, 1.2}, kTolerance));
}

TEST_CASE("the same map gives the same model to the bit") {
  const FilmedRoom room;
  const dense::DenseModel first = room.model(), second = room.model();
  REQUIRE(first.planes.size() == second.planes.size());
  for (std::size_t p = 0; p < first.planes.size(); ++p) {
    CHECK(first.planes[p].fit.plane.normal == second.planes[p].fit.plane.normal);
    CHECK(first.planes[p].fit.plane.distance == second.planes[p].fit.plane.distance);
    CHECK((first.planes[p].cells.solid == second.planes[p].cells.solid));
  }
}

TEST_CASE("polygons enclose what the cells cover, and triangles fill the polygons") {
  const FilmedRoom room;
  for (const dense::DensePlane& plane : room.model().planes) {
    double outlined = 0, filled = 0;
    for (const dense::Polygon& polygon : plane.polygons) {
      double own = dense::twice_area(polygon.outer) / 2;
      for (const dense::Ring& hole : polygon.holes) own += dense::twice_area(hole) / 2;
      const dense::Triangulator cut(polygon);
      for (const dense::Triangle& t : cut.triangles)
        filled += dense::twice_area({cut.corners[t[0]], cut.corners[t[1]], cut.corners[t[2]]}) / 2;
      outlined += own;
    }
    CHECK(outlined == Approx(plane.cells.area()).epsilon(0.1));
    CHECK(filled == Approx(outlined).epsilon(0.09));  // thinned rings may touch
  }
}

TEST_CASE("points without order in the air and images that agree nowhere make no model") {
  FilmedRoomOptions options;
  options.clutter = true;
  const FilmedRoom room(options);
  CHECK(room.model().planes.empty());
  CHECK(dense::DenseBuilder({}).build({}, 1, {}).planes.empty());
}

// The control: the photometric check would see a plane that stands elsewhere.
TEST_CASE("images speak for a plane where it is and against one that is shifted") {
  const FilmedRoom room;
  const dense::CostOptions options;
  const auto mean_cost = [&](double distance) {
    // The floor, z = 0, and the planes parallel to it.
    const std::vector<dense::BoundedPlane> planes{{{Vec3<double>::UnitZ(), distance},
                                                   tangent_basis<double>(Vec3<double>::UnitZ()),
                                                   Vec2<double>::Constant(-9),
                                                   Vec2<double>::Constant(9)}};
    dense::CostOptions photo = options;
    photo.mark_weight = 0;
    dense::ViewCosts costs(room.views, planes, room.depth(), photo);
    dense::CostGrid grid;
    double sum = 0;
    int count = 0;
    for (std::size_t v = 0; v < room.views.size(); ++v) {
      costs.fill(v, grid);
      for (int r = 0; r < grid.rows; ++r)
        for (int c = 0; c < grid.columns; ++c) {
          const auto pixel = static_cast<std::size_t>((r * options.block + 4) * room.frames[v].width +
                                                      c * options.block + 4);
          const std::int32_t seen = room.frames[v].surface[pixel];
          if (seen < 0 || room.frames[v].face[static_cast<std::size_t>(seen)] != 0) continue;
          if (grid.cost[grid.at(c, r)] == dense::kNoCost) continue;
          sum += grid.cost[grid.at(c, r)];
          ++count;
        }
    }
    REQUIRE(count > 500);
    return sum / count;
  };
  const double there = mean_cost(0);
  INFO(there);
  CHECK(there < 0.25);
  for (const double shift : {-0.15, -0.08, 0.08, 0.15}) {
    INFO("shifted by " << shift);
    CHECK(mean_cost(shift) > 1.6 * there);
  }
}
