// SPDX-License-Identifier: BSD-3-Clause
// The time at which a rolling shutter reads a row.
#pragma once

#include "sslam/core/types.hpp"

namespace sslam {

// Seconds after the frame's stamp, which belongs to the middle of the image: the first of `rows` rows is read
// half of `read_out` before it, the last row half of `read_out` after it. `row` counts from the middle of the
// first row.
template <Scalar S>
[[nodiscard]] constexpr S row_offset(S read_out, S row, S rows) noexcept {
  return read_out * ((row + S(0.5)) / rows - S(0.5));
}

}  // namespace sslam
