// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/image/image_view.hpp"

#include <array>
#include <cstdint>

#include "support/catch.hpp"

using namespace sslam;

TEST_CASE("A view finds its pixels row by row") {
  const std::array<std::uint16_t, 6> pixels{1, 2, 3, 4, 5, 6};
  const ImageView<std::uint16_t> whole(pixels.data(), {3, 2});
  CHECK(whole.at(0, 0) == 1);
  CHECK(whole.at(2, 0) == 3);
  CHECK(whole.at(0, 1) == 4);
  CHECK(whole.row(1) == pixels.data() + 3);
}

TEST_CASE("A view of a part of an image skips what lies between its rows") {
  const std::array<std::uint8_t, 9> pixels{0, 0, 0, 1, 2, 0, 3, 4, 0};
  const ImageView<std::uint8_t> part(pixels.data() + 3, {2, 2}, 3);
  CHECK(part.width() == 2);
  CHECK(part.height() == 2);
  CHECK(part.at(1, 0) == 2);
  CHECK(part.at(0, 1) == 3);
  CHECK(part.at(1, 1) == 4);
}

TEST_CASE("A view of nothing is empty") {
  const ImageView<float> nothing;
  CHECK(nothing.width() == 0);
  CHECK(nothing.height() == 0);
}
