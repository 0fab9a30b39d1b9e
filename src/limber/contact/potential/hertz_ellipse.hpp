// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace limber::contact {

/// Factor by which an elliptical contact is stiffer than a round one of the
/// same product of the radii of curvature R_1, R_2, at equal depth.
struct EllipseFactor {
  double value = 1.0;
  double slope = 0.0;  ///< by x
};

/// @param x arithmetic over geometric mean of R_1 and R_2; below 1 by its slope
/// there
/// Source     [@johnson1985, section 4.2]
[[nodiscard]] EllipseFactor find_ellipse_factor(double x);

}  // namespace limber::contact
