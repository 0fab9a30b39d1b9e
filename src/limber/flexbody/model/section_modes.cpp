// SPDX-License-Identifier: BSD-3-Clause
#include "limber/flexbody/model/section_modes.hpp"

#include <algorithm>
#include <cmath>

namespace limber::flexbody {

double calc_tsai_wu(const Vector6& stress, const Vector6& strengths) {
  const double s1 = stress[0];
  const double s2 = stress[1];
  const double s12 = stress[3];
  const auto along = [](double s, double t, double c) {
    return s * (1.0 / t - 1.0 / c) + s * s / (t * c);
  };
  return along(s1, strengths[0], strengths[1]) +
         along(s2, strengths[2], strengths[3]) +
         s12 * s12 / (strengths[4] * strengths[4]) +
         2.0 * strengths[5] * s1 * s2;
}

double calc_maximum_stress(const Vector6& stress, const Vector6& strengths) {
  const auto along = [](double s, double t, double c) {
    return s > 0.0 ? s / t : -s / c;
  };
  return std::max({along(stress[0], strengths[0], strengths[1]),
                   along(stress[1], strengths[2], strengths[3]),
                   std::abs(stress[3]) / strengths[4]});
}

}  // namespace limber::flexbody
