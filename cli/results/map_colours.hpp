// SPDX-License-Identifier: BSD-3-Clause
// What colour the points and lines of a map have: gathered at the features of its keyframes while images
// pass, and kept in a file beside the map, which knows none.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <opencv2/core.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "sslam/geometry/camera.hpp"
#include "sslam/io/maps/byte_archive.hpp"
#include "sslam/io/maps/map_writer.hpp"
#include "sslam/map/map.hpp"

namespace sslam::cli {

using LandmarkColour = std::optional<io::Colour>;  // empty: no image of it was there

// By the landmarks' ids. A list may be shorter than the map's: the others have no colour.
struct MapColours {
  std::vector<LandmarkColour> points, lines;

  [[nodiscard]] bool any() const;
};

[[nodiscard]] inline LandmarkColour colour_at(const std::vector<LandmarkColour>& colours, std::size_t id) {
  return id < colours.size() ? colours[id] : std::nullopt;
}

// Ids of landmarks and keyframes change while a map grows and maps are joined; what a keyframe was made of
// stays. So colours are noted for each feature of a frame, and given to the landmarks that it sees in the
// end.
class FeatureColours {
 public:
  // The features of a frame, where its picture shows them. `camera` is that of the picture.
  void note(const Frame<double>& frame, const cv::Mat& picture, const Camera<double>& camera);
  // A map from a file, whose keyframes have no pictures here: its features look like their landmarks.
  void note(const Map<double>& map, const MapColours& colours);

  // All of them, and back. Throws Error where an archive holds none.
  void put(io::ByteWriter& out) const;
  void take(io::ByteReader& in);

  // The median over the keyframes that see a landmark, channel by channel.
  [[nodiscard]] MapColours of(const Map<double>& map) const;

 private:
  using Key = std::pair<std::int64_t, double>;  // index and stamp of a frame
  struct Features {
    std::vector<LandmarkColour> points, lines;
  };
  std::map<Key, Features> frames_;
};

// Throws Error when it cannot be written.
void write_colours(const std::filesystem::path& path, const MapColours& colours);

// Throws Error when the file cannot be read or is damaged, or belongs to a map with other counts of
// landmarks.
[[nodiscard]] MapColours read_colours(const std::filesystem::path& path, const Map<double>& map);

}  // namespace sslam::cli
