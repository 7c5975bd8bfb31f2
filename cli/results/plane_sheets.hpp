// SPDX-License-Identifier: BSD-3-Clause
// A sparse map's planes as sheets that one sees through: of each the rectangle that its points and lines
// cover.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "sslam/io/maps/map_writer.hpp"
#include "sslam/map/plane_extent.hpp"

namespace sslam::cli {

inline constexpr io::Colour kSheetColour{90, 130, 190};
inline constexpr std::uint8_t kSheetAlpha = 70;

using PlaneSheet = std::array<Vec3<double>, 4>;  // corners in the map's coordinates, in order around it

[[nodiscard]] inline std::vector<PlaneSheet> plane_sheets(const Map<double>& map) {
  std::vector<PlaneExtent<double>> extents;
  gather_extents(map, extents);
  std::vector<PlaneSheet> sheets;
  for (std::size_t p = 0; p < extents.size(); ++p)
    if (map.planes[p].alive && extents[p].places > 0)
      sheets.push_back(extents[p].corners(map.planes[p].plane));
  return sheets;
}

}  // namespace sslam::cli
