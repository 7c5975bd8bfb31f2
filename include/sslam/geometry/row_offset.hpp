// SPDX-License-Identifier: BSD-3-Clause
// When a rolling shutter reads a row.
#pragma once

#include "sslam/core/types.hpp"

namespace sslam {

// Seconds after the frame's stamp, which is that of the image's middle: the first row of `rows` is read half
// of `read_out` before it, the last half of it after. `row` counts from the middle of the first row.
template <Scalar S>
[[nodiscard]] constexpr S row_offset(S read_out, S row, S rows) noexcept {
  return read_out * ((row + S(0.5)) / rows - S(0.5));
}

}  // namespace sslam
