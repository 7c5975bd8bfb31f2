// SPDX-License-Identifier: BSD-3-Clause
// Options, prior and result of the Manhattan rotation kernels.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "sslam/core/parameter.hpp"
#include "sslam/core/status.hpp"
#include "sslam/geometry/so3.hpp"
#include "sslam/geometry/squareness.hpp"

namespace sslam {

// The same values suit a network's normals (scatter 5-15 degrees) and normals from depth (1-2 degrees), since
// the spread of the votes is measured in every frame. Angles in radians.
template <Scalar S>
struct ManhattanOptions {
  // Normals. Kernel widths are those of a Gaussian: 7 degrees mean a cone of 24 degrees, more than the error
  // of a prediction, and 2 degrees a cone of 7. In between the width follows the measured scatter of the
  // votes.
  S widest_kernel = radians(S(7));
  S narrowest_kernel = radians(S(2));
  S kernel_per_scatter = S(1.5);
  S min_normal_share = S(0.05);  // least share of all normals that shows an axis
  // Uncertainty of a plane's direction. The errors of its normals have this share of their variance in
  // common, so that any number of them counts as at most 1 / 0.3 independent normals. The floor remains
  // however many votes there are.
  S normal_correlation = S(0.3);
  S normal_floor = kWallTilt<S>;
  S normal_votes = 40;           // compared with segments, all normals of a view count as this many votes
  std::size_t coarse_every = 8;  // while the kernel narrows, only every n-th block of normals is read

  // Segments. The floor is how far real edges deviate from their axis; the gate applies at first and halves
  // in every round. Both are added to each segment's sigma.
  S line_floor = kEdgeTilt<S>;
  S widest_line_gate = radians(S(4));
  S min_line_gain = S(8);  // that shows an axis: log-likelihood of the segments with it over that without

  // The frame.
  S max_deviation = radians(S(10));  // standard deviation, by votes alone, up to which a rotation is observed
  S max_jump = radians(S(45));       // a larger turn from the prior is a flip, not a motion

  // For normals with an error common to each plane, as a network's: plane_sigma, radians, per component.
  [[nodiscard]] ManhattanOptions with_plane_sigma(S plane_sigma) const noexcept {
    ManhattanOptions options = *this;
    options.normal_floor = std::max(normal_floor, plane_sigma);
    return options;
  }

  template <class Self, class Visit>
  static void parameters(Self& self, Visit&& visit) {
    visit("widest_kernel", self.widest_kernel, Unit::kDegrees, 0.01, 45,
          "first kernel width of the mean-shift");
    visit("narrowest_kernel", self.narrowest_kernel, Unit::kDegrees, 0.01, 45, "last kernel width");
    visit("kernel_per_scatter", self.kernel_per_scatter, Unit::kNumber, 0.01, 100,
          "kernel width over the scatter of the normals");
    visit("min_normal_share", self.min_normal_share, Unit::kShare, 0, 1,
          "share of the normals that shows an axis");
    visit("normal_correlation", self.normal_correlation, Unit::kShare, 0, 1,
          "of the variance of a plane's normals, that they have in common");
    visit("normal_floor", self.normal_floor, Unit::kDegrees, 0, 45,
          "standard deviation that no plane's direction falls below");
    visit("normal_votes", self.normal_votes, Unit::kNumber, 0, 1e6,
          "independent directions that all normals of a view count as");
    visit("coarse_every", self.coarse_every, Unit::kCount, 1, 1000,
          "one block of normals in so many is read while the kernel narrows");
    visit("line_floor", self.line_floor, Unit::kDegrees, 0, 45,
          "how well edges keep to their axis: added to the sigma of each segment");
    visit("widest_line_gate", self.widest_line_gate, Unit::kDegrees, 0.01, 45,
          "of the segments at first; it halves in each round");
    visit("min_line_gain", self.min_line_gain, Unit::kNumber, 0, 1e6,
          "log-likelihood of the segments with an axis over that without it");
    visit("max_deviation", self.max_deviation, Unit::kDegrees, 0, 180,
          "standard deviation, by votes alone, up to which a rotation is observed");
    visit("max_jump", self.max_jump, Unit::kDegrees, 0, 180,
          "turn from the prediction, beyond which it is a flip");
  }
};
static_assert(Described<ManhattanOptions<double>>);

// The predicted rotation and the covariance of its left perturbation, camera frame, rad^2. The prior
// determines the directions that no vote observes.
template <Scalar S>
struct ManhattanPrior {
  SO3<S> cam_from_manhattan;
  Mat3<S> covariance = Mat3<S>::Identity() * (radians(S(10)) * radians(S(10)));
};

template <Scalar S>
struct AxisSupport {
  bool seen = false;  // its direction is known to max_deviation from its own votes
  bool by_normals = false;
  bool by_lines = false;
  S normal_share = 0;    // share of all normals that belong to this axis, without the clutter in its cone
  S normal_scatter = 0;  // standard deviation of those normals about their mode, per component, radians
  Vec2<S> mode = Vec2<S>::Zero();  // offset of the normals' mode from axis k, along axes k+1 and k+2, radians
  S mode_sigma = 0;                // standard deviation of the mode's direction, per component, radians
  S lines = 0;      // number of segments, each weighted by its probability to belong to this axis
  S line_gain = 0;  // log-likelihood of the segments with this axis over that without it
};

template <Scalar S>
struct ManhattanEstimate {
  Status status = Status::kTooFew;
  SO3<S> cam_from_manhattan;             // columns: the axes in the camera frame
  Mat3<S> covariance = Mat3<S>::Zero();  // of the left perturbation, camera frame, rad^2, prior included
  int axes_seen = 0;
  std::array<AxisSupport<S>, 3> axes{};
  S line_rms =
      0;  // residual of the segments on an axis over their sigma, root mean square (1 is as promised)
  S deviation = 0;       // standard deviation of the worst observed rotation by the votes alone, radians
  S log_likelihood = 0;  // find_manhattan: of the votes, over that of votes without common axes
  S ambiguity = 0;  // find_manhattan: the same of the second best frame, as a share of the best; 0 if none
};

}  // namespace sslam
