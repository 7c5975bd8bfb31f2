// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/image/inverse_depth_blocks.hpp"

#include <cmath>
#include <cstdint>

#include "support/catch.hpp"

using namespace sslam;

namespace {

constexpr ImageSize kSize{40, 24};

// 1 / depth = 0.5 + 0.004 x - 0.006 y.
double inverse_depth(int x, int y) {
  return 0.5 + 0.004 * x - 0.006 * y;
}

template <class Pixel>
std::vector<Pixel> draw_plane(double factor) {
  std::vector<Pixel> depth;
  for (int y = 0; y < kSize.height; ++y)
    for (int x = 0; x < kSize.width; ++x)
      depth.push_back(static_cast<Pixel>(std::round(1000 * factor / inverse_depth(x, y)) / 1000));
  return depth;
}

}  // namespace

TEST_CASE("A plane's blocks are planar, in metres or in any unit") {
  const std::vector<float> metres = draw_plane<float>(1);
  const std::vector<std::uint16_t> units = draw_plane<std::uint16_t>(5000);
  InverseDepthBlocks of_metres, of_units;
  of_metres.build(ImageView<float>(metres.data(), kSize), 1, 0.3, 8, 0.005);
  of_units.build(ImageView<std::uint16_t>(units.data(), kSize), 5000, 0.3, 8, 0.005);
  REQUIRE(of_metres.columns() == 5);
  REQUIRE(of_metres.rows() == 3);
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 5; ++c)
      for (const InverseDepthBlocks* blocks : {&of_metres, &of_units}) {
        const DepthBlock& block = blocks->at(r, c);
        CHECK(block.planar);
        CHECK(block.plane.du == Approx(0.004).margin(1e-4));
        CHECK(block.plane.dv == Approx(-0.006).margin(1e-4));
        CHECK(block.mean == Approx(0.5 + 0.004 * (8 * c + 3.5) - 0.006 * (8 * r + 3.5)).margin(1e-3));
      }
  const DepthWindow window = of_metres.gather(1, 2, 1, of_metres.at(1, 2).plane, 0.005F, 0);
  CHECK(window.possible == 9);
  CHECK(window.blocks == 9);
  CHECK(window.scatter() < 1e-3);
  CHECK(of_metres.gather(0, 0, 1, of_metres.at(0, 0).plane, 0.005F, 0).possible == 4);
}

TEST_CASE("Blocks with holes, out of range or across an edge are not planar") {
  std::vector<float> depth = draw_plane<float>(1);
  const auto block_of = [&](auto change) {
    std::vector<float> changed = depth;
    for (int y = 0; y < 8; ++y)
      for (int x = 0; x < 8; ++x) change(changed[static_cast<std::size_t>(y * kSize.width + x)], x);
    InverseDepthBlocks blocks;
    blocks.build(ImageView<float>(changed.data(), kSize), 1, 0.3, 8, 0.005);
    return blocks.at(0, 0);
  };
  CHECK(block_of([](float&, int) {}).planar);
  CHECK(!block_of([](float& d, int x) { d = x < 5 ? 0 : d; }).planar);
  CHECK(!block_of([](float& d, int) { d = 20; }).planar);
  CHECK(!block_of([](float& d, int x) { d = x < 4 ? d : d + 0.3F; }).planar);
}
