// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

namespace limber::results {

/// Smallest and largest values of a quantity in intervals of time, which a
/// curve through its values at outputs may miss.
struct Band {
  std::vector<double> edges;  ///< n + 1 [s]
  std::vector<double> least;  ///< n [unit of the curve]; NaN: unknown
  std::vector<double> most;   ///< n
};

/// Whether the band reaches beyond a curve through values at times by more than
/// 1 % of the band's height, so that it is worth drawing.
/// @param times increasing [s]
[[nodiscard]] bool exceeds(const Band& band, const std::vector<double>& times,
                           const std::vector<double>& values);

}  // namespace limber::results
