// SPDX-License-Identifier: BSD-3-Clause
// The surfaces of `--dense` for the report's page, in the room that they have there.
#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "cli/results/textured_mesh.hpp"

namespace sslam::cli {

// Bytes of the page that triangles and texture may take.
inline constexpr std::size_t kSurfaceRoom = 5'000'000;

// The triangles and the texture, which is compressed more and then made smaller until both fit: `share` says
// how much is left of its side, `quality` that of its JPEG (0: as it was). Null where the triangles alone are
// too many, or the texture cannot be read; `problem` says so.
[[nodiscard]] nlohmann::ordered_json surface_data(const TexturedMesh& mesh, std::size_t room,
                                                  std::string& problem);

}  // namespace sslam::cli
