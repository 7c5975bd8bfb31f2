// SPDX-License-Identifier: BSD-3-Clause
// What bundle adjustment works on: views, points and lines, and the observations that tie them together.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "sslam/core/parameter.hpp"
#include "sslam/geometry/camera.hpp"
#include "sslam/geometry/line2.hpp"
#include "sslam/geometry/line3.hpp"
#include "sslam/geometry/plane3.hpp"
#include "sslam/geometry/se3.hpp"

namespace sslam {

// What of a view stays as it is.
enum class Hold : std::uint8_t {
  kNothing,
  kCentre,  // the camera turns about its centre
  kPose,
};

// Rotation known from elsewhere: r = sqrt_information * Log(mean * R^-1).
template <Scalar S>
struct RotationTie {
  SO3<S> mean;
  Mat3<S> sqrt_information;  // of the left perturbation, 1/rad
};

template <Scalar S>
struct BundleView {
  SE3<S> cam_from_world;
  Pinhole<S> pinhole;
  Hold hold = Hold::kNothing;
  std::optional<RotationTie<S>> rotation;
};

template <Scalar S>
struct PointEdge {
  Vec2<S> pixel;
  S inverse_sigma = 1;    // of each coordinate, 1/pixels
  std::int32_t view = 0;  // index into BundleGraph::views
};

template <Scalar S>
struct LineEdge {
  Segment2<S> segment;
  S inverse_sigma = 1;  // of an endpoint's distance from the line, 1/pixels
  std::int32_t view = 0;
};

inline constexpr std::int32_t kNoPlane = -1;

// Edges [first_edge, last_edge) of BundleGraph::point_edges are its own.
template <Scalar S>
struct BundlePoint {
  Vec3<S> position;  // world
  std::int32_t first_edge = 0, last_edge = 0;
  std::int32_t plane = kNoPlane;  // that it is tied to: index into BundleGraph::planes
};

template <Scalar S>
struct BundleLine {
  Line3<S> line;  // world
  std::int32_t first_edge = 0, last_edge = 0;
  std::optional<Vec3<S>> axis;    // unit, world: the direction, up to its sign, that structure gives the line
  std::int32_t plane = kNoPlane;  // that it is tied to
  Vec3<S> start = Vec3<S>::Zero(), end = Vec3<S>::Zero();  // world: where on the line the tie holds
};

// Points and lines are tied to it, and it moves with them.
template <Scalar S>
struct BundlePlane {
  Plane3<S> plane;              // world
  std::optional<Vec3<S>> axis;  // unit, world: the normal, up to its sign, that structure gives the plane
  // Members that stay where they are: the sum of (X, -1)(X, -1)^T, so that p^T held p is that of their
  // squared distances from the plane p = (normal, distance).
  Mat<S, 4, 4> held = Mat<S, 4, 4>::Zero();
};

// Holds the distance between a held and a free view: the one degree of freedom that observations leave open.
template <Scalar S>
struct ScaleTie {
  std::int32_t held = 0, free = 0;  // views
  S distance = 1;
};

template <Scalar S>
struct BundleGraph {
  std::vector<BundleView<S>> views;
  std::vector<BundlePoint<S>> points;
  std::vector<BundleLine<S>> lines;
  std::vector<BundlePlane<S>> planes;
  std::vector<PointEdge<S>> point_edges;
  std::vector<LineEdge<S>> line_edges;
  std::optional<ScaleTie<S>> scale;
  S depth = 1;  // of the scene, units of the map: what the flatness of planes is relative to

  void clear() noexcept {
    views.clear();
    points.clear();
    lines.clear();
    planes.clear();
    point_edges.clear();
    line_edges.clear();
    scale.reset();
  }
};

// Widths of the robust losses, Cauchy throughout: how many of its own standard deviations an observation may
// be off before it begins to let go. At 3, clean data lose about 1 % of their accuracy, and one gross error
// in ten costs 15 %.
template <Scalar S>
struct BundleLosses {
  S point = 3;     // both coordinates together
  S line = 3;      // both endpoints together
  S rotation = 2;  // a Manhattan frame that was the wrong one
  S axis = 2;      // a line that does not follow its axis
  // Of one wall or edge of the map off its axis; kWallTilt and kEdgeTilt say it of what one frame shows.
  S axis_sigma = radians(S(0.5));
  S plane = 2;              // a landmark that does not lie on its plane
  S flatness = S(0.01);     // of real walls and of what hangs on them, over the scene depth
  S scale_sigma = S(1e-3);  // of the held distance, as a part of it; it competes with nothing

  template <class Self, class Visit>
  static void parameters(Self& self, Visit&& visit) {
    visit("point", self.point, Unit::kNumber, 0.01, 1000,
          "standard deviations at which a point begins to let go");
    visit("line", self.line, Unit::kNumber, 0.01, 1000,
          "standard deviations at which a line begins to let go");
    visit("rotation", self.rotation, Unit::kNumber, 0.01, 1000,
          "standard deviations at which a Manhattan rotation begins to let go");
    visit("axis", self.axis, Unit::kNumber, 0.01, 1000,
          "standard deviations at which a line off its axis begins to let go");
    visit("axis_sigma", self.axis_sigma, Unit::kDegrees, 0.001, 45,
          "how far one wall or edge of the map stands off its axis, standard deviation");
    visit("plane", self.plane, Unit::kNumber, 0.01, 1000,
          "standard deviations at which a landmark off its plane begins to let go");
    visit("scale_sigma", self.scale_sigma, Unit::kNumber, 1e-9, 1,
          "of the distance that holds the scale, over that distance");
    // flatness is listed with the planes.
  }
};
static_assert(Described<BundleLosses<double>>);

}  // namespace sslam
