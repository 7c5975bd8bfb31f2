// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/residual/similarity_edge.hpp"

#include "sslam/testing/numeric_jacobian.hpp"
#include "support/catch.hpp"
#include "support/random_draws.hpp"

namespace {

using namespace sslam;
using namespace sslam::testing;

Sim3<double> draw(Random& random, double reach) {
  return Sim3<double>::exp(uniform_vector<double, 7>(random, -reach, reach));
}

}  // namespace

TEST_CASE("An edge that fits has no error, whatever the scales of its ends") {
  Random random(1);
  for (int i = 0; i < 20; ++i) {
    const Sim3<double> from = draw(random, 1), to = draw(random, 1);
    CHECK(similarity_edge(to * from.inverse(), from, to).error.norm() < 1e-12);
  }
}

TEST_CASE("Derivatives of an edge are those of its error") {
  Random random(2);
  for (int i = 0; i < 20; ++i) {
    const Sim3<double> from = draw(random, 0.8), to = draw(random, 0.8);
    const Sim3<double> to_from = draw(random, 0.2) * to * from.inverse();
    const SimilarityEdge<double> edge = similarity_edge(to_from, from, to);
    const auto by_from =
        numeric_jacobian([&](const Sim3<double>& x) { return similarity_edge(to_from, x, to).error; }, from);
    const auto by_to =
        numeric_jacobian([&](const Sim3<double>& x) { return similarity_edge(to_from, from, x).error; }, to);
    CHECK(worst_entry(edge.by_from, by_from).error < 1e-4);
    CHECK(worst_entry(edge.by_to, by_to).error < 1e-4);
  }
}
