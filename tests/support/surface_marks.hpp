// SPDX-License-Identifier: BSD-3-Clause
// What a front end would find on the faces of a rendered house, without an image: points where its textures
// have something to show, corners where they have not, and edges.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <tuple>
#include <utility>
#include <vector>

#include "sslam/core/descriptor.hpp"
#include "sslam/core/random.hpp"
#include "sslam/synth/noise.hpp"
#include "sslam/synth/scene.hpp"

namespace sslam::testing {

struct SurfacePoint {
  Vec3<double> position, along;  // world; a direction on the surface
  double distance;  // from which it is as large as a pixel of a focal length of 480 pixels, metres
  double strength;  // the strongest are kept where there are too many
  Descriptor descriptor;
};

struct SurfaceEdge {
  Vec3<double> start, end;           // world
  std::array<std::int32_t, 2> face;  // on either side; -1 where there is none
  Descriptor descriptor;
};

[[nodiscard]] inline Descriptor random_descriptor(Random& random) {
  Descriptor descriptor;
  for (auto& word : descriptor.words) word = random.next();
  return descriptor;
}

class SurfaceMarks {
 public:
  std::vector<SurfacePoint> points;  // face by face
  std::vector<SurfaceEdge> edges;

  // One point in each square of `pitch` metres where a face has a texture; three times as many on what is
  // printed.
  SurfaceMarks(const synth::Scene& scene, double pitch, std::uint64_t seed)
      : pitch_(pitch), seed_(seed), edges_of_(scene.faces.size()) {
    for (std::size_t i = 0; i < scene.faces.size(); ++i) {
      first_point_.push_back(points.size());
      const synth::Face& face = scene.faces[i];
      if (face.paint.texture >= 0)
        add_texture(scene, face);
      else
        add_corners(face);
      add_edges(face, static_cast<std::int32_t>(i));
    }
    first_point_.push_back(points.size());
  }

  // Of the face: the first of its points and one past the last, and its edges.
  [[nodiscard]] std::pair<std::size_t, std::size_t> points_of(std::size_t face) const {
    return {first_point_[face], first_point_[face + 1]};
  }
  [[nodiscard]] const std::vector<std::int32_t>& edges_of(std::size_t face) const { return edges_of_[face]; }

 private:
  static constexpr double kLeastSide = 0.15, kLeastEdge = 0.25;  // metres

  // The lattice is fixed to the texture: where two faces show the same sheet
  // of wood, they look the same.
  void add_texture(const synth::Scene& scene, const synth::Face& face) {
    const auto texture = static_cast<std::size_t>(face.paint.texture);
    const double pitch = scene.textures[texture].channels() == 3 ? 0.58 * pitch_ : pitch_;
    const Vec2<double> offset = face.paint.offset.cast<double>();
    const auto seed = static_cast<std::uint32_t>(seed_ + 977 * texture);
    for (int i = lattice(offset.x(), pitch); i <= lattice(offset.x() + face.width, pitch); ++i)
      for (int k = lattice(offset.y(), pitch); k <= lattice(offset.y() + face.height, pitch); ++k) {
        Random random(synth::lattice_hash(i, k, seed) | std::uint64_t{seed} << 32);
        const double s = (i + random.uniform(0.0, 1.0)) * pitch - offset.x();
        const double t = (k + random.uniform(0.0, 1.0)) * pitch - offset.y();
        if (s < 0.01 || t < 0.01 || s > face.width - 0.01 || t > face.height - 0.01) continue;
        add_point(face, s, t, random);
      }
  }
  [[nodiscard]] static int lattice(double x, double pitch) { return static_cast<int>(std::floor(x / pitch)); }

  void add_corners(const synth::Face& face) {
    if (std::min(face.width, face.height) < kLeastSide) return;
    for (const double s : {0.0, face.width})
      for (const double t : {0.0, face.height}) {
        Random random(seed_ + 31 * points.size());
        if (corners_.emplace(place(face.at(s, t)), 0).second) add_point(face, s, t, random);
      }
  }

  void add_point(const synth::Face& face, double s, double t, Random& random) {
    SurfacePoint point{face.at(s, t),
                       face.along_s,
                       std::exp(random.uniform(std::log(2.0), std::log(8.0))),
                       random.uniform(0.0, 1.0),
                       {}};
    point.descriptor = random_descriptor(random);
    points.push_back(point);
  }

  // Two faces that meet have one edge there.
  void add_edges(const synth::Face& face, std::int32_t index) {
    const std::array corner{face.at(0, 0), face.at(face.width, 0), face.at(face.width, face.height),
                            face.at(0, face.height)};
    for (std::size_t i = 0; i < corner.size(); ++i) {
      Vec3<double> a = corner[i], b = corner[(i + 1) % corner.size()];
      if ((b - a).norm() < kLeastEdge) continue;
      if (place(b) < place(a)) std::swap(a, b);
      const auto [at, fresh] = known_edges_.emplace(std::pair(place(a), place(b)), edges.size());
      if (fresh) {
        Random random(seed_ + 7919 * edges.size());
        edges.push_back({a, b, {index, -1}, random_descriptor(random)});
      } else if (edges[at->second].face[1] < 0) {
        edges[at->second].face[1] = index;
      } else {
        continue;
      }
      edges_of_[static_cast<std::size_t>(index)].push_back(static_cast<std::int32_t>(at->second));
    }
  }

  using Place = std::tuple<long, long, long>;  // centimetres
  [[nodiscard]] static Place place(const Vec3<double>& p) {
    return {std::lround(100 * p.x()), std::lround(100 * p.y()), std::lround(100 * p.z())};
  }

  double pitch_;
  std::uint64_t seed_;
  std::vector<std::size_t> first_point_;  // by face, and the end
  std::vector<std::vector<std::int32_t>> edges_of_;
  std::map<Place, int> corners_;
  std::map<std::pair<Place, Place>, std::size_t> known_edges_;
};

}  // namespace sslam::testing
