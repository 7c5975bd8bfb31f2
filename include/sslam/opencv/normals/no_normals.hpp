// SPDX-License-Identifier: BSD-3-Clause
// The normal source of a camera that has only its lines.
#pragma once

#include "sslam/opencv/normals/normal_source.hpp"

namespace sslam {

struct NoNormals {
  [[nodiscard]] NormalStatus fill(const ImageInput&, const Camera<double>&,
                                  NormalField& field) const noexcept {
    field.clear();
    return NormalStatus::kOk;
  }
};
static_assert(NormalSource<NoNormals>);

}  // namespace sslam
