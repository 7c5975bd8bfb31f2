// SPDX-License-Identifier: BSD-3-Clause
// The laws that every transform group of the library keeps, as numbers: how far three elements are from
// keeping them.
#pragma once

#include <algorithm>
#include <concepts>

#include "sslam/core/random.hpp"
#include "sslam/geometry/manifold.hpp"

namespace sslam::testing {

template <class G>
concept TransformGroup = Manifold<G> &&
    requires(const G g, const typename G::Tangent& xi, const Vec3<ScalarOf<G>>& x) {
  { G::exp(xi) } -> std::same_as<G>;
  { g.log() } -> std::convertible_to<typename G::Tangent>;
  { g.inverse() } -> std::same_as<G>;
  { g* g } -> std::same_as<G>;
  { g* x } -> std::convertible_to<Vec3<ScalarOf<G>>>;
};

// Each is a distance that is zero but for rounding.
template <Scalar S>
struct GroupLaws {
  S identity = 0;         // e a = a = a e
  S inverse = 0;          // a^-1 a = e = a a^-1
  S associativity = 0;    // (a b) c = a (b c)
  S action = 0;           // (a b) x = a (b x)
  S exp_of_log = 0;       // Exp(Log(a)) = a
  S left_retraction = 0;  // retract(xi) = Exp(xi) a
};

// Elements are compared by what they do to four points, so that the two signs of a quaternion are one
// rotation.
template <TransformGroup G, class S = ScalarOf<G>>
[[nodiscard]] S group_distance(const G& a, const G& b) {
  S worst = 0;
  for (int i = 0; i < 4; ++i) {
    const Vec3<S> x = i < 3 ? Vec3<S>(Vec3<S>::Unit(i)) : Vec3<S>(Vec3<S>::Zero());
    worst = std::max(worst, (a * x - b * x).cwiseAbs().maxCoeff());
  }
  return worst;
}

template <TransformGroup G, class S = ScalarOf<G>>
[[nodiscard]] GroupLaws<S> group_laws(const G& a, const G& b, const G& c, const typename G::Tangent& xi,
                                      const Vec3<S>& x) {
  const G e;
  return {
      .identity = std::max(group_distance(e * a, a), group_distance(a * e, a)),
      .inverse = std::max(group_distance(a.inverse() * a, e), group_distance(a * a.inverse(), e)),
      .associativity = group_distance((a * b) * c, a * (b * c)),
      .action = ((a * b) * x - a * (b * x)).cwiseAbs().maxCoeff(),
      .exp_of_log = group_distance(G::exp(a.log()), a),
      .left_retraction = group_distance(a.retract(xi), G::exp(xi) * a),
  };
}

// A tangent vector with a rotation of the given angle about a random axis, radians, and the rest
// (translation, log of the scale) uniform in [-1, 1].
template <Manifold G, class S = ScalarOf<G>>
[[nodiscard]] typename G::Tangent tangent_of_angle(S angle, Random& random) {
  typename G::Tangent xi;
  for (int i = 0; i < G::kDof; ++i) xi[i] = random.uniform(S(-1), S(1));
  xi.template head<3>() = angle * xi.template head<3>().normalized();
  return xi;
}

}  // namespace sslam::testing
